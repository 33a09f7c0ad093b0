//! All identities.

use super::body::{Body, Failure, Size};
use super::chance::{Chance, checked};
use super::identities::{conditioning, filter, gains, moments, parallel_sum, pseudo_inverse, riccati, start, timing};
use super::proof::{Proof, proved};
use super::witness::{Witness, found};

/// An identity that holds for all matrices of given shapes, and how it is run.
#[derive(Clone, Debug)]
pub struct Identity {
    /// The entries of the specification that it says, or the equalities of them.
    pub identifiers: &'static [&'static str],
    /// What is equal.
    pub name: &'static str,
    /// What is wrong in the twin.
    pub slip: &'static str,
    /// The sizes at which it is proved in moments: the tests run these, and the specification names no others.
    pub symbolic: Vec<Size>,
    /// Further ones, which take seconds.
    pub heavy: Vec<Size>,
    /// The sizes at which it is checked at random points.
    pub random: Vec<Size>,
    prove: fn([usize; 3], bool) -> Result<Proof, Failure>,
    check: fn([usize; 3], u64) -> Result<Chance, Failure>,
    disprove: fn([usize; 3]) -> Result<Witness, Failure>,
}

impl Identity {
    fn of<B: Body>() -> Self {
        Self {
            identifiers: B::IDENTIFIERS,
            name: B::NAME,
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
        (self.prove)(size.numbers(), false)
    }

    /// Checks the identity at random points modulo 2⁶¹ − 1; the seed determines the points.
    ///
    /// # Errors
    ///
    /// [`Failure`] if it does not hold at one of them, or a routine has no value there.
    pub fn chance(&self, size: Size, seed: u64) -> Result<Chance, Failure> {
        (self.check)(size.numbers(), seed)
    }

    /// Runs the twin over the rational functions, which must fail.
    ///
    /// # Errors
    ///
    /// What fails in the twin.
    pub fn twin_proved(&self, size: Size) -> Result<Proof, Failure> {
        (self.prove)(size.numbers(), true)
    }

    /// A point of small integers at which the identity holds and its twin fails, of the first size that has one.
    ///
    /// # Errors
    ///
    /// [`Failure::TwinSurvives`] if none is found.
    pub fn twin_disproved(&self) -> Result<Witness, Failure> {
        let mut outcome = Err(Failure::TwinSurvives(0));
        for size in &self.symbolic {
            outcome = (self.disprove)(size.numbers());
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
        Identity::of::<gains::Joseph>(),
        Identity::of::<gains::Squares>(),
        Identity::of::<gains::OptimalGain>(),
        Identity::of::<gains::Lyapunov>(),
        Identity::of::<parallel_sum::Forms>(),
        Identity::of::<parallel_sum::Singular>(),
        Identity::of::<riccati::Forms>(),
        Identity::of::<riccati::Difference>(),
        Identity::of::<riccati::Stein>(),
        Identity::of::<moments::Recovered>(),
        Identity::of::<start::Starred>(),
        Identity::of::<timing::ToDeparting>(),
        Identity::of::<timing::ToArriving>(),
    ]
}
