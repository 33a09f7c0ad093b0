//! Known mistakes are named, and nothing else is.

mod accused;
mod filter;
mod innocent;
mod model;
mod named;
mod output;
mod page;
mod resting;
mod subject;
mod together;

/// Habits that are a wrong line of the recursion: what they do where noise is shared is not one thing.
pub(crate) const LINES: [&str; 20] = [
    "joseph-without-noise",
    "joseph-with-unit-noise",
    "covariance-not-updated",
    "mean-not-updated",
    "covariance-update-adds",
    "predictor-gain-for-filtered",
    "filter-gain-in-the-predictor",
    "gain-without-noise",
    "gain-without-inverse",
    "gain-of-the-diagonal",
    "gain-of-the-first-step",
    "innovation-of-the-state-before",
    "mean-not-moved",
    "covariance-not-moved",
    "transition-without-transpose",
    "transition-on-one-side",
    "process-noise-through-the-transition",
    "filtered-covariance-raised",
    "covariance-rests-too-early",
    "small-variances-ignored",
];
