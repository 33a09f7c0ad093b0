//! The one helper: whether a square commutes, and how often it was run.

use std::collections::BTreeSet;

use exact_kalman::matrix::Matrix;
use exact_kalman::scalar::{Field, Rational, Scalar};
use proptest::collection::vec;
use proptest::prelude::*;
use proptest::test_runner::{Config, RngAlgorithm, TestCaseError, TestRng, TestRunner};

use super::inputs::Input;
use super::watched::{Watched, differed};

/// A field in which inputs are drawn.
pub trait Drawn: Field {
    /// An element from two fractions, so that not all are fractions.
    fn drawn(first: &Rational, second: &Rational) -> Self;
}

impl Drawn for Rational {
    fn drawn(first: &Rational, _: &Rational) -> Self {
        first.clone()
    }
}

/// A partial map of scalars that keeps sums, products and quotients wherever it is defined.
pub trait Map: Copy + std::fmt::Debug + 'static {
    const NAME: &'static str;
    type Source: Drawn;
    type Image: Field;

    /// Nothing where a denominator vanishes.
    fn image(value: &Self::Source) -> Option<Self::Image>;
}

/// What an algorithm is called, and which public functions its square covers, as `listed` names them.
pub trait Named {
    const NAME: &'static str;
    const COVERS: &'static [&'static str];
}

/// A generic algorithm at one scalar.
pub trait Algorithm<S>: Named {
    fn run(input: &Input<S>) -> Answer<S>;
}

/// A result, taken apart: what must be equal, and what is mapped.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Answer<S> {
    /// Some question had no certain answer (never over a field).
    pub undecided: bool,
    /// Shapes, ranks, verdicts.
    pub plain: Vec<usize>,
    pub numbers: Vec<S>,
}

impl<S: Scalar> Answer<S> {
    pub fn new() -> Self {
        Self { undecided: false, plain: Vec::new(), numbers: Vec::new() }
    }

    pub fn matrix(mut self, matrix: &Matrix<S>) -> Self {
        self.plain.extend([matrix.rows(), matrix.columns()]);
        self.numbers.extend_from_slice(matrix.entries());
        self
    }

    pub fn number(mut self, number: &S) -> Self {
        self.numbers.push(number.clone());
        self
    }

    pub fn count(mut self, count: usize) -> Self {
        self.plain.push(count);
        self
    }

    /// A verdict, with a code of its own.
    pub fn says(self, verdict: bool) -> Self {
        self.count(9_000 + usize::from(verdict))
    }

    /// The algorithm refused its input.
    pub fn refused(self) -> Self {
        self.count(8_000)
    }

    pub fn undecided(mut self) -> Self {
        self.undecided = true;
        self
    }
}

/// What became of the inputs of a square.
#[derive(Clone, Copy, Debug, Default)]
pub struct Counts {
    /// Both ways were gone and led to the same.
    pub equal: usize,
    /// A pivot or denominator vanished under the map.
    pub vanished: usize,
}

pub const CASES: usize = 50;

fn tapes() -> impl Strategy<Value = Vec<i8>> {
    vec(any::<i8>(), 300)
}

/// Runs a check on `CASES` inputs drawn from one fixed seed; the check says whether it applied.
pub fn counted(what: &str, check: impl Fn(Vec<i8>) -> Result<bool, TestCaseError>) -> Counts {
    let config = Config { failure_persistence: None, cases: u32::try_from(CASES).expect("small"), ..Config::default() };
    let mut runner = TestRunner::new_with_rng(config, TestRng::deterministic_rng(RngAlgorithm::ChaCha));
    let counts = std::cell::Cell::new(Counts::default());
    let verdict = runner.run(&tapes(), |tape| {
        let applied = check(tape)?;
        let Counts { equal, vanished } = counts.get();
        counts.set(Counts { equal: equal + usize::from(applied), vanished: vanished + usize::from(!applied) });
        Ok(())
    });
    if let Err(error) = verdict {
        panic!("{what}: {error}");
    }
    counts.get()
}

/// f∘φ = φ∘f on every input at which no question that the algorithm asks is answered differently after the map.
///
/// The algorithm runs three times: at the source, at the image, and at the source with every zero test, comparison and
/// division watched. Where these have the same answers under φ the results must be equal, and elsewhere nothing is claimed.
///
/// A square says nothing about what the algorithm computes: one that is wrong in the same way over every scalar commutes (a
/// gain without its cross term does). What it sees is code that asks for more than a field, and a scalar whose arithmetic is
/// wrong where an algorithm meets it: numbers made by a quotient last are reduced, whatever was made before.
pub fn commutes<M: Map, A>()
where
    A: Algorithm<M::Source> + Algorithm<M::Image> + Algorithm<Watched<M>>,
{
    let what = format!("{} under {}", A::NAME, M::NAME);
    let counts = counted(&what, |tape| {
        let input = Input::drawn(&tape, M::Source::drawn);
        let Some(mapped) = input.try_map(M::image) else { return Ok(false) };
        let at_source = <A as Algorithm<M::Source>>::run(&input);
        let watched = input.try_map(|value| Some(Watched::<M>::new(value.clone()))).expect("total");
        let (seen, differs) = differed(|| <A as Algorithm<Watched<M>>>::run(&watched));
        let seen: Vec<M::Source> = seen.numbers.into_iter().map(Watched::value).collect();
        prop_assert_eq!(&seen, &at_source.numbers, "{}: watching changes the result", A::NAME);
        prop_assert!(!at_source.undecided, "a field decides");
        if differs {
            return Ok(false);
        }
        let images: Option<Vec<M::Image>> = at_source.numbers.iter().map(M::image).collect();
        let Some(numbers) = images else {
            return Err(TestCaseError::fail("no divisor vanished, and the result has no image"));
        };
        let expected = Answer { undecided: false, plain: at_source.plain, numbers };
        prop_assert_eq!(<A as Algorithm<M::Image>>::run(&mapped), expected);
        Ok(true)
    });
    println!("{what:<58} equal {:>3}  vanished {:>3}", counts.equal, counts.vanished);
    assert!(counts.equal > 0, "{what}: the square never ran");
}

/// All names of a list of algorithms, each once.
pub fn names(lists: &[&[&'static str]]) -> BTreeSet<&'static str> {
    lists.iter().flat_map(|list| list.iter().copied()).collect()
}
