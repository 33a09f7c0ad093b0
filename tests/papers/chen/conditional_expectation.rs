//! Conditional expectation without integrability, on spaces where every sum is a geometric series.
//!
//! A *ray* is a sequence of atoms n = 0, 1, … with the probabilities `weight · decayⁿ`, on which a variable has the
//! values `value · growthⁿ`. A finite space is one of rays with decay 0.

use exact_kalman::scalar::{Rational, ratio};

/// A number or +∞; the expectation of a variable that is never negative.
#[derive(Clone, Debug, PartialEq)]
enum Extended {
    Finite(Rational),
    Infinite,
}

/// The expectation of a variable, if it has one (CKS-D).
#[derive(Clone, Debug, PartialEq)]
enum Expectation {
    Finite(Rational),
    PlusInfinity,
    MinusInfinity,
    Undefined,
}

#[derive(Clone, Debug)]
struct Ray {
    weight: Rational,
    decay: Rational,
    value: Rational,
    growth: Rational,
}

fn zero() -> Rational {
    ratio(0, 1)
}

fn one() -> Rational {
    ratio(1, 1)
}

fn positive_part(x: &Rational) -> Rational {
    x.clone().max(zero())
}

fn negative_part(x: &Rational) -> Rational {
    (-x).max(zero())
}

impl Ray {
    fn probability(&self) -> Rational {
        &self.weight / (one() - &self.decay)
    }

    /// Σ weight · decayⁿ · part(value) · growthⁿ
    fn integral(&self, part: fn(&Rational) -> Rational) -> Extended {
        let size = &self.weight * part(&self.value);
        let quotient = &self.decay * &self.growth;
        if size == zero() {
            Extended::Finite(zero())
        } else if quotient < one() {
            Extended::Finite(size / (one() - quotient))
        } else {
            Extended::Infinite
        }
    }

    /// The same ray, every value times `factor`.
    fn scaled(&self, factor: &Rational) -> Self {
        Self { value: &self.value * factor, ..self.clone() }
    }
}

/// E(X^± | block), for one of the two parts.
fn part_given(block: &[Ray], part: fn(&Rational) -> Rational) -> Extended {
    let mut sum = zero();
    for ray in block {
        match ray.integral(part) {
            Extended::Finite(value) => sum += value,
            Extended::Infinite => return Extended::Infinite,
        }
    }
    Extended::Finite(sum / block.iter().map(Ray::probability).sum::<Rational>())
}

/// CKS-D on a block of a partition.
fn given(block: &[Ray]) -> Expectation {
    match (part_given(block, positive_part), part_given(block, negative_part)) {
        (Extended::Finite(plus), Extended::Finite(minus)) => Expectation::Finite(plus - minus),
        (Extended::Infinite, Extended::Finite(_)) => Expectation::PlusInfinity,
        (Extended::Finite(_), Extended::Infinite) => Expectation::MinusInfinity,
        (Extended::Infinite, Extended::Infinite) => Expectation::Undefined,
    }
}

/// E(X | n) on rays of one decay and one growth, as a ray that stands for all of them.
fn given_level(rays: &[Ray]) -> Ray {
    let weight: Rational = rays.iter().map(|ray| ray.weight.clone()).sum();
    let value = rays.iter().map(|ray| &ray.weight * &ray.value).sum::<Rational>() / &weight;
    Ray { weight, value, ..rays[0].clone() }
}

/// X = ±2ⁿ with probability 2⁻ⁿ⁻² each, n = 0, 1, …; `minus` in place of −1.
fn saint_petersburg(minus: Rational) -> [Ray; 2] {
    let ray = |value| Ray { weight: ratio(1, 4), decay: ratio(1, 2), value, growth: ratio(2, 1) };
    [ray(one()), ray(minus)]
}

/// The points of a finite space, each with a probability and a value.
fn points(values: &[i64], weights: &[i64]) -> Vec<Ray> {
    let total: i64 = weights.iter().sum();
    let point = |(&value, &weight): (&i64, &i64)| Ray {
        weight: ratio(weight, total),
        decay: zero(),
        value: ratio(value, 1),
        growth: zero(),
    };
    values.iter().zip(weights).map(point).collect()
}

/// The partitions of 0..4, each as the number of the block in which a point lies.
fn partitions() -> Vec<[usize; 4]> {
    let all = (0..256).map(|code: usize| [code & 3, code >> 2 & 3, code >> 4 & 3, code >> 6]);
    // Blocks are numbered in the order of their first points.
    all.filter(|labels| (0..4).all(|i| labels[i] <= labels[..i].iter().max().map_or(0, |most| most + 1))).collect()
}

