//! Observations of the world. Origins, licences and checksums stand in `data/SOURCES.md`.

use super::draft::Draft;
use super::table::{diagonal, table};
use crate::protocol::Case;

/// The annual flow of the Nile at Aswan, 1871–1970, in 10⁸ m³.
const NILE: &str = include_str!("../../../data/nile.csv");

/// Carbon dioxide in the air above Mauna Loa by weeks from 1958 on, in parts per million.
const CO2: &str = include_str!("../../../data/co2.csv");

/// Sunspots by years from 1700 on.
const SUNSPOTS: &str = include_str!("../../../data/sunspots.csv");

/// Inflation, unemployment and the rate of treasury bills of the United States by quarters from 1959 on, in per cent.
const MACRO: &str = include_str!("../../../data/macro.csv");

/// The surface of the sea off Peru by months from 1950 on, in degrees Celsius.
const EL_NINO: &str = include_str!("../../../data/elnino.csv");

/// A column of a file.
fn column(file: &'static str, column: usize) -> impl Iterator<Item = &'static str> {
    file.lines().skip(1).map(move |line| line.split(',').nth(column).unwrap_or_default())
}

fn nile_flows() -> impl Iterator<Item = &'static str> {
    column(NILE, 1)
}

/// With the years 1891–1910 and 1931–1950 taken away, as Durbin and Koopman do.
fn nile_with_gaps() -> impl Iterator<Item = &'static str> {
    nile_flows().enumerate().map(|(k, flow)| if (20..40).contains(&k) || (60..80).contains(&k) { "" } else { flow })
}

pub(super) fn nile() -> Vec<Case> {
    let level = |id: &str, about: &str, flags: &[&str]| Draft::new(id, about, flags).noise("1469.1", "15099");
    vec![
        level("nile/diffuse", "annual flow of the Nile 1871-1970, diffuse start", &["real-data", "diffuse"])
            .starting("0", "0")
            .diffuse("1")
            .reading(nile_flows()),
        level("nile/large-prior", "the same flows, initial variance 10⁷ in place of the limit", &["real-data"])
            .starting("0", "1e7")
            .reading(nile_flows()),
        level("nile/missing-years", "the same flows without 1891-1910 and 1931-1950", &["real-data", "missing"])
            .starting("0", "1e7")
            .reading(nile_with_gaps()),
        level(
            "nile/missing-years-diffuse",
            "the same flows without these years, diffuse start",
            &["real-data", "missing", "diffuse"],
        )
        .starting("0", "0")
        .diffuse("1")
        .reading(nile_with_gaps()),
        level("nile/trend", "the same flows with a slope that drifts slowly", &["real-data", "ill-conditioned"])
            .starting("1000 0", "1e6 0; 0 1e4")
            .transition("1 1; 0 1")
            .observation("1 0")
            .noise("1469.1 0; 0 1e-4", "15099")
            .reading(nile_flows().take(60)),
    ]
}

pub(super) fn cases() -> Vec<Case> {
    [carbon_dioxide(), sunspots(), economy(), sea()].concat()
}

/// A level with a slope, and one wave a year of 52 weeks.
fn carbon_dioxide() -> Vec<Case> {
    // cos and sin of 2π/52.
    let wave = "1 1 0 0; 0 1 0 0; 0 0 0.992708874098054 0.120536680255323; 0 0 -0.120536680255323 0.992708874098054";
    let season = |id: &str, about: &str| {
        Draft::new(id, about, &["real-data", "ill-conditioned"])
            .transition(wave)
            .observation("1 0 1 0")
            .noise(&diagonal(&["0.01", "1e-8", "1e-4", "1e-4"]), "0.1")
    };
    let trend = |id: &str, about: &str| {
        Draft::new(id, about, &["real-data", "ill-conditioned"])
            .transition("1 1; 0 1")
            .observation("1 0")
            .noise("0.05 0; 0 1e-6", "0.1")
    };
    vec![
        trend("real/carbon-dioxide-trend", "carbon dioxide by weeks from March 1958, with gaps: a local linear trend")
            .starting("315 0", "1e6 0; 0 1")
            .reading(column(CO2, 1).take(100)),
        season("real/carbon-dioxide-season", "carbon dioxide by weeks from March 1958, with gaps: trend and season")
            .starting("315 0 0 0", &diagonal(&["1e6", "1", "100", "100"]))
            .reading(column(CO2, 1).take(52)),
        trend(
            "real/carbon-dioxide-diffuse",
            "carbon dioxide by weeks from the end of June 1962, with gaps, diffuse start",
        )
        .starting("0 0", "0 0; 0 0")
        .diffuse("1 0; 0 1")
        .reading(column(CO2, 1).skip(222).take(38)),
    ]
}

