//! Floor 4 · Prediction from a start that is not Gaussian: the universal statistics of Sowers and Makowski.
//!
//! Given ξ = z everything is Gaussian: the next state has the mean `X̄ + Q*z` and the covariance P, and the log density
//! of the readings is a term free of z plus `zᵀB̄ − ½ zᵀR*z`. So whatever the law F of ξ is, the data enter through
//! [`Statistics`] alone, which do not know F; what F adds is one integral over z.
//!
//! * [`statistics`] computes P, J, Q, R, Ψ, M, X̄, B̄ and Q*, R* for each step, exactly;
//! * [`InitialLaw`] is F: atoms, Gaussians (degenerate ones too) and their mixtures;
//! * [`Statistics::linear`] is the best affine estimate, inverse-free in Δ; [`Statistics::posterior`] the conditional
//!   law, a mixture whose laws are exact and whose weights are an exact exponential each;
//! * [`Posterior::weights`] encloses these weights, [`Posterior::mean`] the best estimate and [`Posterior::covariance`] its error, each entry a
//!   fraction or irrational and to any number of digits; [`Averages`] computes the exponentials for all of them once;
//! * [`Posterior::characteristic`] is the conditional characteristic function, and [`Statistics::price_of_linearity`] encloses how much the
//!   best affine estimate loses on average;
//! * [`Decomposition`] splits the state into noise and start in every way the paper allows, with the density of the new measure that
//!   each makes ([`LogDensity`], [`Shift`]); [`InfiniteHorizon`] decides for constant systems whether these measures have a
//!   limit with a density;
//! * [`JointLaw::tilted`] is the functional 𝒯 and [`Functional`] is 𝒰, on the domain where it is finite, and their integrals of polynomials,
//!   exponentials and half-spaces are those of a [`Measure`]; [`Posterior::expectation`], [`Posterior::moment_generating`] and
//!   [`Posterior::probability`] are the quotients of Theorem 1;
//! * [`as_printed`] keeps the wrong forms of the paper, so that the difference can be seen.
//!
//! Holds no simulation.
//!
//! Paper: Sowers, Makowski 1988. Its index t is our k.

pub mod as_printed;
mod average;
mod characteristic;
mod classes;
mod decomposition;
mod enclosure;
mod exponential_sum;
mod functional;
mod girsanov;
mod horizon;
mod initial_law;
mod lattice;
mod line;
mod linear;
mod log_density;
mod measure;
mod moments;
mod pairs;
mod posterior;
mod price;
mod quadrature;
mod recursion;
mod statistics;
mod strip;

pub use average::{Average, Enclosed, Quantity, TooWide};
pub use characteristic::{CharacteristicFunction, CharacteristicTerm};
pub use decomposition::{Affine, Choice, Decomposition};
pub use enclosure::Averages;
pub use exponential_sum::{ExponentialSum, Unresolved};
pub use functional::{DomainError, Functional, JointLaw};
pub use girsanov::{LikelihoodRatio, Shift, log_likelihood_ratios};
pub use horizon::{HorizonError, InfiniteHorizon, LimitMeasure};
pub use initial_law::{Component, InitialLaw, InitialLawError};
pub use linear::Linear;
pub use log_density::LogDensity;
pub use measure::{HalfSpace, Measure};
pub use posterior::{Evidence, Posterior, PosteriorComponent};
pub use price::PriceError;
pub use statistics::{Statistics, StatisticsError, statistics};
