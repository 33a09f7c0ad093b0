//! Table 1: what is consistent in it, what cannot be, and what simulation says of its claims.

use exact_kalman::float::Linearisation;
use exact_kalman::reproduce::bioreactor::{
    Band, Earlier, Errors, Exponent, Options, PRINTED, Preset, Setting, Truth, figure, mean_squared_error, realised,
    relative_efficiency, standard_predictions_exact, table, trial,
};
use exact_kalman::scalar::{Rational, ratio};

use super::NATURAL;

fn hundredths(value: i32) -> Rational {
    ratio(i64::from(value), 100)
}

/// HV-Delta, HV-Tab1: every printed Δ is that of two numbers which round to the printed errors, rounded itself.
#[test]
fn printed_efficiencies_fit_the_printed_errors() {
    let half = ratio(1, 200);
    for row in PRINTED {
        let [standard, extended] = [hundredths(row.standard), hundredths(row.extended)];
        // Δ grows with the extended error and falls with the standard one.
        let least = relative_efficiency(&(&standard + &half), &(&extended - &half)).expect("not zero");
        let greatest = relative_efficiency(&(standard - &half), &(extended + &half)).expect("not zero");
        let printed = hundredths(row.efficiency);
        assert!(least <= &printed + &half && &printed - &half <= greatest, "β = {}", row.exponent);
    }
    assert_eq!(relative_efficiency(&ratio(4, 1), &ratio(5, 1)), Some(ratio(25, 1)));
    assert_eq!(relative_efficiency(&ratio(0, 1), &ratio(5, 1)), None);
}

/// The first two terms of MS_SKP over 149, without noise, from the exact predictor under the printed start.
fn two_terms(exponent: Exponent, substrate: &Rational, reading: &Rational) -> Rational {
    let mut setting = Setting::printed(exponent, 1);
    setting.earlier[0] = Earlier { substrate: substrate.clone(), reading: reading.clone() };
    let states = setting.simulated(&[[ratio(0, 1), ratio(0, 1)]]).expect("positive");
    let y: Vec<_> = states.iter().map(|[_, substrate]| substrate.clone()).collect();
    let path = realised(&setting, &Preset::Printed.start(1).standard, true, &y).expect("under the override");
    let laws = standard_predictions_exact(&path, 1).expect("regular");
    let errors: Vec<_> = states.iter().zip(&laws).map(|([biomass, _], law)| biomass - &law.mean[(0, 0)]).collect();
    mean_squared_error(&errors, 150).expect("150 steps")
}

/// Erratum HV-Tab1: the errors 15 and (435/4)(1 + μ(1) − u(1)), plus noise ξ_B(1) of variance 1/10, make MS_SKP at least
/// 2790009/38144 > 73.14 for x_S(0), y(0) ≥ 0; the printed 65.38 and 70.52 would need ξ_B(1) beyond 18 and 6 standard
/// deviations. HV-MS.SKP: the divisor is 149.
#[test]
fn the_printed_standard_errors_are_too_small() {
    let bound = ratio(2_790_009, 38_144);
    let e2 = ratio(435, 4) * ratio(19, 20);
    assert_eq!((ratio(225, 1) + &e2 * &e2) / ratio(149, 1), bound);
    for exponent in [Exponent::Natural(2), Exponent::Natural(1), Exponent::Real(0.5), Exponent::Natural(0)] {
        for (substrate, reading) in [(0, 0), (0, 30), (30, 0), (30, 30), (3, 400), (1000, 1)] {
            let (substrate, reading) = (ratio(substrate, 1), ratio(reading, 1));
            let terms = two_terms(exponent, &substrate, &reading);
            // The general form of e(2), with the laws written out: μ ≥ 0 and u ≤ 1/20 give the bound.
            let setting = Setting::printed(exponent, 1);
            let growth = setting.reactor.growth_rate(&substrate).expect("a rate");
            let dilution = ratio(1, 20) / (&reading + ratio(1, 1));
            assert!(growth >= ratio(0, 1) && dilution <= ratio(1, 20));
            let e2 = ratio(435, 4) * (ratio(1, 1) + growth - dilution);
            assert_eq!(terms, (ratio(225, 1) + &e2 * &e2) / ratio(149, 1));
            assert!(terms >= bound);
            assert_eq!(terms == bound, substrate == ratio(0, 1) && reading == ratio(0, 1));
        }
    }
    // At x_S(0) = y(0) = 30, rounded to hundredths.
    let at_thirty = NATURAL.map(|exponent| two_terms(exponent, &ratio(30, 1), &ratio(30, 1)));
    assert_eq!(
        at_thirty.map(|terms| (terms * ratio(100, 1)).round()),
        [8296, 9671, 10062].map(|value| ratio(value, 1))
    );
    // Even with noise of −18 (−6) standard deviations at the bound, more than what rounds to the printed value.
    for (row, deviations, noise) in [(PRINTED[0], 18, ratio(-569, 100)), (PRINTED[1], 6, ratio(-189, 100))] {
        assert!(&noise * &noise <= ratio(deviations * deviations, 10));
        let e2 = &e2 + noise;
        let printed = hundredths(row.standard) + ratio(1, 200);
        assert!((ratio(225, 1) + &e2 * &e2) / ratio(149, 1) > printed, "β = {}", row.exponent);
        assert!(bound > printed);
    }
}

