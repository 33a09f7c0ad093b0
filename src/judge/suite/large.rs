//! A dozen states and more.

use super::basic::chain;
use super::draft::Draft;
use super::draw::Draw;
use super::table::{multiple, table, zeros};
use crate::protocol::Case;

const FLAGS: [&str; 1] = ["large"];

pub(super) fn cases(draw: Draw) -> Vec<Case> {
    let ends = |n: usize| table(2, n, |i, j| if j == i * (n - 1) { "1" } else { "0" }.into());
    vec![
        Draft::new("large/chain-of-twelve", "twelve states in a chain, read at both ends", &FLAGS)
            .starting(&zeros(12), &multiple(12, "1"))
            .transition(&chain(12, "0.5", "0.25"))
            .observation(&ends(12))
            .noise(&multiple(12, "0.125"), "0.5 0; 0 1")
            .reading(draw.pairs(301, 6)),
        Draft::new("large/chain-of-twenty", "twenty states in a chain, of which the first is read", &FLAGS)
            .starting(&zeros(20), &multiple(20, "1"))
            .transition(&chain(20, "0.5", "0.5"))
            .observation(&table(1, 20, |_, j| if j == 0 { "1" } else { "0" }.into()))
            .noise(&multiple(20, "0.125"), "0.5")
            .reading(draw.singles(302, 5, 3000)),
        Draft::new("large/season-of-twelve", "a level and a season of twelve months", &FLAGS)
            .starting(&zeros(12), &multiple(12, "4"))
            .transition(&table(12, 12, |i, j| {
                match (i, j) {
                    (0, 0) => "1",
                    (1, 1..) => "-1",
                    (2.., _) if j + 1 == i => "1",
                    _ => "0",
                }
                .into()
            }))
            .observation(&table(1, 12, |_, j| if j < 2 { "1" } else { "0" }.into()))
            .noise(&table(12, 12, |i, j| if i == j && i < 2 { "0.25" } else { "0" }.into()), "0.5")
            .reading(draw.singles(303, 8, 4000)),
        Draft::new("large/six-sensors", "six states, each read, with noise that neighbours share", &FLAGS)
            .starting(&zeros(6), &multiple(6, "2"))
            .transition(&chain(6, "0.75", "-0.25"))
            .observation(&multiple(6, "1"))
            .noise(
                &multiple(6, "0.25"),
                &table(6, 6, |i, j| {
                    if i == j {
                        "1"
                    } else if i.abs_diff(j) == 1 {
                        "0.25"
                    } else {
                        "0"
                    }
                    .into()
                }),
            )
            .reading(draw.several(6, 304, 5, 3000)),
        Draft::new("large/chain-of-thirty", "thirty states in a chain, read at both ends", &FLAGS)
            .starting(&zeros(30), &multiple(30, "1"))
            .transition(&chain(30, "0.5", "0.3"))
            .observation(&ends(30))
            .noise(&multiple(30, "0.1"), "0.5 0; 0 1")
            .reading(draw.pairs(334, 8)),
        Draft::new(
            "large/long-chain-of-twelve",
            "twelve states in a chain, read at both ends, for sixty steps",
            &FLAGS,
        )
        .starting(&zeros(12), &multiple(12, "1"))
        .transition(&chain(12, "0.5", "0.4"))
        .observation(&ends(12))
        .noise(&multiple(12, "0.1"), "0.5 0; 0 1")
        .reading(draw.pairs(335, 60)),
    ]
}
