//! Readings that are made up.

/// Which made-up readings a suite has: 0 has the published ones.
///
/// Only readings are drawn. Models, inputs and observations of the world are the same with every seed, and so are readings
/// that must fit together: those of singular innovations, of contradictions, of answers known by hand.
#[derive(Clone, Copy, Debug)]
pub(super) struct Draw(u64);

impl Draw {
    pub(super) const fn seeded(seed: u64) -> Self {
        Self(seed)
    }

    /// Whole numbers that look like readings, in −range ..= range; other `number`, other readings.
    pub(super) fn scatter(self, number: i64, count: i64, range: i64) -> std::vec::IntoIter<i64> {
        if self.0 == 0 {
            return scatter(number, count, range).collect::<Vec<_>>().into_iter();
        }
        let key = mixed(self.0).wrapping_add(mixed(number.unsigned_abs()).rotate_left(32));
        let width = 2 * range.unsigned_abs() + 1;
        let value = |k: i64| (mixed(key.wrapping_add(k.unsigned_abs())) % width).cast_signed() - range;
        (0..count).map(value).collect::<Vec<_>>().into_iter()
    }

    /// The same in thousandths.
    pub(super) fn singles(self, number: i64, count: i64, range: i64) -> impl Iterator<Item = String> {
        self.scatter(number, count, range).map(thousandths)
    }

    /// Readings of several sensors, in thousandths.
    pub(super) fn several(self, sensors: i64, number: i64, count: i64, range: i64) -> impl Iterator<Item = String> {
        let columns: Vec<Vec<i64>> =
            (0..sensors).map(|i| self.scatter(number + 1000 * i, count, range).collect()).collect();
        let steps = usize::try_from(count).unwrap_or(0);
        (0..steps).map(move |k| columns.iter().map(|column| thousandths(column[k])).collect::<Vec<_>>().join(" "))
    }

    /// Readings of two sensors.
    pub(super) fn pairs(self, number: i64, count: i64) -> impl Iterator<Item = String> {
        self.several(2, number, count, 2000)
    }

    /// Whole numbers of one sensor with an exponent: `3e-9`.
    pub(super) fn powers(self, number: i64, count: i64, range: i64, exponent: i32) -> impl Iterator<Item = String> {
        self.scatter(number, count, range).map(move |value| format!("{value}e{exponent}"))
    }
}

/// Whole numbers in −range ..= range that are the same with every seed: a fixed linear congruence.
pub(super) fn scatter(number: i64, count: i64, range: i64) -> impl Iterator<Item = i64> {
    let mut state = number;
    (0..count).map(move |_| {
        state = (state * 75 + 74) % 65537;
        state % (2 * range + 1) - range
    })
}

/// A scaled whole number as a decimal: `thousandths(-1250)` is "-1.250".
pub(super) fn thousandths(value: i64) -> String {
    let sign = if value < 0 { "-" } else { "" };
    format!("{sign}{}.{:03}", value.abs() / 1000, value.abs() % 1000)
}

/// The finaliser of SplitMix64, a bijection (G. L. Steele, D. Lea and C. H. Flood, OOPSLA 2014).
const fn mixed(value: u64) -> u64 {
    let value = value.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let value = (value ^ (value >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let value = (value ^ (value >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    value ^ (value >> 31)
}
