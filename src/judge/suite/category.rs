//! The categories: the first part of each id.

use super::draw::Draw;
use super::{
    adapted, ahead, arriving, bad_input, basic, collinear, contradiction, conventions, correlated, diffuse, flat,
    input, large, likelihood, long, missing, poles, prior, real, sampling, sensor, single, singular, still, units,
    unstable, varying,
};
use crate::protocol::Case;

/// A category of the suite: the first part of the ids of its cases.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Category {
    /// Its name.
    pub name: &'static str,
    /// What its cases have in common, in one sentence.
    pub about: &'static str,
}

type Cases = fn(Draw) -> Vec<Case>;

const fn category(name: &'static str, about: &'static str, cases: Cases) -> (Category, Cases) {
    (Category { name, about }, cases)
}

/// Ordinary models first.
pub(super) const CASES: [(Category, Cases); 28] = [
    category("basic", "ordinary models of many shapes, well conditioned: what every filter can do", basic::cases),
    category("input", "known inputs, added to the state or to the observation, constant and varying", input::cases),
    category(
        "missing",
        "readings that are missing, wholly or in part, at the beginning, in the middle, at the end",
        missing::cases,
    ),
    category(
        "ahead",
        "readings followed by steps without any: the predicted moments are the d-step prediction",
        ahead::cases,
    ),
    category("varying", "matrices that differ from step to step", varying::cases),
    category(
        "adapted",
        "matrices and inputs that depend on past readings, as in identification and adaptive control",
        adapted::cases,
    ),
    category(
        "conventions",
        "numbers chosen so that each other reading of start, timing, index and order shows",
        conventions::cases,
    ),
    category("correlated", "noise shared between the state and the observation, in both timings", correlated::cases),
    category("arriving", "transitions that lead into their step, and starts that are one step older", arriving::cases),
    category("diffuse", "starts of which nothing, or only a part, is known", diffuse::cases),
    category("likelihood", "data whose log likelihood is easy to get wrong", likelihood::cases),
    category("unstable", "modes that grow: read, not read, hidden by a change of coordinates", unstable::cases),
    category("units", "small and large units, alone and side by side", units::cases),
    category("exact-sensor", "a ladder of sensors whose noise goes to zero", sensor::cases),
    category("flat-prior", "a ladder of initial variances that go to infinity", flat::cases),
    category("still", "a ladder of process noises that go to zero", still::cases),
    category("sampling", "a ladder of shorter and shorter sampling intervals", sampling::cases),
    category("poles", "a ladder of poles that are nearly equal, and modes that are nearly told apart", poles::cases),
    category("collinear", "a ladder of sensors that read nearly the same", collinear::cases),
    category("prior", "initial covariances that are nearly singular, or of low rank", prior::cases),
    category("long", "hundreds and thousands of steps of small models, whose errors have time to pile up", long::cases),
    category("large", "a dozen states and more", large::cases),
    category("singular", "innovations whose covariance is singular, with data that fit", singular::cases),
    category("contradiction", "data that the model says are impossible", contradiction::cases),
    category("nile", "the annual flow of the Nile at Aswan, with published variances", |_| real::nile()),
    category("real", "other observations of the world: carbon dioxide, sunspots, inflation, the sea", |_| {
        real::cases()
    }),
    category("single", "numbers that mean single-precision numbers", single::cases),
    category("refuse", "what is no valid problem, with one fault each", |_| bad_input::cases()),
];

/// The categories, in order.
///
/// # Examples
///
/// ```
/// let categories = exact_kalman::judge::categories();
/// assert_eq!(categories[0].name, "basic");
/// assert_eq!(categories.last().map(|last| last.name), Some("refuse"));
/// ```
pub fn categories() -> Vec<Category> {
    CASES.iter().map(|(category, _)| *category).collect()
}