/// y_k − 49.75 is an autoregression of order two, after G. U. Yule (1927).
fn sunspots() -> Vec<Case> {
    let wave = |id: &str, about: &str| {
        Draft::new(id, about, &["real-data"])
            .starting("0 0", "1600 1300; 1300 1600")
            .transition("1.39 -0.69; 1 0")
            .observation("1 0")
            .observation_input("49.75")
    };
    vec![
        wave("real/sunspots", "sunspots 1700-1799 as an autoregression of order two, read with noise")
            .noise("270 0; 0 0", "16")
            .reading(column(SUNSPOTS, 1).take(100)),
        wave("real/sunspots-without-noise", "sunspots 1700-1759, read without noise: what was read is known exactly")
            .noise("270 0; 0 0", "0")
            .reading(column(SUNSPOTS, 1).take(60)),
        wave("real/sunspots-ahead", "sunspots 1750-1789, then twenty years ahead")
            .noise("270 0; 0 0", "16")
            .reading(column(SUNSPOTS, 1).skip(50).take(40).chain([""; 20])),
    ]
}

/// Regressions whose coefficients drift.
fn economy() -> Vec<Case> {
    let quarters = 50;
    let phillips = {
        let past = std::iter::once("0").chain(column(MACRO, 2));
        past.zip(column(MACRO, 3)).take(quarters).map(|(past, unemployment)| format!("1 {past} {unemployment}"))
    };
    let rule =
        column(MACRO, 2).zip(column(MACRO, 3)).map(|(inflation, unemployment)| format!("1 {inflation} {unemployment}"));
    let drift = |id: &str, about: &str| {
        Draft::new(id, about, &["real-data"]).starting("0 0 0", &diagonal(&["16", "1", "1"])).transition(&table(
            3,
            3,
            |i, j| if i == j { "1" } else { "0" }.into(),
        ))
    };
    vec![
        drift("real/phillips-curve", "inflation on its past and on unemployment, 1959-1971: coefficients that drift")
            .observation_matrices(phillips)
            .noise(&diagonal(&["0.01", "0.001", "0.001"]), "2")
            .rule(
                "observation",
                "row k is (1, inflation one quarter before, unemployment); zero before the first quarter",
            )
            .reading(column(MACRO, 2).take(quarters)),
        drift("real/interest-rule", "the rate of treasury bills on inflation and unemployment, 1979-1991")
            .observation_matrices(rule.skip(80).take(quarters))
            .noise(&diagonal(&["0.1", "0.01", "0.01"]), "0.25")
            .reading(column(MACRO, 4).skip(80).take(quarters)),
        Draft::new(
            "real/two-rates",
            "inflation and the rate of treasury bills 1959-1966: one level behind both",
            &["real-data"],
        )
        .starting("2 1", "4 0; 0 1")
        .transition("1 0; 0 0.75")
        .observation("1 0; 1 1")
        .noise("0.1 0; 0 0.2", "2 0; 0 0.1")
        .reading(column(MACRO, 2).zip(column(MACRO, 4)).take(32).map(|(a, b)| format!("{a} {b}"))),
    ]
}

/// A level and one wave a year of twelve months.
fn sea() -> Vec<Case> {
    let months = || EL_NINO.lines().skip(1).flat_map(|line| line.split(',').skip(1));
    let wave = |id: &str, about: &str| {
        Draft::new(id, about, &["real-data"])
            .starting("23 0 0", &diagonal(&["4", "9", "9"]))
            // cos and sin of 2π/12, rounded.
            .transition("1 0 0; 0 0.866 0.5; 0 -0.5 0.866")
            .observation("1 1 0")
            .noise(&diagonal(&["0.05", "0.01", "0.01"]), "0.1")
    };
    vec![
        wave("real/el-nino", "the surface of the sea off Peru by months, 1950-1953").reading(months().take(48)),
        wave("real/el-nino-1982", "the same by months, 1982-1983, when it was warm; every fourth month is left out")
            .reading(
                months().skip(12 * 32).take(24).enumerate().map(|(k, degrees)| if k % 4 == 3 { "" } else { degrees }),
            ),
    ]
}
