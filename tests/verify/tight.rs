//! Certificates that claim no more than the inequalities allow are accepted; with any term less they are rejected.
//!
//! The terms are computed here over the fractions, from a start that is known roughly, with a gain and a whitening of a few bits, so
//! that none of them is small.

use exact_kalman::matrix::Matrix;
use exact_kalman::model::{Before, Initial, Noise, Observation, Path, System, Timing};
use exact_kalman::scalar::{Rational, ratio};
use exact_kalman::verify::{
    BeliefDocument, Condition, DyadicMatrix, FilterCheck, Hexadecimal, Rejection, StepDocument,
};

use super::models::Q;

/// A symmetric matrix as its lower triangle, others whole; on the grid 2⁻⁹⁰.
pub fn dyadic(matrix: &Q, is_symmetric: bool) -> DyadicMatrix {
    let power = ratio(2, 1).pow(90);
    let entry = |i: usize, j: usize| Hexadecimal((&matrix[(i, j)] * &power).round().to_integer());
    let columns = |i: usize| if is_symmetric { i + 1 } else { matrix.columns() };
    DyadicMatrix {
        exponent: -90,
        rows: (0..matrix.rows()).map(|i| (0..columns(i)).map(|j| entry(i, j)).collect()).collect(),
    }
}

/// More than rounding to the grid takes away.
fn raised(matrix: &Q) -> DyadicMatrix {
    dyadic(&(matrix + Matrix::identity(matrix.rows()).scaled(&ratio(2, 1).pow(-80))), true)
}

/// What is left out, or done wrong.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Slip {
    None,
    /// GWGᵀ
    Carried,
    /// (2w/κ) GWGᵀ
    Spread,
    /// (2/κ) ρTᵀTρᵀ
    Missed,
    /// Half of it.
    HalfMissed,
    /// κ = 1
    Kappa,
    /// κ = 1 − η
    KappaWithoutSpread,
    /// κ = 1 − w
    KappaWithoutEta,
    /// J − P̃₊
    Pad,
    /// α
    Alpha,
    /// 1/α
    InverseAlpha,
    /// The factor 3.
    Three,
    MeanSpread,
    MeanMissed,
    Rounding,
    /// GEGᵀ
    MeanCarried,
    /// τ² without what E adds.
    SquareWithoutEllipsoid,
    /// τ² without ν̃.
    SquareWithoutInnovation,
}

const OF_COVARIANCE: [Slip; 8] = [
    Slip::Carried,
    Slip::Spread,
    Slip::Missed,
    Slip::HalfMissed,
    Slip::Kappa,
    Slip::KappaWithoutSpread,
    Slip::KappaWithoutEta,
    Slip::Pad,
];

const OF_MEAN: [Slip; 9] = [
    Slip::Alpha,
    Slip::InverseAlpha,
    Slip::Three,
    Slip::MeanSpread,
    Slip::MeanMissed,
    Slip::Rounding,
    Slip::MeanCarried,
    Slip::SquareWithoutEllipsoid,
    Slip::SquareWithoutInnovation,
];

struct Start {
    path: Path<Rational>,
    covariance: Q,
    gap: Q,
    mean: Q,
    ellipsoid: Q,
}

fn rows(entries: &[&[(i64, i64)]]) -> Q {
    Matrix::from_rows(entries.iter().map(|row| row.iter().map(|&(a, b)| ratio(a, b)).collect()).collect())
        .expect("rows of one length")
}

fn noise() -> (Q, Q, Q) {
    // Q, S, R
    (
        rows(&[&[(1, 2), (1, 8)], &[(1, 8), (1, 1)]]),
        rows(&[&[(1, 4), (0, 1)], &[(1, 8), (1, 2)]]),
        rows(&[&[(1, 1), (1, 4)], &[(1, 4), (2, 1)]]),
    )
}

fn start(timing: Timing) -> Start {
    let covariance = rows(&[&[(2, 1), (1, 2)], &[(1, 2), (1, 1)]]);
    let mean = rows(&[&[(1, 1)], &[(-2, 1)]]);
    let (process, cross, observation) = noise();
    let before = if timing == Timing::Arriving { Before::Transition } else { Before::Observation };
    let system = System {
        timing,
        initial: Initial::new(before, mean.clone(), covariance.clone()),
        transition: transition().into(),
        observation: sensors().into(),
        noise: Noise::Covariances {
            process: process.into(),
            cross: Some(cross.into()),
            observation: observation.into(),
        },
        input: None,
        observation_input: None,
    };
    let path = system.realised(&[Observation::complete([ratio(9, 2), ratio(-3, 1)])]).expect("a sound system");
    let gap = Matrix::identity(2).scaled(&ratio(1, 32));
    Start {
        path,
        covariance: covariance + rows(&[&[(1, 64), (0, 1)], &[(0, 1), (-1, 64)]]),
        gap,
        mean: mean + rows(&[&[(1, 16)], &[(-1, 32)]]),
        ellipsoid: rows(&[&[(1, 64), (0, 1)], &[(0, 1), (1, 64)]]),
    }
}