fn one_step(preset: Preset, old: i64, linearisation: Linearisation) -> Options {
    with(Options::one_step(preset.start(1)), old, linearisation)
}

fn two_steps(preset: Preset, old: i64, linearisation: Linearisation) -> Options {
    with(Options::two_steps(preset.start(2)), old, linearisation)
}

fn with(mut options: Options, old: i64, linearisation: Linearisation) -> Options {
    options.start.allow_indefinite = true;
    options.start.linearisation = linearisation;
    for i in 2..options.start.extended.mean.rows() {
        options.start.extended.mean[(i, 0)] = ratio(old, 1);
    }
    options
}

fn runs(options: &Options, exponent: Exponent, count: u64) -> Vec<Errors> {
    (0..count).map(|run| trial(options, exponent, run).expect("a course")).collect()
}

fn efficiency(errors: &Errors) -> f64 {
    relative_efficiency(&errors.standard, &errors.extended).expect("noise")
}

fn efficiencies(options: &Options, exponent: Exponent, count: u64) -> Band {
    Band::of(runs(options, exponent, count).iter().map(efficiency).collect()).expect("runs")
}

/// HV-Tab1, simulated: with the printed start no printed MS_SKP lies between the smallest and the largest of forty runs, for
/// any β. A value inside the central 9/10 of the law would fall outside of all forty with probability 2·0.95⁴⁰ < 0.26; here
/// the nearest run is farther off than the forty are apart.
#[test]
fn the_printed_start_does_not_give_the_table() {
    let options = one_step(Preset::Printed, 30, Linearisation::Prediction);
    for row in PRINTED {
        let all = runs(&options, row.exponent, 40);
        let least = all.iter().map(|errors| errors.standard).fold(f64::INFINITY, f64::min);
        let greatest = all.iter().map(|errors| errors.standard).fold(0.0, f64::max);
        let printed = f64::from(row.standard) / 100.0;
        assert!(least - printed > greatest - least, "β = {}: {printed} and {least} … {greatest}", row.exponent);
    }
}

/// HV-Tab1, simulated: the closest start found has each of the thirty printed numbers inside its own band of 5 to 95 %, but
/// not how they change with β: MS_SKP(0) − MS_SKP(1) is printed as 4.93, and is less in every one of a hundred runs (more than
/// 4.93 in 5 % of them would show with probability 0.994).
#[test]
fn the_closest_start_is_a_fit_and_no_reproduction() {
    let mut options = Options { runs: 60, ..Options::one_step(Preset::Closest.start(1)) };
    options.start.allow_indefinite = true;
    for row in table(&options).expect("meaningful options").rows {
        let printed = row.printed.expect("one step ahead");
        for (band, printed) in
            [(row.standard, printed.standard), (row.extended, printed.extended), (row.efficiency, printed.efficiency)]
        {
            let band = band.expect("runs");
            assert!(band.contains(f64::from(printed) / 100.0), "β = {}: {printed} and {band:?}", row.exponent);
        }
    }
    for run in 0..100 {
        let standard = |beta| trial(&options, Exponent::Natural(beta), run).expect("a course").standard;
        assert!(standard(0) - standard(1) < 4.93, "run {run}");
    }
}

