//! Which entries of the covariance are fractions.
//!
//! With sizes Sᵢ of the classes an entry is the average, under the weights SᵢSⱼ of pairs, of `½(vᵢ + vⱼ) + ½(lᵢ − lⱼ)(rᵢ − rⱼ)`. It is
//! the fraction ρ iff the sum of `SᵢSⱼ (… − ρ)` vanishes over each class of pairs. The pairs with the largest exponent leave one
//! candidate for ρ. The others are looked at from the larger exponents to the smaller ones, until each entry is refuted:
//! mostly at the second exponent, so that the square of the number of classes is only paid for entries that are fractions, and not for
//! those that are the same number for all pairs.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use super::classes::{Class, Classes};
use crate::scalar::{Rational, Scalar, ratio};

/// An entry of the covariance, by classes: the covariance within a class, and its means in row and column.
#[derive(Clone, Debug)]
pub(super) struct Central {
    pub(super) inner: Vec<Rational>,
    pub(super) left: Vec<Rational>,
    pub(super) right: Vec<Rational>,
}

impl Central {
    /// Whether it is the same number for all pairs: the covariance is one within all classes, and so is the mean in the row or in the column.
    fn is_constant(&self) -> bool {
        let constant = |of: &[Rational]| of.iter().all(|value| *value == of[0]);
        constant(&self.inner) && (constant(&self.left) || constant(&self.right))
    }

    /// Twice what is averaged over pairs.
    fn twice(&self, i: usize, j: usize) -> Rational {
        let away = |of: &[Rational]| of[i].minus(&of[j]);
        self.inner[i].plus(&self.inner[j]).plus(&away(&self.left).times(&away(&self.right)))
    }
}

/// Pairs of classes, and which of them are rational multiples of each other.
#[derive(Clone, Debug)]
pub(super) struct Pairs {
    pairs: Vec<(usize, usize)>,
    pub(super) joint: Classes,
}

impl Pairs {
    /// How many there are.
    pub(super) fn count(classes: &Classes) -> usize {
        let count = classes.all.len();
        count.saturating_mul(count + 1) / 2
    }

    /// All of them.
    pub(super) fn new(classes: &Classes) -> Self {
        let count = classes.all.len();
        Self::of(classes, (0..count).flat_map(|i| (i..count).map(move |j| (i, j))).collect())
    }

    fn of(classes: &Classes, pairs: Vec<(usize, usize)>) -> Self {
        let joint: Vec<Class> = pairs.iter().map(|&pair| product(classes, pair)).collect();
        Self { pairs, joint: Classes::of(joint.iter()) }
    }

    /// The averages of an entry within each joint class.
    pub(super) fn averages(&self, entry: &Central) -> Vec<Rational> {
        let half = ratio(1, 2);
        let twice = |place: usize| entry.twice(self.pairs[place].0, self.pairs[place].1);
        self.joint.averages(twice).iter().map(|value| value.times(&half)).collect()
    }
}

/// For each entry the fraction that it is, if it is one.
pub(super) fn fractions(classes: &Classes, entries: &[Central]) -> Vec<Option<Rational>> {
    let mut order: Vec<usize> = (0..classes.all.len()).collect();
    order.sort_by_key(|&i| Reverse(&classes.all[i].exponent));
    let mut found: Vec<Option<Rational>> = entries.iter().map(|entry| candidate(classes, &order, entry)).collect();
    let open: Vec<bool> = entries.iter().map(|entry| !entry.is_constant()).collect();
    let mut descending = Descending::new(classes, &order);
    while found.iter().zip(&open).any(|(value, open)| *open && value.is_some())
        && let Some(pairs) = descending.next()
    {
        let pairs = Pairs::of(classes, pairs);
        for ((entry, value), _) in entries.iter().zip(&mut found).zip(&open).filter(|(_, open)| **open) {
            if value.as_ref().is_some_and(|fraction| pairs.averages(entry).iter().any(|average| average != fraction)) {
                *value = None;
            }
        }
    }
    found
}

/// The only fraction that the entry can be. Of the pairs with the largest exponent, those of a class with itself have a
/// rational weight, and others have not.
fn candidate(classes: &Classes, order: &[usize], entry: &Central) -> Option<Rational> {
    let largest = &classes.all[*order.first()?].exponent;
    let (mut sum, mut whole) = (ratio(0, 1), ratio(0, 1));
    for &i in order.iter().take_while(|&&i| classes.all[i].exponent == *largest) {
        let class = &classes.all[i];
        let weight = class.weight.times(&class.weight) / &class.determinant;
        sum = sum.plus(&weight.times(&entry.inner[i]));
        whole = whole.plus(&weight);
    }
    Some(sum / whole)
}

/// The evidence for two independent copies, in both orders if they are two.
fn product(classes: &Classes, (i, j): (usize, usize)) -> Class {
    let (one, other) = (&classes.all[i], &classes.all[j]);
    let orders = ratio(if i == j { 1 } else { 2 }, 1);
    Class {
        weight: one.weight.times(&other.weight).times(&orders),
        determinant: one.determinant.times(&other.determinant),
        exponent: one.exponent.plus(&other.exponent),
    }
}

/// Pairs of classes by the sum of their exponents, the largest first.
struct Descending<'a> {
    classes: &'a Classes,
    order: &'a [usize],
    /// Sum and places in `order`, the first not behind the second.
    heap: BinaryHeap<(Rational, Reverse<(usize, usize)>)>,
}

impl<'a> Descending<'a> {
    fn new(classes: &'a Classes, order: &'a [usize]) -> Self {
        let mut all = Self { classes, order, heap: BinaryHeap::new() };
        all.push(0, 0);
        all
    }

    fn push(&mut self, one: usize, other: usize) {
        if let (Some(&i), Some(&j)) = (self.order.get(one), self.order.get(other)) {
            let sum = self.classes.all[i].exponent.plus(&self.classes.all[j].exponent);
            self.heap.push((sum, Reverse((one, other))));
        }
    }
}

impl Iterator for Descending<'_> {
    type Item = Vec<(usize, usize)>;

    /// All pairs with the next exponent.
    fn next(&mut self) -> Option<Self::Item> {
        let exponent = self.heap.peek()?.0.clone();
        let mut pairs = Vec::new();
        while self.heap.peek().is_some_and(|(sum, _)| *sum == exponent)
            && let Some((_, Reverse((one, other)))) = self.heap.pop()
        {
            pairs.push((self.order[one], self.order[other]));
            // What follows in this row, and the next row once this one is begun.
            self.push(one, other + 1);
            if one == other {
                self.push(one + 1, one + 1);
            }
        }
        Some(pairs)
    }
}
