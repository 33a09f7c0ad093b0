//! The filter modulo many primes, and the integers of its states from their remainders.
//!
//! Modulo a prime the whole of [`State`](super::state::State) is a few words, and a step costs as much as in doubles.
//! Before each step a bound tells how long its integers can be at most, so many primes are taken, and the integers
//! follow by the Chinese remainder theorem; nothing is guessed, and nothing has to be verified. Primes that are new take
//! over the exact state before the step. A pivot is zero if it is zero modulo primes whose product exceeds its bound;
//! a prime that divides a pivot (or a denominator of the data) is dropped.
//!
//! A step costs as much as k runs in doubles and, for each integer of k words, about k² products of words, or less
//! where k is some hundreds: no more than one product of such integers, where elimination needs one or two for
//! each pivot, and an exact division.

mod bound;
mod image;
mod joint;
mod words;

use num_bigint::BigInt;
use num_traits::One;
use rayon::prelude::*;

use super::elimination::{Eliminated, Stop};
use super::laws::StepLaws;
use super::state::State;
use crate::matrix::Matrix;
use crate::modular::{Basis, Digits, PRIME_BITS, PrimeField, Primes};
use image::{Image, Moment, Shape};
use joint::Joint;
use words::{CoefficientWords, ConstantWords, StateDigits};

/// Work, in products of words, below which a second core is not worth its call.
const PARALLEL: usize = 1 << 17;

/// States of the filter modulo primes, which follow an exact one.
#[derive(Debug)]
pub(super) struct Residues {
    primes: Primes,
    basis: Basis,
    images: Vec<Image>,
    /// The coefficients that the images have, with their number.
    coefficients: Option<(u64, CoefficientWords)>,
    /// The factor by which the divisors of the images exceed that of the exact state.
    pending: BigInt,
}

impl Default for Residues {
    fn default() -> Self {
        Self {
            primes: Primes::default(),
            basis: Basis::default(),
            images: Vec::new(),
            coefficients: None,
            pending: BigInt::one(),
        }
    }
}

impl Residues {
    /// The states after a step, given the exact one before it.
    pub(super) fn advance(&mut self, state: &State, laws: StepLaws<'_>) -> Result<Eliminated, Stop> {
        let law = laws.observation;
        let shape = Shape { states: law.states, observed: law.observed, targets: law.targets };
        let scales = scales(state, laws);
        let length = bound::length(state, laws, &scales);
        let kept = self.coefficients.take().filter(|(generation, _)| *generation == laws.generation);
        let is_new = kept.is_none();
        let coefficients = kept.map_or_else(|| CoefficientWords::of(laws), |(_, words)| words);
        let constants = ConstantWords::of(laws);

        let data = [Digits::from(&scales[0]), Digits::from(&scales[1])];
        let pending = Digits::from(&self.pending);
        let longest = data.iter().chain([&pending]).map(Digits::len);
        let longest = longest.chain([coefficients.longest(), constants.longest()]).max();
        let powers = longest.unwrap_or(1);
        if is_new || self.images.iter().any(|image| image.powers.len() < powers) {
            // More than are needed now: a scale that lengthens does so at every step.
            let powers = powers.next_power_of_two();
            let work = self.images.len() * shape.work();
            let tasks: Vec<_> = self.images.iter_mut().zip(self.basis.fields()).collect();
            each(tasks, work, |(), (image, field)| image.refresh(field, &coefficients, powers));
        }
        loop {
            self.cover(length, state, &coefficients, powers);
            let pending = Digits::from(&self.pending);
            let moment = Moment { shape, constants: &constants, scales: &data, pending: &pending };
            let irregular = self.advance_images(&moment);
            if irregular.is_empty() {
                break;
            }
            self.without(&irregular);
        }
        if self.images.iter().any(|image| !image.is_settled()) {
            return Err(Stop);
        }
        let rank = self.images.first().map_or(0, Image::rank);
        let (divisor, mut states) = self.states(shape, &scales);
        // The images go on with the last target's state.
        self.pending = states.last().map_or_else(BigInt::one, |state| divisor / &state.divisor);
        self.coefficients = Some((laws.generation, coefficients));
        let departed = if states.len() > 1 { states.pop() } else { None };
        states.pop().map(|filtered| Eliminated { filtered, departed, rank }).ok_or(Stop)
    }

