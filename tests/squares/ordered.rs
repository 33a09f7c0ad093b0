//! Algorithms that need an order: the map must keep it. The inclusion of ℚ in ℚ(√2) does; √2 ↦ −√2 where no comparison changes.

use exact_kalman::matrix::LdlError;
use exact_kalman::riccati::RiccatiMap;
use exact_kalman::scalar::OrderedField;

use super::algebra::algorithm;
use super::commuting::{Answer, Named};
use super::maps::over_ordered_fields;

algorithm!(
    Definiteness,
    OrderedField,
    ["matrix::Matrix::ldl", "matrix::Ldl::rank", "matrix::Ldl::is_positive_definite"],
    |input| {
        [&input.p, &(&input.p - &input.q), &input.a].into_iter().fold(Answer::new(), |answer, matrix| {
            match matrix.ldl() {
                Ok(ldl) => {
                    let answer = answer.count(ldl.rank()).says(ldl.is_positive_definite()).matrix(&ldl.lower);
                    ldl.pivots.iter().fold(answer, Answer::number)
                }
                Err(LdlError::Asymmetric { row, column }) => answer.refused().count(row).count(column),
                Err(LdlError::Indefinite(proof)) => answer.refused().matrix(&proof.witness).number(&proof.value),
            }
        })
    }
);

algorithm!(Order, OrderedField, ["matrix::Matrix::loewner_le"], |input| {
    let sum = &input.p + &input.q;
    Answer::new().says(input.p.loewner_le(&sum).is_ok()).says(input.p.loewner_le(&input.q).is_ok())
});

algorithm!(SpectralRadius, OrderedField, ["matrix::Matrix::spectral_radius_lt"], |input| {
    (1..4).fold(Answer::new(), |answer, bound| answer.says(input.a.spectral_radius_lt(&S::from_integer(bound))))
});

algorithm!(
    Riccati,
    OrderedField,
    [
        "riccati::RiccatiMap::new",
        "riccati::RiccatiMap::with_sensors",
        "riccati::RiccatiMap::image",
        "riccati::RiccatiMap::iterate",
        "riccati::RiccatiMap::upper_bound",
        "riccati::RiccatiMap::filtered_covariance",
        "riccati::RiccatiMap::gain",
        "riccati::RiccatiMap::closed_loop",
        "riccati::RiccatiMap::step",
        "riccati::RiccatiMap::filtered_mean",
        "riccati::RiccatiMap::predicted_mean",
    ],
    |input| {
        let map = RiccatiMap::new(input.a.clone(), input.p.clone(), input.q.clone());
        let Ok(map) = map else { return Answer::new().refused() };
        let s = &input.b * input.b.transpose();
        let step = map.step(&s);
        let mean = map.filtered_mean(&step.gain, &input.x, &(&input.b * &input.x));
        let answer = Answer::new()
            .matrix(&map.image(&s))
            .matrix(&map.iterate(&s, 2))
            .matrix(&map.upper_bound())
            .matrix(&map.filtered_covariance(&s))
            .matrix(&map.gain(&s))
            .matrix(&map.closed_loop(&s))
            .matrix(&step.predicted)
            .matrix(&step.gain)
            .matrix(&step.filtered)
            .matrix(&mean)
            .matrix(&map.predicted_mean(&mean, 2));
        match RiccatiMap::with_sensors(&input.b, &input.a, &input.p, input.q.clone()) {
            Ok(map) => answer.matrix(&map.image(&s)),
            Err(_) => answer.refused(),
        }
    }
);

pub const COVERED: &[&[&str]] = &[Definiteness::COVERS, Order::COVERS, SpectralRadius::COVERS, Riccati::COVERS];

/// AK-Order: verdicts and witnesses of definiteness.
#[test]
fn order_commutes() {
    over_ordered_fields!(Definiteness, Order, SpectralRadius);
}

/// AK-1.4a, AK-1.4b, AK-1.4c, AK-1.3a, AK-1.3b: the Riccati step.
#[test]
fn riccati_steps_commute() {
    over_ordered_fields!(Riccati);
}