/// HV-Tab1, HV-EKP: the size of Δ is decided by what the paper does not say. Medians of sixty runs at β = 0 lie between 1/2
/// and 5000 per cent; the bands beside them were taken from 300 runs, and none of them meets another.
#[test]
fn what_is_not_given_decides_the_efficiency() {
    use Linearisation::{Filtered, Prediction};
    for (preset, old, linearisation, low, high) in [
        (Preset::Printed, 30, Prediction, 0.1, 1.1),
        (Preset::Printed, 45, Prediction, 7.0, 10.4),
        (Preset::Printed, 45, Filtered, 50.0, 64.0),
        (Preset::Printed, 30, Filtered, 2400.0, 2900.0),
        (Preset::Repaired, 45, Filtered, 10.5, 13.7),
    ] {
        let band = efficiencies(&one_step(preset, old, linearisation), Exponent::Natural(0), 60);
        assert!(low < band.median && band.median < high, "{preset}, {old}, {linearisation:?}: {band:?}");
    }
}

/// HV-Fig2, HV-Tab1: "uniformly better" is false. Two steps ahead, with the printed start, ẑ = 30 and linearisation at the
/// prediction, the *extended* predictor is better in nearly every run for β ≤ 1 (1998 of 2000 at β = 1, all below). Of a
/// hundred runs at least 98: if it were better in fewer than 90 % of all, this would happen with probability below 0.2 %.
#[test]
fn the_extended_predictor_can_be_better_in_nearly_every_run() {
    let better = |errors: &[Errors]| errors.iter().filter(|errors| errors.extended < errors.standard).count();
    let options = two_steps(Preset::Printed, 30, Linearisation::Prediction);
    for exponent in [Exponent::Natural(1), Exponent::Real(0.5), Exponent::Natural(0)] {
        let count = better(&runs(&options, exponent, 100));
        assert!(count >= 98, "β = {exponent}: {count}");
    }
    // And with the doubt about the two old substrates independent instead of one.
    let mut apart = options;
    apart.start.extended.covariance[(2, 3)] = ratio(0, 1);
    apart.start.extended.covariance[(3, 2)] = ratio(0, 1);
    assert!(better(&runs(&apart, Exponent::Natural(1), 40)) >= 38);
    // It is no matter of the indefinite start: with P_BB = 5000 in more than nine runs of ten (99 % of a thousand).
    let repaired = runs(&Options::two_steps(Preset::Repaired.start(2)), Exponent::Natural(1), 100);
    assert!(better(&repaired) > 90);
    // One step ahead it is sometimes better too, at β = 2 in more than one run of ten.
    let closest = one_step(Preset::Closest, 10, Linearisation::Prediction);
    let count = better(&runs(&closest, Exponent::Natural(2), 100));
    assert!(count > 10, "{count}");
}

/// HV-EKP: two steps ahead in the filter form, from ẑ = 30, the estimate of the old substrate turns negative for β ≤ 1/2: the
/// runs stop, and the table counts them.
#[test]
fn runs_that_stop_are_counted() {
    let options = Options { runs: 2, steps: 20, ..two_steps(Preset::Printed, 30, Linearisation::Filtered) };
    let table = table(&options).expect("meaningful options");
    assert_eq!(table.rows.len(), 10);
    for row in &table.rows {
        let stops = !matches!(row.exponent, Exponent::Natural(1 | 2) | Exponent::Real(0.8));
        assert_eq!((row.failed, row.standard.is_none()), if stops { (2, true) } else { (row.failed, row.failed == 2) });
        assert_eq!(row.printed, None, "the paper has no table for two steps");
    }
    assert!(table.to_string().contains("2 failed"));
}

