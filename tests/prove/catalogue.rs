//! Every identity, at the sizes that are quick; `exact-kalman prove` runs all sizes.

use std::time::Instant;

use exact_kalman::prove::{Failure, catalogue};

/// All sizes of the verb, with their times: `cargo test --release --test prove -- --ignored --nocapture`.
#[test]
#[ignore = "minutes; the verb does the same"]
fn every_size() {
    for identity in catalogue() {
        for &size in &identity.symbolic {
            let begun = Instant::now();
            let outcome = identity.proved(size);
            println!("{} · {size}: {outcome:?} in {:?}", identity.name, begun.elapsed());
        }
        for &size in &identity.random {
            let begun = Instant::now();
            let outcome = identity.chance(size, 1);
            println!("{} · {size}: {outcome:?} in {:?}", identity.name, begun.elapsed());
        }
        println!("{:?}", identity.twin_disproved().map(|witness| witness.to_string()));
    }
}
