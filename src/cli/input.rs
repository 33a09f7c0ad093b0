//! Reads cases from files, directories and standard input.

use std::collections::BTreeSet;
use std::fs::{self, File};
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use super::exit::Trouble;
use crate::judge::suite_seeded;
use crate::protocol::{Case, MAXIMAL_DOCUMENT_BYTES};

/// The text of a file, or of standard input for `-`, of bounded length.
pub(super) fn text(path: &Path) -> Result<String, Trouble> {
    let place = path.display().to_string();
    let input = |source| Trouble::Input { place: place.clone(), source };
    let mut text = String::new();
    let most = MAXIMAL_DOCUMENT_BYTES as u64 + 1;
    let read = if path == Path::new("-") {
        io::stdin().lock().take(most).read_to_string(&mut text)
    } else {
        File::open(path).and_then(|file| file.take(most).read_to_string(&mut text))
    };
    if read.map_err(input)? > MAXIMAL_DOCUMENT_BYTES {
        return Err(Trouble::TooLarge { place, limit: MAXIMAL_DOCUMENT_BYTES });
    }
    Ok(text)
}

/// That what is written does not replace the file that is read.
pub(super) fn keep(read: &Path, written: &Path) -> Result<(), Trouble> {
    match (fs::canonicalize(read), fs::canonicalize(written)) {
        (Ok(one), Ok(other)) if one == other => {
            let message = "is the file that is read, and would be replaced; give another".into();
            Err(Trouble::Other { place: written.display().to_string(), message })
        }
        _ => Ok(()),
    }
}

/// The cases of a file (one case, or one on each line), of standard input for `-`, or of all files named `*.json` or
/// `*.jsonl` below a directory, in the order of their names.
pub(super) fn cases(path: &Path) -> Result<Vec<Case>, Trouble> {
    let mut files = Vec::new();
    // A suite that was written with its references has its cases below a directory of its own.
    let below = path.join("cases");
    let is_release = path.join("MANIFEST.json").is_file() && below.is_dir();
    collect(if is_release { &below } else { path }, &mut files)?;
    let mut cases = Vec::new();
    let mut ids = BTreeSet::new();
    for file in files {
        for case in cases_of(&file)? {
            if !ids.insert(case.id.clone()) {
                let message = format!("the id {:?} is used twice; answers are told apart by their ids", case.id);
                return Err(Trouble::Other { place: file.display().to_string(), message });
            }
            cases.push(case);
        }
    }
    if cases.is_empty() {
        return Err(Trouble::Other { place: path.display().to_string(), message: "there is no case in it".into() });
    }
    Ok(cases)
}

fn collect(path: &Path, files: &mut Vec<PathBuf>) -> Result<(), Trouble> {
    if !path.is_dir() {
        files.push(path.to_owned());
        return Ok(());
    }
    let input = |source| Trouble::Input { place: path.display().to_string(), source };
    let entries = fs::read_dir(path).map_err(input)?.collect::<Result<Vec<_>, _>>().map_err(input)?;
    let mut entries: Vec<(PathBuf, bool)> =
        entries.into_iter().map(|entry| (entry.path(), entry.file_type().is_ok_and(|kind| kind.is_dir()))).collect();
    entries.sort();
    for (path, is_directory) in entries {
        let named = path.extension().is_some_and(|extension| extension == "json" || extension == "jsonl");
        // A link to a directory may lead back to here: it is not followed.
        if is_directory || (named && !path.is_dir()) {
            collect(&path, files)?;
        }
    }
    Ok(())
}

fn cases_of(path: &Path) -> Result<Vec<Case>, Trouble> {
    let text = text(path)?;
    // Some editors write a byte order mark.
    let text = text.strip_prefix('\u{feff}').unwrap_or(&text);
    let lines = || text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty());
    let Some((_, first)) = lines().next() else { return Ok(Vec::new()) };
    let read = |place: String, text: &str| Case::parse(text).map_err(|source| Trouble::Case { place, source });
    // One case on each line if the first line is a whole document; otherwise the file is one case.
    if serde_json::from_str::<serde::de::IgnoredAny>(first).is_err() {
        return Ok(vec![read(path.display().to_string(), text)?]);
    }
    lines().map(|(number, line)| read(format!("{}, line {}", path.display(), number + 1), line)).collect()
}

/// Which cases a verb works on.
#[derive(clap::Args, Debug)]
pub(super) struct Selection {
    /// Cases of your own: a file (one case, or one on each line), a directory of such files, or `-` for standard
    /// input [default: the built-in suite].
    #[arg(long, value_name = "PATH")]
    cases: Option<PathBuf>,
    /// Only cases with this text in their id or in one of their flags; given several times, with any of them.
    #[arg(long, value_name = "TEXT")]
    only: Vec<String>,
    /// Only cases of this category, which is the first part of their ids; given several times, of any of them.
    #[arg(long, value_name = "NAME")]
    category: Vec<String>,
    /// Draw the made-up readings of the built-in suite anew; 0 has the published ones [default: 0].
    #[arg(long, value_name = "N", conflicts_with = "cases")]
    seed: Option<u64>,
}

impl Selection {
    /// Whether standard input is read.
    pub(super) fn is_standard_input(&self) -> bool {
        self.cases.as_deref() == Some(Path::new("-"))
    }

    /// Whether nothing is chosen from the built-in suite.
    pub(super) fn is_whole_suite(&self) -> bool {
        self.cases.is_none() && self.only.is_empty() && self.category.is_empty()
    }

    /// The seed of the built-in suite; nothing for cases of one's own.
    pub(super) fn seed(&self) -> Option<u64> {
        self.cases.is_none().then(|| self.seed.unwrap_or(0))
    }

    /// The selection from the cases of a file that is named elsewhere on the command line.
    pub(super) fn with_cases(self, path: &Path) -> Result<Self, Trouble> {
        if self.cases.is_some() {
            let message = "the cases are named twice".to_owned();
            return Err(Trouble::Other { place: "--cases".into(), message });
        }
        Ok(Self { cases: Some(path.to_owned()), ..self })
    }

    pub(super) fn cases(&self) -> Result<Vec<Case>, Trouble> {
        let all = match &self.cases {
            Some(path) => cases(path)?,
            None => suite_seeded(self.seed.unwrap_or(0)),
        };
        let category = |case: &Case| case.id.split('/').next().unwrap_or_default().to_owned();
        if let Some(unknown) = self.category.iter().find(|name| all.iter().all(|case| category(case) != **name)) {
            let names: BTreeSet<String> = all.iter().map(category).collect();
            let names: Vec<String> = names.into_iter().collect();
            let message = format!("no category {unknown:?}; there are {}", names.join(", "));
            return Err(Trouble::Other { place: "--category".into(), message });
        }
        let wanted = |case: &Case| {
            let matches = |text: &String| case.id.contains(text) || case.flags.iter().any(|flag| flag.contains(text));
            (self.only.is_empty() || self.only.iter().any(matches))
                && (self.category.is_empty() || self.category.contains(&category(case)))
        };
        let chosen: Vec<Case> = all.into_iter().filter(wanted).collect();
        if chosen.is_empty() {
            let within = if self.category.is_empty() {
                String::new()
            } else {
                format!(" in category {}", self.category.join(", "))
            };
            let texts = self.only.iter().map(|text| format!("{text:?}")).collect::<Vec<_>>().join(" or ");
            let message = format!("no case{within} has an id or a flag with {texts}; `exact-kalman cases` lists them");
            return Err(Trouble::Other { place: "--only".into(), message });
        }
        Ok(chosen)
    }
}