/// HV-SKP: where the start is drawn from a law, and the standard predictor begins with the law of x(1) given y(0), it is not
/// worse on average, one and two steps ahead.
///
/// Six steps and β ≤ 1, chosen because it shows there. Not significant at 2.33 are β = 2 (scores 1.39 and 1.80, one and two
/// steps ahead, after six steps, 1.58 and 1.75 after 150), and two steps ahead over 150 steps β = 1 (1.79) and β = 0 (1.54),
/// where noise drives the tank dry in 25 and 64 of 300 runs, which give no error. One step ahead, 150 steps have 2.37 and 2.75.
///
/// 300 runs, one-sided: the mean of MS_EKP − MS_SKP is above −2.33 of its standard errors, which fails in 1 % of all cases
/// if the two were equally good. It has power: the mean found is above +2.33 standard errors, so with the two exchanged the
/// same test fails. As the setting was chosen, that figure is no level of significance.
#[test]
fn with_a_true_law_the_standard_predictor_is_not_worse() {
    for base in [Options::one_step(Preset::Drawn.start(1)), Options::two_steps(Preset::Drawn.start(2))] {
        for exponent in [Exponent::Natural(1), Exponent::Natural(0)] {
            let options = Options { truth: Truth::Drawn, steps: 6, ..base.clone() };
            let differences: Vec<f64> =
                runs(&options, exponent, 300).iter().map(|errors| errors.extended - errors.standard).collect();
            let mean = differences.iter().sum::<f64>() / 300.0;
            let variance = differences.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / 299.0;
            let score = mean / (variance / 300.0).sqrt();
            assert!(score > -2.33, "worse: {score}");
            assert!(score > 2.33, "no power: {score}");
        }
    }
}

/// HV-SKP: the drawn start is drawn from its law. Over 300 runs two squares have the mean that they should, within four
/// standard errors (a χ² with one degree of freedom has variance 2): that of the standard predictor's first error over the
/// variance it claims, and that of the noise in x_B(2), given the old substrate z from which that prediction was made.
#[test]
fn the_drawn_start_is_calibrated() {
    // P(1|0) of the biomass given the old substrate: 25 − 2²/9.
    let variance = 25.0 - 4.0 / 9.0;
    let options = Options { truth: Truth::Drawn, steps: 2, ..Options::one_step(Preset::Drawn.start(1)) };
    let (mut errors, mut noise) = (0.0, 0.0);
    for run in 0..300 {
        let [first, second] = figure(&options, Exponent::Natural(0), run).expect("a course").points[..] else {
            panic!("two steps")
        };
        errors += (first.biomass - first.standard).powi(2) / variance / 300.0;
        // x̂_B(1|0) = 25 + (2/9)(z − 30), μ = z/252, u = 1/(20(z + 1)); the noise has variance 1/10.
        let z = 30.0 + 4.5 * (first.standard - 25.0);
        let expected = (1.0 + z / 252.0 - 0.05 / (z + 1.0)) * first.biomass;
        noise += (second.biomass - expected).powi(2) * 10.0 / 300.0;
    }
    let bound = 4.0 * (2.0_f64 / 300.0).sqrt();
    assert!((errors - 1.0).abs() < bound && (noise - 1.0).abs() < bound, "{errors}, {noise}");
}

/// HV-Tab1: the text shows printed and computed numbers, and says which lie inside.
#[test]
fn the_table_as_text() {
    let options = Options { runs: 3, ..one_step(Preset::Printed, 30, Linearisation::Prediction) };
    let table = table(&options).expect("meaningful options");
    let text = table.to_string();
    assert_eq!(text.lines().count(), 1 + 4 * 10);
    assert!(text.lines().nth(1).is_some_and(|line| line.contains("65.38") && line.ends_with("no")), "{text}");
    assert_eq!(
        table.rows[0].standard,
        Band::of(runs(&options, Exponent::Natural(2), 3).iter().map(|e| e.standard).collect())
    );
    let sample = (0..40).map(f64::from).rev().collect();
    assert_eq!(Band::of(sample), Some(Band { low: 2.0, median: 20.0, high: 37.0 }));
    assert_eq!(Band::of(Vec::new()), None);
}
