//! One body, two uses: `#[kani::proof]` under Kani, replayed over a small domain under `cargo test`.
//!
//! A body asks for its inputs by [`below`] and says by `cover!` which situations it met. Replays go through every
//! sequence of answers (an odometer) or through a number of seeded random ones; afterwards each situation that the
//! harness declares must have been met, and no other one: a body that never comes to what it is about fails.
//!
//! Inputs are generated in range. Nothing is rejected natively, so the count of replays is the count of checks.

#[cfg(not(kani))]
pub use replayed::{below, note, replay};

/// How a body is replayed natively. Kani goes through all inputs at once and does not read it.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(kani, expect(dead_code, reason = "Kani does not replay"))]
pub enum Replays {
    /// Every sequence of inputs, this many in all.
    All(u64),
    /// This many seeded random sequences.
    Random(u64),
}

/// Any number below `bound`.
#[cfg(kani)]
pub fn below(bound: u64) -> u64 {
    let value: u64 = kani::any();
    kani::assume(value < bound);
    value
}

/// Writes one body as a proof for Kani and as a native test. `unwind` bounds the turns of every loop.
macro_rules! harness {
    ($(#[$doc:meta])* $name:ident, unwind $unwind:literal, $replays:expr, covers [$($label:literal),+], $body:block) => {
        $(#[$doc])*
        #[cfg(kani)]
        #[kani::proof]
        #[kani::unwind($unwind)]
        fn $name() {
            let _: crate::harness::Replays = $replays;
            $body
        }

        $(#[$doc])*
        #[cfg(not(kani))]
        #[test]
        fn $name() {
            crate::harness::replay($replays, &[$($label),+], || $body);
        }
    };
}

/// Says that a situation was met; it must be met at least once.
macro_rules! cover {
    ($met:expr, $label:literal) => {{
        #[cfg(kani)]
        kani::cover!($met, $label);
        #[cfg(not(kani))]
        crate::harness::note($met, $label);
    }};
}

pub(crate) use {cover, harness};

/// The native side.
#[cfg(not(kani))]
mod replayed {
    use std::cell::RefCell;
    use std::collections::BTreeMap;

    use super::Replays;

    /// Where the inputs of the running replay come from, and what the replays so far have met.
    #[derive(Default)]
    struct Replay {
        /// The inputs of this replay with their bounds, in the order in which they were asked for.
        wheels: Vec<(u64, u64)>,
        /// How many of them this replay has asked for.
        asked: usize,
        /// The state of the random numbers; nothing turns the wheels in order.
        random: Option<u64>,
        met: BTreeMap<&'static str, u64>,
    }

    thread_local! {
        static REPLAY: RefCell<Replay> = RefCell::default();
    }

    impl Replay {
        fn below(&mut self, bound: u64) -> u64 {
            assert!(bound > 0, "no number is below zero");
            if let Some(state) = &mut self.random {
                return random(state) % bound;
            }
            let place = self.asked;
            self.asked += 1;
            if place == self.wheels.len() {
                self.wheels.push((0, bound));
            }
            let (value, known) = self.wheels[place];
            assert!(known == bound, "the body asked for another bound after the same inputs");
            value
        }

        /// Turns the last wheel that has a number left and drops those after it; nothing is left if there is none.
        fn turn(&mut self) -> bool {
            self.asked = 0;
            while let Some((value, bound)) = self.wheels.pop() {
                if value + 1 < bound {
                    self.wheels.push((value + 1, bound));
                    return true;
                }
            }
            false
        }
    }

    /// One step of `SplitMix64`.
    fn random(state: &mut u64) -> u64 {
        *state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let first = (*state ^ (*state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let second = (first ^ (first >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        second ^ (second >> 31)
    }

    /// Any number below `bound`.
    pub fn below(bound: u64) -> u64 {
        REPLAY.with_borrow_mut(|replay| replay.below(bound))
    }

    /// Counts a situation.
    pub fn note(met: bool, label: &'static str) {
        REPLAY.with_borrow_mut(|replay| *replay.met.entry(label).or_default() += u64::from(met));
    }

    /// Replays a body, and asserts that every declared situation was met.
    pub fn replay(replays: Replays, declared: &[&'static str], body: impl Fn()) {
        let start = Replay { random: matches!(replays, Replays::Random(_)).then_some(1), ..Replay::default() };
        REPLAY.set(start);
        let mut count = 0;
        match replays {
            Replays::Random(wanted) => {
                while count < wanted {
                    body();
                    count += 1;
                }
            }
            Replays::All(expected) => {
                loop {
                    body();
                    count += 1;
                    if !REPLAY.with_borrow_mut(Replay::turn) {
                        break;
                    }
                }
                assert_eq!(count, expected, "replays of the whole domain");
            }
        }
        let met = REPLAY.take().met;
        println!("{count} replays met {met:?}");
        let labels: Vec<&str> = met.keys().copied().collect();
        let mut declared = declared.to_vec();
        declared.sort_unstable();
        assert_eq!(labels, declared, "situations met and situations declared");
        for (label, times) in met {
            assert!(times > 0, "«{label}» was never met in {count} replays");
        }
    }

    #[test]
    fn the_odometer_goes_through_every_sequence_once() {
        let seen = RefCell::new(Vec::new());
        replay(Replays::All(2 + 3), &["first"], || {
            // The second bound depends on the first input: two sequences after 0, three after 1.
            let first = below(2);
            note(first == 1, "first");
            seen.borrow_mut().push((first, below(2 + first)));
        });
        assert_eq!(seen.into_inner(), [(0, 0), (0, 1), (1, 0), (1, 1), (1, 2)]);
    }

    #[test]
    #[should_panic(expected = "«never» was never met in 3 replays")]
    fn a_situation_that_is_never_met_fails() {
        replay(Replays::All(3), &["never"], || note(below(3) > 3, "never"));
    }

    #[test]
    #[should_panic(expected = "situations met and situations declared")]
    fn a_situation_that_is_never_reached_fails() {
        replay(Replays::Random(3), &["unreached"], || assert!(below(3) < 3));
    }
}
