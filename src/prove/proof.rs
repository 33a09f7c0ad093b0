//! Proofs over the rational functions.

use super::body::{Body, Failure, Numbers, compared};
use super::entries::Entries;
use crate::scalar::RationalFunction;

/// An identity holds for matrices of one size: as an equation between rational functions of their entries.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Proof {
    /// How many variables.
    pub variables: usize,
    /// The number of terms of the longest numerator compared.
    pub terms: usize,
}

/// The variables have the numbers from `first` on.
pub(super) fn proved<B: Body>(numbers: Numbers, twin: bool, first: usize) -> Result<Proof, Failure> {
    let mut variables = 0;
    let mut next = || {
        variables += 1;
        RationalFunction::variable(first + variables - 1)
    };
    let sides = B::sides(numbers, twin, &mut Entries::new(&mut next))?;
    let entries = || sides.iter().flat_map(|(left, right)| left.entries().iter().chain(right.entries()));
    if entries().any(RationalFunction::is_too_large) {
        return Err(Failure::TooLarge);
    }
    let terms = entries().filter_map(RationalFunction::terms).max().unwrap_or(0);
    compared(&sides)?;
    Ok(Proof { variables, terms })
}
