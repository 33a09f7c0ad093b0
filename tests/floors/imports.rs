//! Which rooms a source file names.

use std::collections::BTreeSet;

use crate::code::{code, is_word};

/// The rooms that code names as `crate::room`, in groups too: `crate::{a::b, c}` names a and c.
///
/// `depth` is the number of modules around the code: as many times `super` lead to the same place as `crate`.
pub fn rooms_named(source: &str, depth: usize) -> BTreeSet<String> {
    let code = code(source);
    let mut rooms = BTreeSet::new();
    for root in ["crate::", &"super::".repeat(depth.max(1))] {
        for (start, path) in code.match_indices(root) {
            // The end of another name, such as `my_crate::`.
            if code[..start].ends_with(is_word) {
                continue;
            }
            let rest = &code[start + path.len()..];
            let heads = if rest.starts_with('{') { heads_of_group(rest) } else { vec![word(rest)] };
            rooms.extend(heads.into_iter().filter(|head| !head.is_empty()));
        }
    }
    rooms
}

fn word(text: &str) -> String {
    text.chars().take_while(|&letter| is_word(letter)).collect()
}

/// The first words of the members of `{a::b, c::{d, e}}`.
fn heads_of_group(group: &str) -> Vec<String> {
    let (mut heads, mut depth) = (Vec::new(), 0);
    for (place, letter) in group.char_indices() {
        match letter {
            '{' => depth += 1,
            '}' => depth -= 1,
            _ => {}
        }
        if depth == 0 {
            break;
        }
        if depth == 1 && (letter == ',' || place == 0) {
            heads.push(word(&group[place + 1..]));
        }
    }
    heads
}

#[test]
fn comments_and_texts_are_no_imports() {
    let source = r#"
        //! [`crate::filter`]
        /* crate::judge /* nested */ crate::cli */
        const A: &str = "crate::report \" crate::cli";
        const B: &str = r"crate::protocol";
        const C: [char; 2] = ['"', '\''];
        fn f<'a>(x: &'a crate::model::Path<u8>) {} // crate::float
    "#;
    assert_eq!(rooms_named(source, 1), BTreeSet::from(["model".to_owned()]));
    let raw = "const B: &str = r#\"crate::\"protocol\"\"#; use crate::trace::Trace;";
    assert_eq!(rooms_named(raw, 1), BTreeSet::from(["trace".to_owned()]));
}
