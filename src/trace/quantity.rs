//! The names under which results travel.

use std::collections::BTreeMap;
use std::fmt;

use crate::matrix::Matrix;

/// A named result of one step, in the order in which they are shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[non_exhaustive]
pub enum Quantity {
    /// E(x_k | y_0, …, y_k), n×1.
    FilteredMean,
    /// cov(x_k | y_0, …, y_k), n×n.
    FilteredCovariance,
    /// E(x_k | y_0, …, y_{k−1}), n×1.
    PredictedMean,
    /// cov(x_k | y_0, …, y_{k−1}), n×n.
    PredictedCovariance,
    /// y_k − E(y_k | y_0, …, y_{k−1}), one row per observed entry.
    Innovation,
    /// cov(y_k | y_0, …, y_{k−1}), for the observed entries.
    InnovationCovariance,
    /// The gain of the filtered mean with the pseudo-inverse, one column per observed entry.
    Gain,
    /// ln p(y_k | y_0, …, y_{k−1}), 1×1: `−½ (νᵀS⁻¹ν + ln det S + m ln 2π)` for the m observed entries; only where S is
    /// regular. It is irrational, so the exact filter gives its parts, and the judge an enclosure.
    LogLikelihood,
}

impl Quantity {
    /// Every quantity, in order.
    pub const ALL: [Self; 8] = [
        Self::FilteredMean,
        Self::FilteredCovariance,
        Self::PredictedMean,
        Self::PredictedCovariance,
        Self::Innovation,
        Self::InnovationCovariance,
        Self::Gain,
        Self::LogLikelihood,
    ];

    /// The name in the protocol: words, joined by underscores.
    pub const fn name(self) -> &'static str {
        match self {
            Self::FilteredMean => "filtered_mean",
            Self::FilteredCovariance => "filtered_covariance",
            Self::PredictedMean => "predicted_mean",
            Self::PredictedCovariance => "predicted_covariance",
            Self::Innovation => "innovation",
            Self::InnovationCovariance => "innovation_covariance",
            Self::Gain => "gain",
            Self::LogLikelihood => "log_likelihood",
        }
    }

    /// Whether it is a single number.
    pub const fn is_number(self) -> bool {
        matches!(self, Self::LogLikelihood)
    }

    /// Whether it is a column.
    pub const fn is_vector(self) -> bool {
        matches!(self, Self::FilteredMean | Self::PredictedMean | Self::Innovation | Self::LogLikelihood)
    }

    /// Whether it is a covariance: symmetric and positive semidefinite.
    pub const fn is_covariance(self) -> bool {
        matches!(self, Self::FilteredCovariance | Self::PredictedCovariance | Self::InnovationCovariance)
    }
}

impl fmt::Display for Quantity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(&self.name().replace('_', " "))
    }
}

/// The results of one step, by name; what was not computed is absent.
pub type Values<T> = BTreeMap<Quantity, Matrix<T>>;
