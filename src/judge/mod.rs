//! Floor 5 · The judge: how many digits are right, how many could be, and what that means.
//!
//! A [`Reference`] holds the exact answer of a case and the digits that a backward-stable method would have kept;
//! [`Judgement::of`] holds a reply against it. Knows no process and prints nothing.
//!
//! **Digits** are −log₁₀ of the largest error over the entries of a quantity, capped at 17, which also stands for
//! exact. Errors of covariances are relative to √(PᵢᵢPⱼⱼ), those of means to max(|xᵢ|, √Pᵢᵢ), P the exact covariance;
//! where an exact variance is zero, the largest that the component has in the run takes its place.
//!
//! **Attainable digits** are the worst of twenty answers to problems in which every nonzero datum is moved by a
//! relative 2⁻⁵³, or 2⁻²⁴ if they are single-precision numbers. Where that may destroy the structure of the case (an innovation covariance is singular, a diffuse
//! start is resolved at a step of its own), only the answers count that have kept it, and never for more than 15 digits (6 in
//! single precision). [`Sensitivity`] says which data are to blame where few digits are attainable.
//!
//! The verdicts stand in [`Verdict`], with the constants 2, 4 and 6. Nothing else is tuned: 17 and 15 digits and twenty
//! answers are what is written above.

mod data_kind;
mod diagnosis;
mod digits;
mod examinee;
mod invariants;
mod judgement;
mod likelihood;
mod limits;
mod mistakes;
mod perturb;
mod reference;
mod scale;
mod sensitivity;
mod suite;
mod truth;
mod verdict;

pub use data_kind::DataKind;
pub use diagnosis::{Diagnosis, Explanation};
pub use digits::{Digits, EntryDigits};
pub use examinee::Examinee;
pub use invariants::{Asymmetry, Indefiniteness};
pub use judgement::{Judgement, Score};
pub use mistakes::{Kind, Mistake, mistake, mistakes, mistakes_page};
pub use reference::Reference;
pub use scale::Scale;
pub use sensitivity::Sensitivity;
pub use suite::{Category, Flag, SUITE_VERSION, categories, flag, flags, meaning, suite, suite_seeded};
pub use truth::Truth;
pub use verdict::Verdict;
