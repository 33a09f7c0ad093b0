//! Wrong answers that make no known mistake are called wrong, and nothing else.

use exact_kalman::judge::{Diagnosis, Judgement, Truth, Verdict};
use exact_kalman::protocol::{Case, Reply};
use exact_kalman::trace::{Quantity, Values};
use rand_core::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;
use rayon::prelude::*;

use super::filter::Filter;
use super::model::Model;
use super::subject::{Steps, TRUTHS, answer, diagnosis, right_steps};

/// Wrong filters that are not in the catalogue.
const UNKNOWN: [&str; 8] = [
    "fading-memory",
    "gain-times-nine-tenths",
    "first-state-with-the-other-sign",
    "two-steps-late",
    "random-covariances",
    "readings-rounded",
    "process-noise-times-three",
    "steps-in-reverse",
];

/// What such a filter answers.
fn unknown(habit: &str, case: &Case) -> Option<Steps> {
    let mut asked = Model::of(case);
    if habit == "readings-rounded" {
        asked.sights.iter_mut().flat_map(|sight| &mut sight.y).flatten().for_each(|y| *y = (*y * 3.0).round() / 3.0);
    }
    if habit == "process-noise-times-three" {
        asked.motions.iter_mut().flatten().for_each(|motion| motion.q *= 3.0);
    }
    let mut steps = super::subject::steps_of(&Filter { habit, way: 0.0 }, asked)?;
    let right = steps.clone();
    let mut noise = Noise::seeded(7);
    for (k, values) in steps.iter_mut().enumerate() {
        match habit {
            "first-state-with-the-other-sign" => {
                for name in [Quantity::PredictedMean, Quantity::FilteredMean] {
                    if let Some(mean) = values.get_mut(&name) {
                        mean[(0, 0)] = -mean[(0, 0)];
                    }
                }
            }
            "two-steps-late" => *values = right[k.saturating_sub(2)].clone(),
            "random-covariances" => {
                for name in [Quantity::PredictedCovariance, Quantity::FilteredCovariance] {
                    if let Some(covariance) = values.get_mut(&name) {
                        *covariance = covariance.map(|entry| entry * (1.0 + noise.uniform()));
                    }
                }
            }
            "steps-in-reverse" => *values = right[right.len() - 1 - k].clone(),
            _ => {}
        }
    }
    Some(steps)
}

#[test]
fn mistakes_that_are_not_known_are_wrong_without_a_name() {
    for habit in UNKNOWN {
        let (judgements, diagnosis) = diagnosis(|case| unknown(habit, case));
        let findings = judgements.iter().filter(|judgement| judgement.verdict.is_finding()).count();
        assert!(findings >= 10, "{habit}: {findings}");
        assert!(judgements.iter().any(|judgement| judgement.verdict == Verdict::Wrong), "{habit}");
        assert_eq!(diagnosis, Diagnosis::default(), "{habit}");
    }
}

/// Seeded numbers.
struct Noise(Pcg64Mcg);

impl Noise {
    fn seeded(seed: u64) -> Self {
        Self(Pcg64Mcg::seed_from_u64(seed))
    }

    /// From 0 to 1.
    #[expect(clippy::cast_precision_loss, reason = "53 bits")]
    fn uniform(&mut self) -> f64 {
        (self.0.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// From −1 to 1.
    fn sign(&mut self) -> f64 {
        2.0 * self.uniform() - 1.0
    }
}

/// How many wrong answers are drawn for each case; to draw more: `ACCUSED=1000 cargo test --test judge accused`.
fn draws() -> u64 {
    std::env::var("ACCUSED").ok().and_then(|text| text.parse().ok()).unwrap_or(60)
}

/// A wrong answer: the right one with relative noise of some size between 10⁻¹ and 10⁻¹², or with a bias, or in one
/// quantity alone, or that of a problem one of whose data is another one.
fn drawn(case: &Case, seed: u64) -> Option<Steps> {
    let mut noise = Noise::seeded(seed);
    let size = 10_f64.powf(-1.0 - 11.0 * noise.uniform());
    if seed % 4 == 3 {
        let mut model = Model::of(case);
        let factor = 1.0 + noise.sign();
        let which = noise.uniform();
        for motion in model.motions.iter_mut().flatten() {
            match which {
                _ if which < 0.2 => motion.a *= factor,
                _ if which < 0.4 => motion.q *= factor,
                _ => {}
            }
        }
        for sight in &mut model.sights {
            match which {
                _ if which < 0.4 => {}
                _ if which < 0.6 => sight.c *= factor,
                _ if which < 0.8 => sight.r *= factor,
                _ => {}
            }
        }
        if which >= 0.8 {
            model.p *= factor;
        }
        return super::subject::steps_of(&Filter { habit: "", way: 0.0 }, model);
    }
    let mut steps = right_steps(case)?;
    let bias = noise.sign();
    let alone = Quantity::ALL[usize::try_from(seed / 4 % 6).expect("a place")];
    for (&name, matrix) in steps.iter_mut().flat_map(|values: &mut Values<f64>| values.iter_mut()) {
        *matrix = match seed % 4 {
            0 => matrix.map(|entry| entry * (1.0 + size * noise.sign())),
            1 => matrix.map(|entry| entry + size * bias),
            _ if name == alone => matrix.map(|entry| entry * (1.0 + size * noise.sign())),
            _ => matrix.clone(),
        };
    }
    Some(steps)
}

/// The rate of false accusations: none of some thousand wrong answers drawn at random gets a name, case by case, without
/// others that would outvote it.
#[test]
fn no_wrong_answer_drawn_at_random_is_named() {
    let seeds: Vec<(usize, u64)> =
        (0..TRUTHS.len()).flat_map(|place| (0..draws()).map(move |draw| (place, draw))).collect();
    let judged: Vec<(bool, Vec<String>)> = seeds
        .into_par_iter()
        .filter_map(|(place, draw)| {
            let (case, truth): &(Case, Truth) = &TRUTHS[place];
            let reply = Reply::Answer(answer(case, Some(drawn(case, draw)?)));
            let judgement = Judgement::of(case.expect, truth, &reply);
            let names = Diagnosis::of([&judgement]).explanations;
            let names = names.iter().map(|one| format!("{} draw {draw}: {} {:?}", case.id, one.mistake.name, one.ways));
            Some((judgement.verdict.is_finding(), names.collect()))
        })
        .collect();
    let (answers, findings) = (judged.len(), judged.iter().filter(|(finding, _)| *finding).count());
    let named: Vec<&String> = judged.iter().flat_map(|(_, names)| names).collect();
    println!("{answers} answers drawn at random, {findings} of them findings, {} named", named.len());
    assert!(named.is_empty(), "{named:#?}");
    assert!(findings * 2 > answers, "{findings} of {answers}");
}