fn transition() -> Q {
    rows(&[&[(1, 1), (1, 2)], &[(-1, 4), (3, 4)]])
}

fn sensors() -> Q {
    rows(&[&[(1, 1), (1, 2)], &[(0, 1), (1, 1)]])
}

/// Whether the claim about one target with a slip is accepted. k is that of α.
#[allow(clippy::too_many_lines, reason = "the inequalities as they stand on the page")]
fn checked(timing: Timing, is_ahead: bool, slip: Slip, k: i32) -> Result<(), Rejection> {
    let start = start(timing);
    let (process, cross, observation) = noise();
    let (a, c) = (transition(), sensors());
    // The law in one form.
    let (h, r, filtered, ahead) = match timing {
        Timing::Departing => {
            let still = (Matrix::identity(2), Matrix::zeros(2, 2), Matrix::zeros(2, 2));
            (c, observation, still, Some((a, process, cross)))
        }
        Timing::Arriving => {
            let mixed = &c * &cross;
            let r = observation + c.congruence(&process) + &mixed + mixed.transpose();
            let s = &process * c.transpose() + cross;
            (&c * &a, r, (a, process, s), None)
        }
    };
    let start_document = BeliefDocument {
        covariance: dyadic(&start.covariance, true),
        gap: dyadic(&start.gap, true),
        mean: dyadic(&start.mean, false),
        ellipsoid: dyadic(&start.ellipsoid, true),
        ..BeliefDocument::default()
    };
    let sigma = h.congruence(&start.covariance) + &r;
    // Roughly the inverse of a factor of Σ̃, on a grid of 1/64.
    let t = {
        let inverse = sigma.inverse().expect("regular");
        let root = |value: &Rational| {
            let scaled = (value * ratio(4096, 1)).to_integer().sqrt();
            Rational::new(scaled, 64.into())
        };
        // [[p, q], [0, s]] with TᵀT = Σ⁻¹.
        let p = root(&inverse[(0, 0)]);
        let q = (&inverse[(0, 1)] / &p * ratio(64, 1)).round() / ratio(64, 1);
        let s = root(&(&inverse[(1, 1)] - &q * &q));
        Matrix::from_rows(vec![vec![p, q], vec![ratio(0, 1), s]]).expect("square")
    };
    let off = &t * &sigma * t.transpose() - Matrix::identity(2);
    let size = |x: &Rational| if *x < ratio(0, 1) { -x } else { x.clone() };
    let eta = (0..2).map(|i| size(&off[(i, 0)]) + size(&off[(i, 1)])).max().expect("two");
    let through = &t * &h;
    let trace = |matrix: &Q| &matrix[(0, 0)] + &matrix[(1, 1)];
    let w = trace(&through.congruence(&start.gap));
    let one = ratio(1, 1);
    let kappa = match slip {
        Slip::Kappa => one.clone(),
        Slip::KappaWithoutSpread => &one - &eta,
        Slip::KappaWithoutEta => &one - &w,
        _ => &one - &eta - &w,
    };
    assert!(kappa > ratio(1, 4) && eta > ratio(1, 1000) && w > ratio(1, 1000), "κ {kappa}, η {eta}, w {w}");
    let value = Matrix::column(vec![ratio(9, 2), ratio(-3, 1)]) - &h * &start.mean;
    let white = &t * &value;
    let slight = ratio(1, 1024);
    let known = (white.transpose() * &white)[(0, 0)].clone() * (&one + &slight);
    let unknown = trace(&through.congruence(&start.ellipsoid)) * (&one + slight.recip());
    let square = match slip {
        Slip::SquareWithoutEllipsoid => known,
        Slip::SquareWithoutInnovation => unknown,
        _ => known + unknown,
    } / &kappa;
    let claim = |(map, q, s): &(Q, Q, Q), slip: Slip| {
        let gamma = map * &start.covariance * h.transpose() + s;
        // A gain of three bits.
        let gain = (&gamma * sigma.inverse().expect("regular")).map(|x| (x * ratio(8, 1)).round() / ratio(8, 1));
        let closed = map - &gain * &h;
        let missed = ((&gain * &sigma - &gamma) * t.transpose()).map(Clone::clone);
        let missed = &missed * missed.transpose();
        let mixed = &gain * s.transpose();
        let joseph = closed.congruence(&start.covariance) + q - &mixed - mixed.transpose() + gain.congruence(&r);
        let carried = closed.congruence(&start.gap);
        let two = ratio(2, 1);
        let pad = ratio(1, 256);
        let covariance = &joseph + rows(&[&[(1, 256), (0, 1)], &[(0, 1), (-1, 256)]]);
        let mut gap = Matrix::zeros(2, 2);
        let mut add = |dropped: &[Slip], term: Q| {
            if !dropped.contains(&slip) {
                gap = &gap + term;
            }
        };
        add(&[Slip::Carried], carried.clone());
        add(&[Slip::Spread], carried.scaled(&(&two * &w / &kappa)));
        add(&[Slip::Missed], missed.scaled(&(&one / &kappa)));
        add(&[Slip::Missed, Slip::HalfMissed], missed.scaled(&(&one / &kappa)));
        add(&[Slip::Pad], Matrix::identity(2).scaled(&pad));

        let moved = map * &start.mean + &gain * &value;
        let epsilon = Matrix::column(vec![ratio(1, 128), ratio(-1, 64)]);
        let mut local = Matrix::zeros(2, 2);
        let mut add = |dropped: Slip, term: Q| {
            if slip != dropped {
                local = &local + term;
            }
        };
        add(Slip::MeanSpread, carried.scaled(&(&w * &square / &kappa)));
        add(Slip::MeanMissed, missed.scaled(&(&square / &kappa)));
        add(Slip::Rounding, &epsilon * epsilon.transpose());
        let alpha = ratio(2, 1).pow(-k);
        let shrunk = closed.congruence(&start.ellipsoid);
        let first = match slip {
            Slip::Alpha => one.clone(),
            Slip::MeanCarried => ratio(0, 1),
            _ => &one + &alpha,
        };
        let second = if slip == Slip::InverseAlpha { one.clone() } else { &one + alpha.recip() };
        let factor = if slip == Slip::Three { one.clone() } else { ratio(3, 1) };
        let ellipsoid = shrunk.scaled(&first) + local.scaled(&(second * factor));
        BeliefDocument {
            gain: Some(dyadic(&gain, false)),
            balance: Some(k.into()),
            covariance: dyadic(&covariance, true),
            gap: raised(&gap),
            mean: dyadic(&(moved - epsilon), false),
            ellipsoid: raised(&ellipsoid),
        }
    };
    let slip_of = |ahead: bool| if ahead == is_ahead { slip } else { Slip::None };
    let document = StepDocument {
        step: 0,
        kept: None,
        whitening: Some(dyadic(&t, false)),
        predicted: (timing == Timing::Arriving).then(|| {
            let (map, q, _) = &filtered;
            BeliefDocument {
                balance: None,
                covariance: dyadic(&(map.congruence(&start.covariance) + q), true),
                gap: dyadic(&map.congruence(&start.gap), true),
                mean: dyadic(&(map * &start.mean), false),
                ellipsoid: dyadic(&map.congruence(&start.ellipsoid), true),
                gain: None,
            }
        }),
        filtered: claim(&filtered, slip_of(false)),
        ahead: ahead.as_ref().map(|ahead| claim(ahead, slip_of(true))),
    };
    let mut check = FilterCheck::begin(start.path.timing(), start.path.initial(), &start_document)?;
    check.step(&start.path.steps()[0], &document).map(|_| ())
}

/// EK-L7, EK-T1, EK-T2: each term of the inequalities is needed: the claim that stands on all of them is accepted, and no narrower one.
#[test]
fn no_term_may_be_left_out() {
    for (timing, is_ahead) in [(Timing::Departing, false), (Timing::Departing, true), (Timing::Arriving, false)] {
        for k in [-2, 0, 3] {
            assert_eq!(checked(timing, is_ahead, Slip::None, k), Ok(()), "{timing:?} {is_ahead}");
            for (slips, condition) in [(&OF_COVARIANCE[..], Condition::Covariance), (&OF_MEAN[..], Condition::Mean)] {
                for &slip in slips {
                    let found = checked(timing, is_ahead, slip, k).expect_err("a term is missing");
                    assert_eq!(found.condition, condition, "{timing:?} {is_ahead} {slip:?} {k}: {found}");
                }
            }
        }
    }
}
