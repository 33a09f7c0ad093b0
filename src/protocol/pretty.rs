//! JSON on several lines, short lists and objects on one.

/// The longest list or object that stays on one line.
const WIDTH: usize = 96;

/// The JSON text `compact`, which has no white space between tokens, spread over lines.
pub(super) fn indented(compact: &str) -> String {
    let ends = ends(compact.as_bytes());
    let mut out = String::with_capacity(compact.len() * 2);
    let (mut depth, mut flat_until, mut quoted, mut escaped) = (0_usize, 0_usize, false, false);
    for (place, character) in compact.char_indices() {
        let flat = place < flat_until;
        if quoted {
            out.push(character);
            quoted = escaped || character != '"';
            escaped = !escaped && character == '\\';
            continue;
        }
        match character {
            '"' => {
                quoted = true;
                out.push(character);
            }
            '[' | '{' => {
                out.push(character);
                let end = ends.get(&place).copied().unwrap_or(place);
                if !flat && end - place <= WIDTH {
                    flat_until = end + 1;
                } else if !flat {
                    depth += 1;
                    new_line(&mut out, depth);
                }
            }
            ']' | '}' => {
                if !flat {
                    depth = depth.saturating_sub(1);
                    new_line(&mut out, depth);
                }
                out.push(character);
            }
            ',' if flat => out.push_str(", "),
            ',' => {
                out.push(character);
                new_line(&mut out, depth);
            }
            ':' => out.push_str(": "),
            other => out.push(other),
        }
    }
    out.push('\n');
    out
}

fn new_line(out: &mut String, depth: usize) {
    out.push('\n');
    out.extend(std::iter::repeat_n("  ", depth));
}

/// For each opening bracket the place of its closing one.
fn ends(text: &[u8]) -> std::collections::HashMap<usize, usize> {
    let (mut open, mut ends) = (Vec::new(), std::collections::HashMap::new());
    let (mut quoted, mut escaped) = (false, false);
    for (place, byte) in text.iter().enumerate() {
        if quoted {
            quoted = escaped || *byte != b'"';
            escaped = !escaped && *byte == b'\\';
            continue;
        }
        match byte {
            b'"' => quoted = true,
            b'[' | b'{' => open.push(place),
            b']' | b'}' => ends.extend(open.pop().map(|start| (start, place))),
            _ => {}
        }
    }
    ends
}
