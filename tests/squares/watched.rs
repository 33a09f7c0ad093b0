//! A scalar that notes when a map changes the answer to a question.

use std::cell::Cell;
use std::cmp::Ordering;
use std::fmt;
use std::marker::PhantomData;

use exact_kalman::scalar::{Field, OrderedField, Scalar, Undefined, ZeroTest};

use super::commuting::Map;

thread_local! {
    static DIFFERS: Cell<bool> = const { Cell::new(false) };
}

/// The result of a computation with watched scalars, and whether some answer differs under the map.
pub fn differed<T>(computation: impl FnOnce() -> T) -> (T, bool) {
    DIFFERS.set(false);
    let result = computation();
    (result, DIFFERS.get())
}

fn note(differs: bool) {
    DIFFERS.set(DIFFERS.get() || differs);
}

/// An element of the source of a map.
pub struct Watched<M: Map>(M::Source, PhantomData<M>);

impl<M: Map> Watched<M> {
    pub fn new(value: M::Source) -> Self {
        Self(value, PhantomData)
    }

    pub fn value(self) -> M::Source {
        self.0
    }

    fn vanishes(&self) -> bool {
        M::image(&self.0).is_none_or(|image| image.is_zero() != self.0.is_zero())
    }
}

impl<M: Map> Clone for Watched<M> {
    fn clone(&self) -> Self {
        Self::new(self.0.clone())
    }
}

impl<M: Map> fmt::Debug for Watched<M> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

impl<M: Map> PartialEq for Watched<M> {
    fn eq(&self, other: &Self) -> bool {
        let images = M::image(&self.0).zip(M::image(&other.0));
        let equal = self.0 == other.0;
        note(images.is_none_or(|(one, two)| (one == two) != equal));
        equal
    }
}

impl<M: Map> Eq for Watched<M> {}

impl<M: Map> PartialOrd for Watched<M>
where
    M::Source: Ord,
    M::Image: Ord,
{
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl<M: Map> Ord for Watched<M>
where
    M::Source: Ord,
    M::Image: Ord,
{
    fn cmp(&self, other: &Self) -> Ordering {
        let images = M::image(&self.0).zip(M::image(&other.0));
        let order = self.0.cmp(&other.0);
        note(images.is_none_or(|(one, two)| one.cmp(&two) != order));
        order
    }
}

impl<M: Map> Scalar for Watched<M> {
    fn zero() -> Self {
        Self::new(M::Source::zero())
    }

    fn one() -> Self {
        Self::new(M::Source::one())
    }

    fn plus(&self, other: &Self) -> Self {
        Self::new(self.0.plus(&other.0))
    }

    fn minus(&self, other: &Self) -> Self {
        Self::new(self.0.minus(&other.0))
    }

    fn times(&self, other: &Self) -> Self {
        Self::new(self.0.times(&other.0))
    }

    fn over(&self, divisor: &Self) -> Result<Self, Undefined> {
        note(divisor.vanishes());
        self.0.over(&divisor.0).map(Self::new)
    }

    fn zero_test(&self) -> ZeroTest {
        note(self.vanishes());
        self.0.zero_test()
    }
}

impl<M: Map> Field for Watched<M> {
    fn is_zero(&self) -> bool {
        note(self.vanishes());
        self.0.is_zero()
    }
}

impl<M: Map> OrderedField for Watched<M>
where
    M::Source: OrderedField,
    M::Image: OrderedField,
{
}
