//! All identities.

use super::body::{Body, Failure, Numbers, Size};
use super::chance::{Chance, checked};
use super::identities::{conditioning, filter, gains, moments, parallel_sum, pseudo_inverse, riccati, start, timing};
use super::proof::{Proof, proved};
use super::witness::{Witness, found};

/// An identity that holds for matrices of given shapes, and how it is run.
#[derive(Clone, Debug)]
pub struct Identity {
    /// The entries of the specification that it says, or the equalities of them.
    pub identifiers: &'static [&'static str],
    /// What is equal.
    pub name: &'static str,
    /// Under which hypothesis it is run, after the word "where". Beyond it only equations between variables are excepted: those that
    /// change a decision of the code.
    pub hypothesis: &'static str,
    /// What is wrong in the twin.
    pub slip: &'static str,
    /// The sizes at which it is proved in moments: the tests run these, and the specification names no others.
    pub symbolic: Vec<Size>,
    /// Further ones, which take seconds.
    pub heavy: Vec<Size>,
    /// The sizes at which it is checked at random points.
    pub random: Vec<Size>,
    prove: fn(Numbers, bool, usize) -> Result<Proof, Failure>,
    check: fn(Numbers, u64) -> Result<Chance, Failure>,
    disprove: fn(Numbers) -> Result<Witness, Failure>,
}

impl Identity {
    fn of<B: Body>() -> Self {
        Self {
            identifiers: B::IDENTIFIERS,
            name: B::NAME,
            hypothesis: B::WHERE,
            slip: B::SLIP,
            symbolic: Size::all(B::LETTERS, B::SYMBOLIC),
            heavy: Size::all(B::LETTERS, B::HEAVY),
            random: Size::all(B::LETTERS, B::RANDOM),
            prove: proved::<B>,
            check: checked::<B>,
            disprove: found::<B>,
        }
    }

    /// Runs the identity over the rational functions.
    ///
    /// # Errors
    ///
    /// [`Failure`] if it does not hold, a routine has no value, or the functions are too large.
    pub fn proved(&self, size: Size) -> Result<Proof, Failure> {
        (self.prove)(size.padded(), false, 0)
    }

    /// Checks the identity at random points modulo 2⁶¹ − 1; the seed determines the points.
    ///
    /// # Errors
    ///
    /// [`Failure`] if it does not hold at one of them, or a routine has no value there.
    pub fn chance(&self, size: Size, seed: u64) -> Result<Chance, Failure> {
        (self.check)(size.padded(), seed)
    }

    /// Runs the twin over the rational functions, which must fail.
    ///
    /// # Errors
    ///
    /// What fails in the twin.
    pub fn twin_proved(&self, size: Size) -> Result<Proof, Failure> {
        (self.prove)(size.padded(), true, 0)
    }

    /// A point of small integers at which the identity holds and its twin fails, of the first size that has one.
    ///
    /// # Errors
    ///
    /// [`Failure::TwinSurvives`] if none is found.
    pub fn twin_disproved(&self) -> Result<Witness, Failure> {
        let mut outcome = Err(Failure::TwinSurvives(0));
        for size in &self.symbolic {
            outcome = (self.disprove)(size.padded());
            if outcome.is_ok() {
                break;
            }
        }
        outcome
    }
}

/// All identities, in the order in which they are run.
pub fn catalogue() -> Vec<Identity> {
    vec![
        Identity::of::<pseudo_inverse::Penrose>(),
        Identity::of::<pseudo_inverse::AnyFactors>(),
        Identity::of::<conditioning::Precision>(),
        Identity::of::<conditioning::Singular>(),
        Identity::of::<filter::Arriving>(),
        Identity::of::<filter::Departing>(),
        Identity::of::<filter::SingularArriving>(),
        Identity::of::<filter::SingularDeparting>(),
        Identity::of::<gains::Joseph>(),
        Identity::of::<gains::Squares>(),
        Identity::of::<gains::SingularSquares>(),
        Identity::of::<gains::OptimalGain>(),
        Identity::of::<gains::Lyapunov>(),
        Identity::of::<parallel_sum::Forms>(),
        Identity::of::<parallel_sum::Singular>(),
        Identity::of::<riccati::Forms>(),
        Identity::of::<riccati::Filtered>(),
        Identity::of::<riccati::Difference>(),
        Identity::of::<riccati::Stein>(),
        Identity::of::<moments::Recovered>(),
        Identity::of::<start::Starred>(),
        Identity::of::<timing::ToDeparting>(),
        Identity::of::<timing::ToArriving>(),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// There are 64 variables: from later ones on, functions are too large at once or after a few operations.
    #[test]
    fn functions_that_are_too_large_are_an_error() {
        for identity in catalogue() {
            for size in &identity.symbolic {
                for first in [64, 63, 60, 56] {
                    let outcome = (identity.prove)(size.padded(), false, first);
                    let is_short = outcome.as_ref().is_ok_and(|proof| proof.variables + first <= 64);
                    assert!(is_short || outcome.is_err(), "{} from {first}: {outcome:?}", identity.name);
                }
            }
        }
    }
}