/// CKS-D: on finite spaces the definition is the weighted mean of each block.
#[test]
fn finite_expectations_are_weighted_means() {
    assert_eq!(partitions().len(), 15);
    let space = points(&[3, -1, 0, 5], &[1, 2, 3, 4]);
    assert_eq!(given(&space), Expectation::Finite(ratio(3 - 2 + 20, 10)));
    assert_eq!(given(&space[1..3]), Expectation::Finite(ratio(-2, 5)));
}

/// CKS-D: a sum that diverges on one side is infinite, on both sides undefined; more knowledge may define it.
#[test]
fn infinite_expectations() {
    let positive = saint_petersburg(zero());
    assert_eq!(given(&positive), Expectation::PlusInfinity);
    assert_eq!(given(&positive.map(|ray| ray.scaled(&ratio(-2, 1)))), Expectation::MinusInfinity);
    let symmetric = saint_petersburg(ratio(-1, 1));
    assert_eq!(given(&symmetric), Expectation::Undefined);
    assert_eq!(given_level(&symmetric).value, zero());
}

/// CKS-TR: E[E[X | n]] = 0 while E[X] does not exist; where E[X] exists, finite or not, the rule holds.
#[test]
fn the_tower_rule_may_fail() {
    let towered = |rays: &[Ray; 2]| given(&[given_level(rays)]);
    let symmetric = saint_petersburg(ratio(-1, 1));
    assert_eq!(towered(&symmetric), Expectation::Finite(zero()));
    assert_eq!(given(&symmetric), Expectation::Undefined);
    let one_sided = saint_petersburg(zero());
    assert_eq!(towered(&one_sided), given(&one_sided));
    let integrable = one_sided.map(|ray| Ray { growth: ratio(3, 2), ..ray });
    assert_eq!(towered(&integrable), given(&integrable));
    assert_eq!(given(&integrable), Expectation::Finite(ratio(1, 1)));
}

/// CKS-L0.parts: the parts of a product, for all signs.
#[test]
fn parts_of_a_product() {
    for (a, x) in (-3..=3).flat_map(|a| (-3..=3).map(move |x| (ratio(a, 1), ratio(x, 2)))) {
        let product = &a * &x;
        let (a_plus, a_minus, x_plus, x_minus) =
            (positive_part(&a), negative_part(&a), positive_part(&x), negative_part(&x));
        assert_eq!(positive_part(&product), &a_plus * &x_plus + &a_minus * &x_minus);
        assert_eq!(negative_part(&product), a_plus * x_minus + a_minus * x_plus);
    }
}

/// CKS-L0: on every partition G of four points, for every X and every α that is constant on blocks. An α that is not
/// may fail: α = X = ±1 with G trivial.
#[test]
fn what_is_known_is_taken_out() {
    let weights = [1, 2, 3, 4];
    for labels in partitions() {
        for code in 0..81 {
            let values = [code % 3 - 1, code / 3 % 3 - 1, code / 9 % 3 - 1, code / 27 - 1];
            let space = points(&values, &weights);
            for block in 0..4 {
                let inside: Vec<Ray> = (0..4).filter(|&i| labels[i] == block).map(|i| space[i].clone()).collect();
                if inside.is_empty() {
                    continue;
                }
                for alpha in -2..=2 {
                    let alpha = ratio(alpha, 1);
                    let product: Vec<Ray> = inside.iter().map(|ray| ray.scaled(&alpha)).collect();
                    let Expectation::Finite(mean) = given(&inside) else { panic!("a finite space") };
                    assert_eq!(given(&product), Expectation::Finite(alpha * mean));
                }
            }
        }
    }
    let fair = points(&[1, -1], &[1, 1]);
    let squared: Vec<Ray> = fair.iter().map(|ray| ray.scaled(&ray.value)).collect();
    assert_eq!((given(&squared), given(&fair)), (Expectation::Finite(one()), Expectation::Finite(zero())));
}

/// CKS-L0: α = n-measurable and unbounded, X without a mean: E(αX | n) = α E(X | n) on a space where E(αX) is undefined.
#[test]
fn no_integrability_is_needed() {
    let [plus, minus] = saint_petersburg(ratio(-1, 3));
    // α = 5·3ⁿ
    let times_alpha = |ray: &Ray| Ray { growth: &ray.growth * ratio(3, 1), ..ray.scaled(&ratio(5, 1)) };
    let products = [times_alpha(&plus), times_alpha(&minus)];
    assert_eq!(given(&products), Expectation::Undefined);
    let (inside, outside) = (given_level(&products), times_alpha(&given_level(&[plus, minus])));
    assert_eq!((inside.value, inside.growth), (outside.value, outside.growth));
}
