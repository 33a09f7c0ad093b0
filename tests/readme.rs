//! The console sessions of the README and of the page of `solve` print what they say.
#![cfg(feature = "cli")]

use std::process::Command;

/// The sessions of a page: commands with the output that follows them.
fn sessions(page: &str) -> Vec<(String, String)> {
    let blocks = page.split("```console\n").skip(1).filter_map(|rest| rest.split("```").next());
    blocks
        .flat_map(|block| block.split("$ exact-kalman ").skip(1))
        .filter_map(|session| session.split_once('\n'))
        .map(|(command, output)| (command.to_owned(), output.to_owned()))
        .collect()
}

#[test]
fn console_sessions_are_true() -> Result<(), std::io::Error> {
    let pages = [include_str!("../README.md"), include_str!("../docs/SOLVE.md")].map(sessions);
    assert!(pages[0].len() >= 2 && !pages[1].is_empty());
    let sessions = pages.concat();
    for (command, expected) in sessions {
        let output = Command::new(env!("CARGO_BIN_EXE_exact-kalman"))
            .args(command.split_whitespace())
            .current_dir(env!("CARGO_MANIFEST_DIR"))
            .output()?;
        assert_eq!(String::from_utf8_lossy(&output.stdout), expected, "exact-kalman {command}");
        assert!(output.status.success(), "exact-kalman {command}");
    }
    Ok(())
}
