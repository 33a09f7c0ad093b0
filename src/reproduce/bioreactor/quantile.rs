//! The middle and the width of a sample.

/// The median of a sample, and the order statistics that cut off a twentieth on either side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Band {
    /// The 5 % quantile.
    pub low: f64,
    /// The median.
    pub median: f64,
    /// The 95 % quantile.
    pub high: f64,
}

impl Band {
    /// The band of a sample of N: of the sorted values, counted from 0, those with index ⌊N/20⌋, ⌊N/2⌋ and
    /// N − 1 − ⌊N/20⌋. Nothing for an empty sample.
    pub fn of(mut sample: Vec<f64>) -> Option<Self> {
        sample.sort_by(f64::total_cmp);
        let count = sample.len();
        let cut = count / 20;
        let at = |index: usize| sample.get(index).copied();
        Some(Self { low: at(cut)?, median: at(count / 2)?, high: at(count.checked_sub(1 + cut)?)? })
    }

    /// Whether a value lies inside, the ends included.
    pub fn contains(&self, value: f64) -> bool {
        self.low <= value && value <= self.high
    }
}
