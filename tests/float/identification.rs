//! The f64 estimators against the exact ones on the same doubles, by attainable digits.
//!
//! What the data allow is what is left when every datum is moved by a relative 2⁻⁵³, up or down: the worst of twenty such
//! moves. As in the verdicts of the judge, two digits may be lost on top of that, and nothing below is tuned. Estimation
//! and filter are judged apart: the filter on the estimates that were found, as the doubles they are, with B(n,1) and
//! B(n,2) + I for V̂ and Ŵ, so that no repair and no pseudo-inverse of a singular sum, neither of them continuous, comes in
//! between. The repairs have a test of their own.
#![cfg(feature = "judge")]

use exact_kalman::float;
use exact_kalman::identify::{Belief, EstimatedModel, NoiseCovariances, Series, estimates};
use exact_kalman::matrix::Matrix;
use exact_kalman::model::{Reading, Repair};
use exact_kalman::reproduce::Stream;
use exact_kalman::scalar::Precision;
use exact_kalman::scalar::{Rational, exact_value, ratio};
use nalgebra::{SMatrix, SVector};
use num_traits::ToPrimitive;

/// How many digits a good program may lose: the constant of the verdicts.
const ALLOWED_LOSS: f64 = 2.0;

type Q = Matrix<Rational>;

/// The matrices that are compared at one step.
type Step = Vec<Q>;

/// Â(k), V̂(k), Ŵ(k), y(k) in f64.
type Model<const P: usize> = (SMatrix<f64, P, P>, SMatrix<f64, P, P>, SMatrix<f64, P, P>, SVector<f64, P>);

/// What every number that enters is passed through.
type Datum<'a> = dyn FnMut(&Rational) -> Rational + 'a;

/// Â, B(1), B(2), and V̂, Ŵ where they exist.
fn exact_estimates<const P: usize>(readings: &[SVector<f64, P>], reading: Reading, datum: &mut Datum) -> Vec<Step> {
    let readings = readings.iter().map(|y| rational(y).entries().iter().map(&mut *datum).collect()).collect();
    let step = |one: exact_kalman::identify::Estimates<Rational>| {
        let noise = one.noise().map(|noise| [noise.process, noise.observation]);
        let mut step = vec![one.transition, one.residuals.one_step, one.residuals.two_step];
        step.extend(noise.into_iter().flatten());
        step
    };
    let series = Series::new(readings).expect("a series");
    estimates(&series, reading).expect("rationals").into_iter().map(step).collect()
}

fn found_estimates<const P: usize>(readings: &[SVector<f64, P>], reading: Reading) -> Vec<float::Estimates<P>> {
    let mut estimator = float::Estimator::<P>::new(reading);
    let each = readings.iter().map(|y| {
        estimator.observe(*y).expect("regular lag sums");
        estimator.estimates()
    });
    each.collect::<Vec<_>>().into_iter().flatten().collect()
}

fn matrices<const P: usize>(one: &float::Estimates<P>) -> Step {
    let mut step = [&one.transition, &one.one_step, &one.two_step].map(rational).to_vec();
    step.extend(one.noise().map(|(v, w)| [v, w].map(|matrix| rational(&matrix))).into_iter().flatten());
    step
}

/// Ŝ, Δ̂, P̂ and x̂, from P̂ = I and x̂ = 0.
fn exact_filter<const P: usize>(models: &[Model<P>], datum: &mut Datum) -> Vec<Step> {
    // Long fractions to 512 bits, far more than is compared.
    let short = |matrix: &Q| matrix.map(|entry| Precision::Rounded { bits: 512 }.of(entry));
    let mut belief = Belief { mean: Matrix::zeros(P, 1), covariance: Matrix::identity(P).map(&mut *datum) };
    let step = |(a, v, w, y): &Model<P>| {
        let mut covariance = |matrix: &SMatrix<f64, P, P>| {
            let moved = rational(matrix).map(&mut *datum);
            Matrix::from_fn(P, P, |i, j| moved[(i.max(j), i.min(j))].clone())
        };
        let noise = NoiseCovariances { process: covariance(v), observation: covariance(w) };
        let model = EstimatedModel { transition: rational(a).map(&mut *datum), noise };
        let (s, gain, next) = belief.advanced(&model, &rational(y).map(&mut *datum)).expect("rationals");
        belief = Belief { mean: short(&next.mean), covariance: short(&next.covariance) };
        vec![s, gain, belief.covariance.clone(), belief.mean.clone()]
    };
    models.iter().map(step).collect()
}

fn found_filter<const P: usize>(models: &[Model<P>]) -> Vec<Step> {
    let mut filter = float::AdaptiveFilter::new(SVector::zeros(), SMatrix::<f64, P, P>::identity(), Repair::Zero);
    let step = |&(a, v, w, y): &Model<P>| {
        let gained = filter.advance(a, v, w, y).expect("regular sums");
        let mut step = [&gained.predicted_covariance, &gained.gain, &filter.covariance].map(rational).to_vec();
        step.push(rational(&filter.mean));
        step
    };
    models.iter().map(step).collect()
}

fn rational<const R: usize, const C: usize>(matrix: &SMatrix<f64, R, C>) -> Q {
    Matrix::from_fn(R, C, |i, j| exact_value(matrix[(i, j)]).expect("finite"))
}

fn largest(matrix: &Q) -> f64 {
    matrix.entries().iter().map(|entry| entry.to_f64().expect("in range").abs()).fold(0.0, f64::max)
}

/// −log₁₀ of the greatest error over the scale, at most 16.
fn digits(found: &Q, truth: &Q, scale: f64) -> f64 {
    let error = largest(&(found - truth));
    if error == 0.0 { 16.0 } else { (-(error / scale).log10()).min(16.0) }
}

