//! Runs the program and keeps what it says.

use std::fs;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::sync::atomic::{AtomicUsize, Ordering};

pub(crate) const PROGRAM: &str = env!("CARGO_BIN_EXE_exact-kalman");

/// How a run ended. Whatever was asked, it was no panic, and nothing that belongs on a terminal.
#[derive(Debug)]
pub(crate) struct Ran {
    pub(crate) code: i32,
    pub(crate) stdout: String,
    pub(crate) stderr: String,
}

impl Ran {
    pub(crate) fn of(output: Output) -> Self {
        let text = |bytes| String::from_utf8(bytes).expect("UTF-8");
        let (stdout, stderr) = (text(output.stdout), text(output.stderr));
        assert!(!stderr.contains("panicked"), "{stderr}");
        for text in [&stdout, &stderr] {
            assert!(!text.contains('\u{1b}') && !text.contains('\r'), "{text:?}");
        }
        Self { code: output.status.code().expect("no signal"), stdout, stderr }
    }

    /// The run, if it ended with this code and said nothing on standard error.
    pub(crate) fn quietly(self, code: i32) -> String {
        assert_eq!((self.code, self.stderr.as_str()), (code, ""), "{}", self.stdout);
        self.stdout
    }

    /// The one line on standard error of a run that ended in trouble without any result.
    pub(crate) fn trouble(self) -> String {
        assert_eq!((self.code, self.stdout.as_str()), (2, ""), "{}", self.stderr);
        assert!(self.stderr.starts_with("error: ") && self.stderr.lines().count() == 1, "{}", self.stderr);
        self.stderr
    }
}

/// The program with these arguments, from the root of the project.
pub(crate) fn program(arguments: &[&str]) -> Command {
    let mut command = Command::new(PROGRAM);
    command.args(arguments).current_dir(env!("CARGO_MANIFEST_DIR")).stdin(Stdio::null());
    command
}

pub(crate) fn run(arguments: &[&str]) -> Ran {
    Ran::of(program(arguments).output().expect("the program starts"))
}

/// Runs it with this text on standard input.
pub(crate) fn feed(arguments: &[&str], input: &str) -> Ran {
    let mut child = program(arguments)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program starts");
    // A program that has seen enough may close its end.
    let _ = child.stdin.take().expect("a pipe").write_all(input.as_bytes());
    Ran::of(child.wait_with_output().expect("the program ends"))
}

/// A directory of its own that is gone in the end.
pub(crate) struct Directory(PathBuf);

impl Directory {
    pub(crate) fn new() -> Self {
        static COUNT: AtomicUsize = AtomicUsize::new(0);
        let number = COUNT.fetch_add(1, Ordering::Relaxed);
        let path = std::env::temp_dir().join(format!("exact-kalman-{}-{number}", std::process::id()));
        fs::create_dir_all(&path).expect("a writable directory");
        Self(path)
    }

    pub(crate) fn path(&self) -> &Path {
        &self.0
    }

    /// The path of a file with this text.
    pub(crate) fn file(&self, name: &str, text: impl AsRef<[u8]>) -> String {
        let path = self.0.join(name);
        fs::create_dir_all(path.parent().expect("a directory")).expect("a writable directory");
        fs::write(&path, text).expect("a writable directory");
        path.to_str().expect("UTF-8").to_owned()
    }

    pub(crate) fn name(&self) -> &str {
        self.0.to_str().expect("UTF-8")
    }
}

impl Drop for Directory {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

/// A scalar random walk with these readings, on one line.
pub(crate) fn walk(id: &str, readings: &[&str]) -> String {
    let readings: Vec<String> = readings.iter().map(|reading| format!("[\"{reading}\"]")).collect();
    format!(
        r#"{{"format":"exact-kalman/case/1","id":"{id}","timing":"departing","initial":{{"before":"observation","mean":["0"],"covariance":[["1"]]}},"transition":[["1"]],"observation":[["1"]],"noise":{{"process":[["1"]],"observation":[["1"]]}},"observations":[{}]}}"#,
        readings.join(",")
    )
}
