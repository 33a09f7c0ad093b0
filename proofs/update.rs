//! CKS-3, CKS-4 and CKS-K in one dimension, written out, against the filter over the field of five elements.

use std::convert::Infallible;

use exact_kalman::filter::filter;
use exact_kalman::gaussian::ConditionError;
use exact_kalman::matrix::Matrix;
use exact_kalman::model::{Before, Initial, Noise, Observation, Path, System, Timing};
use exact_kalman::scalar::{Field, OrderedField, Residue, Scalar, Undefined, ZeroTest};
use exact_kalman::trace::Moments;

use crate::harness::{Replays, cover, harness};
use crate::matrices::residue;

type F = Residue<5>;

/// A residue that is let through the door where covariances are checked, which asks for an order.
///
/// The order of representatives has zero as its least element, so every variance passes, as it should: modulo a
/// prime nothing is negative. The path is mapped to plain residues before any filter sees it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Admitted(F);

impl PartialOrd for Admitted {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Admitted {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        self.0.representative().cmp(&other.0.representative())
    }
}

impl Scalar for Admitted {
    fn zero() -> Self {
        Self(F::zero())
    }

    fn one() -> Self {
        Self(F::one())
    }

    fn plus(&self, other: &Self) -> Self {
        Self(self.0.plus(&other.0))
    }

    fn minus(&self, other: &Self) -> Self {
        Self(self.0.minus(&other.0))
    }

    fn times(&self, other: &Self) -> Self {
        Self(self.0.times(&other.0))
    }

    fn over(&self, divisor: &Self) -> Result<Self, Undefined> {
        self.0.over(&divisor.0).map(Self)
    }

    fn zero_test(&self) -> ZeroTest {
        self.0.zero_test()
    }
}

impl Field for Admitted {}
impl OrderedField for Admitted {}

/// One transition and one observation of a scalar state, the noise shared by both.
struct Question {
    mean: F,
    variance: F,
    a: F,
    c: F,
    d: F,
    f: F,
    y: F,
}

impl Question {
    fn any() -> Self {
        Self {
            mean: residue(),
            variance: residue(),
            a: residue(),
            c: residue(),
            d: residue(),
            f: residue(),
            y: residue(),
        }
    }

    fn path(&self, timing: Timing) -> Path<F> {
        let one = |value: F| Matrix::column(vec![Admitted(value)]);
        let before = match timing {
            Timing::Arriving => Before::Transition,
            Timing::Departing => Before::Observation,
        };
        let system = System {
            timing,
            initial: Initial::new(before, one(self.mean), one(self.variance)),
            transition: one(self.a).into(),
            observation: one(self.c).into(),
            noise: Noise::Factors { process: one(self.d).into(), observation: one(self.f).into() },
            input: None,
            observation_input: None,
        };
        let Ok(path) = system.realised(&[Observation::complete([Admitted(self.y)])]) else {
            unreachable!("shapes fit and every variance passes")
        };
        let Ok(path) = path.try_map(|entry| Ok::<_, Infallible>(entry.0));
        path
    }
}

/// 1/s, and 0 for 0: the pseudo-inverse of a 1×1 matrix, by trying.
fn pseudo_inverse(s: F) -> F {
    (0..5).map(F::new).find(|t| s.times(t) == F::one()).unwrap_or_else(F::zero)
}

fn is(moments: &Moments<F>, mean: F, variance: F) -> bool {
    moments.mean[(0, 0)] == mean && moments.covariance[(0, 0)] == variance
}

/// x + y
fn add(x: F, y: F) -> F {
    x.plus(&y)
}

/// x y
fn mul(x: F, y: F) -> F {
    x.times(&y)
}

harness! {
    /// CKS-3, CKS-4, CKS-K, CKS-R for scalars: noise shared with the transition that arrives: `S = c²R + f² + 2cdf`, `K = (Rc + df) S⁺`, `P = R − K(cR + fd)`.
    ///
    /// Domain: all a, c, d, f, P, x̂, y modulo 5.
    arriving_update_is_the_formula, unwind 12, Replays::All(78_125), covers ["regular", "singular", "contradiction"], {
        let q = Question::any();
        let r = add(mul(mul(q.a, q.a), q.variance), mul(q.d, q.d));
        let x = mul(q.a, q.mean);
        let gamma = add(mul(r, q.c), mul(q.d, q.f));
        let cdf = mul(mul(q.c, q.d), q.f);
        let s = add(add(mul(mul(q.c, q.c), r), mul(q.f, q.f)), add(cdf, cdf));
        let nu = q.y.minus(&mul(q.c, x));
        let gain = mul(gamma, pseudo_inverse(s));
        let contradiction = s == F::zero() && nu != F::zero();
        cover!(s != F::zero(), "regular");
        cover!(s == F::zero() && !contradiction, "singular");
        cover!(contradiction, "contradiction");
        match filter(&q.path(Timing::Arriving)) {
            Ok(trace) => {
                let record = &trace.records[0];
                assert!(!contradiction && trace.records.len() == 1);
                assert!(is(&record.predicted, x, r));
                assert!(record.innovation[(0, 0)] == nu && record.innovation_covariance[(0, 0)] == s);
                assert!(record.gain[(0, 0)] == gain);
                assert!(is(&record.filtered, add(x, mul(gain, nu)), r.minus(&mul(gain, gamma))));
            }
            Err(error) => assert!(contradiction && matches!(error.source, ConditionError::Inconsistent(_))),
        }
    }
}

harness! {
    /// HV-3, HV-4, HV-5 for scalars: noise shared with the transition that departs: `S = c²P + f²`, `K₊ = (aPc + df) S⁺`, `P₊ = a²P + d² − K₊²S`.
    ///
    /// Domain: all a, c, d, f, P, x̂, y modulo 5.
    departing_update_is_the_formula, unwind 12, Replays::All(78_125), covers ["regular", "singular", "contradiction"], {
        let q = Question::any();
        let gamma = mul(q.variance, q.c);
        let s = add(mul(gamma, q.c), mul(q.f, q.f));
        let nu = q.y.minus(&mul(q.c, q.mean));
        let inverse = pseudo_inverse(s);
        let contradiction = s == F::zero() && nu != F::zero();
        cover!(s != F::zero(), "regular");
        cover!(s == F::zero() && !contradiction, "singular");
        cover!(contradiction, "contradiction");
        match filter(&q.path(Timing::Departing)) {
            Ok(trace) => {
                assert!(!contradiction && trace.records.len() == 1);
                let filtered_mean = add(q.mean, mul(mul(gamma, inverse), nu));
                let filtered_variance = q.variance.minus(&mul(mul(gamma, gamma), inverse));
                assert!(is(&trace.records[0].filtered, filtered_mean, filtered_variance));
                let cross = add(mul(q.a, gamma), mul(q.d, q.f));
                let mean = add(mul(q.a, q.mean), mul(mul(cross, inverse), nu));
                let prior = add(mul(mul(q.a, q.a), q.variance), mul(q.d, q.d));
                let variance = prior.minus(&mul(mul(cross, cross), inverse));
                assert!(trace.ahead.is_some_and(|ahead| is(&ahead, mean, variance)));
            }
            Err(error) => assert!(contradiction && matches!(error.source, ConditionError::Inconsistent(_))),
        }
    }
}