/// y(1 ± 2⁻⁵³), to 64 bits.
fn moved(y: &Rational, stream: &mut Stream) -> Rational {
    let unit = ratio(1, 1 << 53);
    let value = if stream.uniform() < 0.5 { y + y * unit } else { y - y * unit };
    Precision::Rounded { bits: 64 }.of(&value)
}

fn agrees(name: &str, found: &[Step], exact: impl Fn(&mut Datum) -> Vec<Step>) {
    let exact_steps = exact(&mut Rational::clone);
    assert_eq!(found.len(), exact_steps.len());
    let mut stream = Stream::named(&format!("perturbations of {name}"), 20);
    let nearby: Vec<_> = (0..20).map(|_| exact(&mut |y| moved(y, &mut stream))).collect();
    let mut judged = 0;
    for (k, (found, truth)) in found.iter().zip(&exact_steps).enumerate() {
        assert_eq!(found.len(), truth.len(), "{name}: step {k}");
        for (which, (found, truth)) in found.iter().zip(truth).enumerate() {
            // The greatest entry; where the exact matrix is zero, that of the whole run.
            let own = largest(truth);
            let run = || exact_steps.iter().filter_map(|step| step.get(which)).map(largest).fold(0.0, f64::max);
            let scale = if own == 0.0 { run() } else { own };
            let attainable = nearby.iter().map(|steps| digits(&steps[k][which], truth, scale)).fold(16.0, f64::min);
            let kept = digits(found, truth, scale);
            assert!(
                kept >= attainable - ALLOWED_LOSS,
                "{name}, step {k}, {which}: {kept:.1} of {attainable:.1} digits"
            );
            judged += usize::from(attainable > 10.0);
        }
    }
    assert!(judged >= 3 * found.len(), "{name}: {judged} matrices have ten attainable digits");
}

fn both_agree<const P: usize>(readings: &[SVector<f64, P>], reading: Reading) {
    let estimates = found_estimates(readings, reading);
    let name = format!("estimates, {} {P}", reading.name());
    let found: Vec<Step> = estimates.iter().map(matrices).collect();
    agrees(&name, &found, |datum| exact_estimates(readings, reading, datum));
    let model = |(one, y): (&float::Estimates<P>, &SVector<f64, P>)| {
        (one.transition, one.one_step, one.two_step + SMatrix::<f64, P, P>::identity(), *y)
    };
    let models: Vec<Model<P>> = estimates.iter().zip(&readings[2..]).map(model).collect();
    let name = format!("filter, {} {P}", reading.name());
    agrees(&name, &found_filter(&models), |datum| exact_filter(&models, datum));
}

fn simulated<const P: usize>(seed: u64, n: usize) -> Vec<SVector<f64, P>> {
    let mut stream = Stream::named("float/identification", seed);
    let mut x = SVector::<f64, P>::repeat(8.0);
    let mut step = || {
        // Three quarters of every component, and an eighth of its neighbour.
        x = SVector::from_fn(|i, _| 0.75 * x[i] + 0.125 * x[(i + 1) % P] + stream.normal());
        x + SVector::from_fn(|_, _| stream.normal())
    };
    (0..n).map(|_| step()).collect()
}

/// AK-2.1, AK-2.2, AK-B.hat, AK-2.3a, AK-2.4 in f64, for one to three components and all readings of (2.2).
#[test]
fn estimators_keep_the_attainable_digits() {
    for reading in Reading::ALL {
        both_agree(&simulated::<1>(1, 10), reading);
        both_agree(&simulated::<2>(2, 7), reading);
    }
    // Its fractions are short enough for three components.
    both_agree(&simulated::<3>(7, 9), Reading::Last);
}

#[test]
fn a_singular_lag_sum_is_told() {
    let mut estimator = float::Estimator::<1>::new(Reading::Printed);
    for y in [1.0, 0.0] {
        assert_eq!(estimator.observe(SVector::<f64, 1>::new(y)), Ok(()));
    }
    assert_eq!(estimator.observe(SVector::<f64, 1>::new(2.0)), Err(float::NoInverse { count: 3 }));
}

/// The policies, on V̂ < 0 and Ŵ < 0 that are told apart by hand: B(1) = 0, B(2) = 12, Â = 3/2 gives V̂ = 26/3, Ŵ = −8/3.
#[test]
fn policies_of_the_adaptive_filter() {
    let number = SMatrix::<f64, 1, 1>::new;
    let estimates =
        float::Estimates { count: 3, transition: number(1.5), one_step: number(0.0), two_step: number(12.0) };
    let gain = |repair: Repair| {
        let mut filter = float::AdaptiveFilter::new(SVector::<f64, 1>::new(0.0), number(0.0), repair);
        filter.observe(&estimates, SVector::<f64, 1>::new(1.0)).map(|gained| gained.gain[(0, 0)])
    };
    // V̂/(V̂ + Ŵ) = 26/18 where Ŵ is kept; 1 where it is zero.
    let kept = gain(Repair::Keep).expect("regular");
    assert!((kept - 26.0 / 18.0).abs() < 4.0 * f64::EPSILON);
    assert_eq!((gain(Repair::Zero), gain(Repair::LastSemidefinite)), (Some(1.0), Some(1.0)));
    let singular = float::Estimates { transition: number(0.0), ..estimates };
    let mut filter = float::AdaptiveFilter::new(SVector::<f64, 1>::new(0.0), number(0.0), Repair::Keep);
    assert_eq!(filter.observe(&singular, SVector::<f64, 1>::new(1.0)), None);
}
