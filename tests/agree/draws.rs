//! Random systems for property tests.

use proptest::collection::vec;
use proptest::prelude::*;

use super::systems::{Draw, Kind, draw};

pub fn draws(kind: Kind) -> impl Strategy<Value = Draw> {
    vec(any::<i8>(), 400).prop_map(move |tape| draw(kind, tape))
}
