//! Whether enclosures stay as narrow as they began.

use std::fmt;

/// How many bits less accurate the last enclosures may be than the first before it is told.
const TOLD: i64 = 16;

/// The steps from which the first accuracy is taken: the least among them, as enclosures begin narrow.
const FIRST: usize = 16;

/// What enclosures lost of the bits that they have, from step to step.
#[derive(Clone, Debug, Default)]
pub struct Growth {
    /// The most that was lost among the first steps.
    first: Option<(usize, i64)>,
    /// What was lost at steps that are twice as far from the first as the one before.
    doubled: Vec<(usize, i64)>,
    last: Option<(usize, i64)>,
}

impl Growth {
    /// A step of this number was enclosed with so many bits, and its entries are known to so many.
    pub fn note(&mut self, step: usize, bits: u64, accuracy: Option<u64>) {
        let Some(accuracy) = accuracy else { return };
        let count = |bits: u64| i64::try_from(bits).unwrap_or(i64::MAX);
        let lost = count(bits) - count(accuracy);
        let begun = self.first.map_or(step, |(begun, _)| begun);
        let since = step.saturating_sub(begun);
        if since < FIRST {
            let most = self.first.map_or(lost, |(_, first)| first.max(lost));
            self.first = Some((begun, most));
        }
        if since.is_power_of_two() {
            self.doubled.push((step, lost));
        }
        self.last = Some((step, lost));
    }

    /// Whether the last enclosures are less accurate than the first by more than sixteen bits.
    pub fn is_told(&self) -> bool {
        self.lost().is_some_and(|(_, _, lost)| lost > TOLD)
    }

    /// The first step, the last, and the bits that were lost between them.
    fn lost(&self) -> Option<(usize, usize, i64)> {
        let ((begun, first), (end, last)) = (self.first?, self.last?);
        (end > begun).then(|| (begun, end, last - first))
    }

    /// Whether they go on being lost at the rate of the first half: a quarter or more of all in the second half.
    fn is_steady(&self, begun: usize, end: usize, lost: i64) -> bool {
        let middle = begun + (end - begun) / 2;
        let first = self.first.map_or(0, |(_, first)| first);
        let before = self.doubled.iter().rev().find(|(step, _)| *step <= middle).map_or(first, |(_, lost)| *lost);
        4 * (first + lost - before) >= lost
    }
}

impl fmt::Display for Growth {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Some((begun, end, lost)) = self.lost() else {
            return f.write_str("enclosures stay as narrow as they began");
        };
        let steps = i64::try_from(end - begun).unwrap_or(i64::MAX);
        let rate = lost.saturating_mul(1000) / steps.max(1);
        write!(
            f,
            "enclosures lose accuracy: {lost} bits from step {begun} to step {end}, {rate} in a thousand steps; "
        )?;
        f.write_str(if self.is_steady(begun, end, lost) {
            "there is likely a mode that grows and that no reading corrects, unobserved or known without noise"
        } else {
            "the loss slows down: there are likely states without noise, whose variances fall"
        })
    }
}
