//! Rust source without what only looks like code.

/// The code without comments and texts, so that what a comment mentions is no import; white space only where two words
/// would else become one.
///
/// It knows line comments, block comments, plain and raw texts and characters: what a lexer must, to find where they
/// end.
pub fn code(source: &str) -> String {
    let bare = without_comments_and_texts(source);
    let mut code = String::new();
    for part in bare.split_whitespace() {
        let glued = code.chars().next_back().is_some_and(is_word) && part.starts_with(is_word);
        if glued {
            code.push(' ');
        }
        code.push_str(part);
    }
    code
}

/// Whether a name may hold the letter.
pub fn is_word(letter: char) -> bool {
    letter.is_alphanumeric() || letter == '_'
}

fn without_comments_and_texts(source: &str) -> String {
    let letters: Vec<char> = source.chars().collect();
    let at = |i: usize| letters.get(i).copied().unwrap_or('\0');
    let (mut code, mut i) = (String::new(), 0);
    while i < letters.len() {
        match (at(i), at(i + 1)) {
            ('/', '/') => {
                while i < letters.len() && at(i) != '\n' {
                    i += 1;
                }
            }
            ('/', '*') => {
                let mut depth = 0;
                loop {
                    match (at(i), at(i + 1)) {
                        ('/', '*') => depth += 1,
                        ('*', '/') => depth -= 1,
                        _ => {
                            i += 1;
                            continue;
                        }
                    }
                    i += 2;
                    if depth == 0 || i >= letters.len() {
                        break;
                    }
                }
            }
            ('r', '"' | '#') if i == 0 || !is_word(at(i - 1)) => {
                let hashes = (i + 1..letters.len()).take_while(|&k| at(k) == '#').count();
                if at(i + 1 + hashes) == '"' {
                    i += 2 + hashes;
                    while i < letters.len() && !(at(i) == '"' && (1..=hashes).all(|k| at(i + k) == '#')) {
                        i += 1;
                    }
                    i += 1 + hashes;
                } else {
                    code.push(at(i));
                    i += 1;
                }
            }
            ('"', _) => {
                i += 1;
                while i < letters.len() && at(i) != '"' {
                    i += if at(i) == '\\' { 2 } else { 1 };
                }
                i += 1;
            }
            // A character, which may be a quotation mark; else a lifetime.
            ('\'', '\\') => {
                i += 3;
                while i < letters.len() && at(i) != '\'' {
                    i += 1;
                }
                i += 1;
            }
            ('\'', _) if at(i + 2) == '\'' => i += 3,
            (letter, _) => {
                code.push(letter);
                i += 1;
            }
        }
    }
    code
}
