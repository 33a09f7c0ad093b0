//! Lines on standard output that are no answers.

/// Lines that native libraries and forgotten debug prints leave on standard output: counted, the first few kept.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Strays {
    /// How many there were.
    pub count: usize,
    /// The beginnings of the first ones.
    pub first: Vec<String>,
}

impl Strays {
    /// How many are kept.
    pub const KEPT: usize = 5;

    pub(super) fn line(&mut self, line: &[u8]) {
        self.count += 1;
        if self.first.len() < Self::KEPT {
            // Four bytes per character at most: enough for the excerpt, whatever the length of the line.
            let head = String::from_utf8_lossy(&line[..line.len().min(1000)]);
            self.first.push(super::super::document::excerpt(head.trim()));
        }
    }

    pub(super) fn add(&mut self, other: &Self) {
        self.count += other.count;
        let room = Self::KEPT.saturating_sub(self.first.len());
        self.first.extend(other.first.iter().take(room).cloned());
    }
}
