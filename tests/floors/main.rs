//! Imports go downwards: a room knows the rooms on lower floors, and no other room on its own.

mod code;
mod imports;
mod rooms;

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use imports::rooms_named;
use rooms::{floor, violations};

const MAXIMAL_LINES: usize = 400;

fn sources() -> BTreeMap<PathBuf, String> {
    fn collect(directory: &Path, files: &mut BTreeMap<PathBuf, String>) {
        for entry in fs::read_dir(directory).unwrap_or_else(|error| panic!("{}: {error}", directory.display())) {
            let path = entry.unwrap_or_else(|error| panic!("{error}")).path();
            if path.is_dir() {
                collect(&path, files);
            } else if path.extension().is_some_and(|extension| extension == "rs") {
                let text = fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
                files.insert(path, text);
            }
        }
    }
    let mut files = BTreeMap::new();
    collect(&root(), &mut files);
    files
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("src")
}

/// `src/matrix/solve.rs` is in `matrix`, `src/lib.rs` in `lib`, and the program `src/main.rs` in `cli`.
fn room_of(path: &Path) -> String {
    let inside = path.strip_prefix(root()).unwrap_or(path);
    let first = inside.components().next().map(|part| part.as_os_str().to_string_lossy().into_owned());
    let first = first.unwrap_or_default();
    match first.strip_suffix(".rs").unwrap_or(&first) {
        "main" => "cli".to_owned(),
        name => name.to_owned(),
    }
}

/// The modules around the code of a file: none for `src/lib.rs`, one for `src/matrix/mod.rs`, two for
/// `src/matrix/solve.rs`.
fn depth_of(path: &Path) -> usize {
    let inside = path.strip_prefix(root()).unwrap_or(path);
    let own = inside.file_stem().is_some_and(|stem| !["mod", "lib", "main"].iter().any(|name| stem == *name));
    inside.components().count() - 1 + usize::from(own)
}

#[test]
fn imports_go_downwards() {
    let (mut found, mut imports) = (Vec::new(), 0);
    for (path, source) in sources() {
        imports += rooms_named(&source, depth_of(&path)).len();
        found.extend(
            violations(&room_of(&path), depth_of(&path), &source)
                .into_iter()
                .map(|what| format!("{}: {what}", path.display())),
        );
    }
    assert!(found.is_empty(), "{}", found.join("\n"));
    assert!(imports > 100, "only {imports} imports were seen");
}

#[test]
fn files_are_short() {
    let sources = sources();
    assert!(sources.len() > 50, "only {} files were seen", sources.len());
    for (path, source) in sources {
        let lines = source.lines().count();
        assert!(lines <= MAXIMAL_LINES, "{} has {lines} lines", path.display());
    }
}

#[test]
fn rooms_name_their_floor() {
    let mut seen = 0;
    for (path, source) in sources() {
        let room = room_of(&path);
        if path != root().join(&room).join("mod.rs") {
            continue;
        }
        let floor = floor(&room).unwrap_or_else(|| panic!("{room} has no floor"));
        let opening = format!("//! Floor {floor} · ");
        assert!(source.starts_with(&opening), "{} opens with «{opening}…»", path.display());
        seen += 1;
    }
    assert!(seen >= 8, "only {seen} rooms were seen");
}