    /// Adds primes until they determine all integers below 2^length, and images of the exact state for all that have none.
    fn cover(&mut self, length: u64, state: &State, coefficients: &CoefficientWords, powers: usize) {
        let exact = StateDigits::of(state, &self.pending);
        let longest = exact.longest().max(powers);
        let image = |field: &PrimeField| Image::of(&exact, coefficients, field, longest, powers);
        // A prime that does not suit the state is passed over.
        let take_in = |basis: &mut Basis, images: &mut Vec<Image>, fields: Vec<PrimeField>| {
            let work = fields.len() * longest * exact.count();
            let made = each(fields, work, |(), field| image(&field).map(|image| (field, image)));
            let (fields, made): (Vec<_>, Vec<_>) = made.into_iter().flatten().unzip();
            basis.extend(fields);
            images.extend(made);
        };
        if self.images.is_empty() {
            // After an irregular prime the images of the others have gone too far.
            let fields = std::mem::take(&mut self.basis).fields().to_vec();
            take_in(&mut self.basis, &mut self.images, fields);
        }
        let missing = |basis: &Basis| usize::try_from(length.saturating_sub(basis.determines()).div_ceil(PRIME_BITS));
        while let Ok(missing @ 1..) = missing(&self.basis) {
            let fields = self.primes.by_ref().take(missing).collect();
            take_in(&mut self.basis, &mut self.images, fields);
        }
    }

    /// Makes the step modulo each prime; the places of those which do not suit it, or have found fewer pivots than others.
    ///
    /// A pivot that is zero modulo one prime and not modulo another is not zero; one that is zero modulo all is zero, for their
    /// product exceeds it. So the true pattern of pivots is the largest in the order of words.
    fn advance_images(&mut self, moment: &Moment<'_>) -> Vec<usize> {
        let (fields, cofactors) = (self.basis.fields(), self.basis.cofactors());
        let work = self.images.len() * moment.shape.work();
        let tasks: Vec<_> = self.images.iter_mut().zip(fields).zip(cofactors).collect();
        let suits = each(tasks, work, |joint: &mut Joint, ((image, field), cofactor)| {
            image.advance(field, *cofactor, moment, joint).is_some()
        });
        let suiting = || self.images.iter().zip(&suits).filter(|(_, suits)| **suits).map(|(image, _)| image);
        let pattern = suiting().map(Image::pivots).max();
        let is_regular = |(image, suits): (&Image, &bool)| *suits && Some(image.pivots()) == pattern;
        let regular = self.images.iter().zip(&suits).map(is_regular);
        regular.enumerate().filter(|(_, regular)| !regular).map(|(at, _)| at).collect()
    }

    /// Drops the primes at these places, and all images: they have made a step that is not taken.
    fn without(&mut self, irregular: &[usize]) {
        let fields = std::mem::take(&mut self.basis);
        let kept = fields.fields().iter().enumerate().filter(|(at, _)| !irregular.contains(at));
        self.basis.extend(kept.map(|(_, field)| *field));
        self.images.clear();
        self.pending = BigInt::one();
    }

    /// d′, and the states of the targets.
    fn states(&self, shape: Shape, scales: &[BigInt; 2]) -> (BigInt, Vec<State>) {
        let values = self.images.first().map_or(0, |image| image.parts().len());
        let determined = self.basis.determined();
        let work = values * self.images.len() * self.images.len();
        let integers = each((0..values).collect(), work, |parts: &mut Vec<u64>, value| {
            parts.clear();
            parts.extend(self.images.iter().map(|image| image.parts()[value]));
            determined.integer(parts)
        });
        let mut integers = integers.into_iter();
        let divisor =
            integers.next().expect("a bound of one bit asks for one prime, whose image has d′ as its first part");
        let n = shape.states;
        let states = (0..shape.targets).map(|_| {
            let mean = Matrix::column(integers.by_ref().take(n).collect());
            let lower: Vec<BigInt> = integers.by_ref().take(n * (n + 1) / 2).collect();
            let [scale, mean_scale] = scales.clone();
            State {
                numerators: Matrix::from_fn(n, n, |i, j| lower[i.max(j) * (i.max(j) + 1) / 2 + i.min(j)].clone()),
                scale,
                divisor: divisor.clone(),
                mean_numerators: mean,
                mean_scale,
            }
            .reduced()
        });
        let states = states.collect();
        (divisor, states)
    }
}

/// The results of tasks that are `work` products of words together, in their order; on all cores where that pays.
fn each<T: Send, W: Default, R: Send>(
    tasks: Vec<T>,
    work: usize,
    task: impl Fn(&mut W, T) -> R + Sync + Send,
) -> Vec<R> {
    if work < PARALLEL || rayon::current_num_threads() == 1 {
        let mut memory = W::default();
        return tasks.into_iter().map(|each| task(&mut memory, each)).collect();
    }
    tasks.into_par_iter().map_init(W::default, task).collect()
}

/// w u and z uₓ: by these times d′ the next covariances and means become integers.
fn scales(state: &State, laws: StepLaws<'_>) -> [BigInt; 2] {
    let laws = laws.transition.into_iter().chain([laws.observation]);
    laws.fold([state.scale.clone(), state.mean_scale.clone()], |[scale, mean_scale], law| {
        [scale * law.scale(), mean_scale * law.mean_scale()]
    })
}
