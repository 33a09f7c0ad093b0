//! Matrices as texts.

/// A matrix by its entries.
pub(super) fn table(rows: usize, columns: usize, entry: impl Fn(usize, usize) -> String) -> String {
    let row = |i: usize| (0..columns).map(|j| entry(i, j)).collect::<Vec<_>>().join(" ");
    (0..rows).map(row).collect::<Vec<_>>().join("; ")
}

/// A diagonal matrix.
pub(super) fn diagonal<T: AsRef<str>>(entries: &[T]) -> String {
    table(entries.len(), entries.len(), |i, j| if i == j { entries[i].as_ref().to_owned() } else { "0".into() })
}

/// A multiple of the identity.
pub(super) fn multiple(n: usize, factor: &str) -> String {
    diagonal(&vec![factor; n])
}

/// So many zeros in a row, for means.
pub(super) fn zeros(n: usize) -> String {
    vec!["0"; n].join(" ")
}

/// With gaps: the readings of the given steps are taken away.
pub(super) fn gaps<T: Into<String>>(readings: impl IntoIterator<Item = T>, missing: &[usize]) -> Vec<String> {
    let keep = |(k, text): (usize, T)| if missing.contains(&k) { String::new() } else { text.into() };
    readings.into_iter().enumerate().map(keep).collect()
}

/// With silent sensors: at step k entry i is taken away where `silent(k, i)`.
pub(super) fn silenced(
    readings: impl IntoIterator<Item = String>,
    silent: impl Fn(usize, usize) -> bool,
) -> Vec<String> {
    let reading = |(k, text): (usize, String)| {
        let entry = |(i, entry): (usize, &str)| if silent(k, i) { "-".to_owned() } else { entry.to_owned() };
        text.split_whitespace().enumerate().map(entry).collect::<Vec<_>>().join(" ")
    };
    readings.into_iter().enumerate().map(reading).collect()
}

/// Followed by steps without a reading.
pub(super) fn and_ahead(readings: impl IntoIterator<Item = String>, steps: usize) -> Vec<String> {
    readings.into_iter().chain(std::iter::repeat_n(String::new(), steps)).collect()
}
