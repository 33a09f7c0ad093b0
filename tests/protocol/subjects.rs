//! Subjects that misbehave: each is a finding, ends in bounded time, and does not spoil the next case.

use std::time::{Duration, Instant};

use exact_kalman::protocol::{Limits, Number, Outcome, Reply, Subject};
use exact_kalman::trace::Quantity;

const LIMITS: Limits = Limits { case_time: Duration::from_millis(1500), output_bytes: 1 << 20 };

/// No test may take longer than this, whatever the subject does.
const BOUND: Duration = Duration::from_secs(8);

/// A shell function that reads a line and answers with the id it was asked.
const ECHO: &str = r#"id_of() { printf '%s' "$1" | sed 's/.*"id":"\([^"]*\)".*/\1/'; }
answer() { printf '{"id":"%s","outcome":"answered","steps":[]}\n' "$1"; }
"#;

fn shell(script: &str) -> Subject {
    Subject::new(&["sh".to_owned(), "-c".to_owned(), format!("{ECHO}{script}")], LIMITS)
}

fn line(id: &str) -> String {
    format!(r#"{{"id":"{id}"}}"#)
}

/// Asks, and checks that the time is bounded.
fn ask(subject: &mut Subject, id: &str) -> Reply {
    let start = Instant::now();
    let reply = subject.ask(id, &line(id));
    assert!(start.elapsed() < BOUND, "{:?}", start.elapsed());
    reply
}

fn is_answer(reply: &Reply, to: &str) -> bool {
    matches!(reply, Reply::Answer(answer) if answer.id == to)
}

/// A time to sleep that no other test and no other run of this one asks for.
fn marker(test: u32) -> String {
    format!("1000.{test}{:07}", std::process::id())
}

/// Whether a process with this word on its command line runs.
fn runs(word: &str) -> bool {
    let Ok(entries) = std::fs::read_dir("/proc") else { return false };
    entries.flatten().any(|entry| {
        let command = std::fs::read(entry.path().join("cmdline")).unwrap_or_default();
        String::from_utf8_lossy(&command).contains(word)
    })
}

/// Waits a little for a process to be gone.
fn is_gone(word: &str) -> bool {
    let deadline = Instant::now() + Duration::from_secs(2);
    while runs(word) && Instant::now() < deadline {
        std::thread::sleep(Duration::from_millis(20));
    }
    !runs(word)
}

#[test]
fn a_good_subject_runs_once() {
    let mut subject = shell(r#"while read -r line; do answer "$(id_of "$line")"; done"#);
    for id in ["a", "b/c", "d"] {
        let reply = ask(&mut subject, id);
        assert!(is_answer(&reply, id), "{reply}");
    }
    assert_eq!((subject.starts(), subject.strays().count), (1, 0));
}

#[test]
fn a_hanging_subject_times_out_and_is_started_again() {
    let nap = marker(1);
    let mut subject = shell(&format!(
        r#"while read -r line; do id=$(id_of "$line"); if [ "$id" = hang ]; then sleep {nap}; fi; answer "$id"; done"#,
    ));
    assert!(is_answer(&ask(&mut subject, "a"), "a"));
    assert_eq!(ask(&mut subject, "hang"), Reply::TimedOut { limit: LIMITS.case_time });
    assert!(is_gone(&nap), "the sleeping child of the killed subject still runs");
    assert!(is_answer(&ask(&mut subject, "b"), "b"));
    assert_eq!(subject.starts(), 2);
}

#[test]
fn a_dying_subject_tells_its_last_words() {
    let mut subject = shell(
        r#"while read -r line; do id=$(id_of "$line"); if [ "$id" = die ]; then echo 'last words' >&2; exit 3; fi; answer "$id"; done"#,
    );
    assert!(is_answer(&ask(&mut subject, "a"), "a"));
    let Reply::Died { status, stderr } = ask(&mut subject, "die") else { panic!("died") };
    assert!(status.contains('3') && stderr == "last words\n", "{status}, {stderr}");
    assert!(is_answer(&ask(&mut subject, "b"), "b"));
    let Reply::Died { status, .. } = ask(&mut shell("kill -SEGV $$"), "a") else { panic!("died") };
    assert!(status.contains("signal") && status.contains("11"), "{status}");
}

#[test]
fn standard_error_is_read_and_only_its_end_is_kept() {
    let mut subject = shell(r"head -c 3000000 /dev/zero | tr '\0' x >&2; echo end >&2; read -r line; exit 1");
    let Reply::Died { stderr, .. } = ask(&mut subject, "a") else { panic!("died") };
    assert!(stderr.len() == 4096 && stderr.ends_with("xend\n"), "{}", stderr.len());
}

#[test]
fn a_subject_that_is_over_at_once_died() {
    let mut subject = shell("exit 0");
    let reply = ask(&mut subject, "a");
    assert!(matches!(&reply, Reply::Died { status, .. } if status.contains('0')), "{reply}");
    assert_eq!(subject.starts(), 1, "it answered nothing before, so it is not asked again");
}

#[test]
fn a_subject_may_answer_one_case_per_run() {
    let mut subject = shell(r#"read -r line; answer "$(id_of "$line")""#);
    for id in ["a", "b", "c"] {
        let reply = ask(&mut subject, id);
        assert!(is_answer(&reply, id), "{reply}");
    }
    assert_eq!(subject.starts(), 3);
}

#[test]
fn floods_are_cut_off() {
    for flood in ["yes", "yes '{'", "cat /dev/zero", "printf '{'; cat /dev/zero | tr '\\0' x"] {
        let mut subject = shell(&format!("read -r line; {flood}"));
        let reply = ask(&mut subject, "a");
        // A flood of lines that begin like an answer is malformed at the first of them.
        let malformed = flood.starts_with("yes '{'");
        assert!(
            if malformed {
                matches!(reply, Reply::Malformed { .. })
            } else {
                reply == Reply::Flooded { limit: 1 << 20 }
            },
            "{flood}: {reply}"
        );
    }
}

#[test]
fn a_large_answer_below_the_limit_passes_case_after_case() {
    let mut subject = shell(
        r#"while read -r line; do printf '{"id":"%s","outcome":"error","message":"' "$(id_of "$line")"
           head -c 900000 /dev/zero | tr '\0' x; echo '"}'; done"#,
    );
    for id in ["a", "b", "c"] {
        let Reply::Answer(answer) = ask(&mut subject, id) else { panic!("answer {id}") };
        assert_eq!(answer.message.map(|message| message.len()), Some(900_000));
    }
    assert_eq!(subject.starts(), 1);
}

#[test]
fn stray_lines_are_counted_and_the_first_are_kept() {
    let mut subject = shell(
        r#"echo 'banner: v1.0'; while read -r line; do for i in 1 2 3 4 5 6 7; do echo "debug $i"; done; echo '  '
           printf '\377\376\n'; answer "$(id_of "$line")"; done"#,
    );
    assert!(is_answer(&ask(&mut subject, "a"), "a"));
    assert!(is_answer(&ask(&mut subject, "b"), "b"));
    let strays = subject.strays();
    assert_eq!(strays.count, 17);
    assert_eq!(strays.first, ["banner: v1.0", "debug 1", "debug 2", "debug 3", "debug 4"]);
}

#[test]
fn a_byte_order_mark_and_carriage_returns_do_not_matter() {
    let mut subject = shell(r#"read -r line; printf '\357\273\277{"id":"a","outcome":"answered"}\r\n'; sleep 1000"#);
    assert!(is_answer(&ask(&mut subject, "a"), "a"));
    assert_eq!(subject.strays().count, 0);
}

#[test]
fn answers_out_of_order_name_both_ids() {
    let mut subject = shell(r#"while read -r line; do answer "${last:-nobody}"; last=$(id_of "$line"); done"#);
    for id in ["a", "b"] {
        let Reply::Malformed { detail, line } = ask(&mut subject, id) else { panic!("malformed") };
        assert!(detail.contains("answers out of order") && detail.contains(&format!("asked \"{id}\"")), "{detail}");
        assert!(detail.contains("answered \"nobody\"") && line.starts_with("{\"id\":\"nobody\""), "{detail}");
    }
}

#[test]
fn a_malformed_answer_to_the_right_case_keeps_the_process() {
    let mut subject = shell(
        r#"while read -r line; do printf '{"id":"%s","outcome":"answered","steps":[{"mean":[1]}]}\n' "$(id_of "$line")"; done"#,
    );
    for id in ["a", "b"] {
        let Reply::Malformed { detail, .. } = ask(&mut subject, id) else { panic!("malformed") };
        assert!(detail.contains("steps[0]") && detail.contains("`mean`"), "{detail}");
    }
    assert_eq!(subject.starts(), 1);
}

#[test]
fn truncated_answers_are_malformed() {
    let mut subject = shell(r#"read -r line; printf '{"id":"a","outcome":"answ'"#);
    let Reply::Malformed { detail, line } = ask(&mut subject, "a") else { panic!("malformed") };
    assert!(detail.contains("EOF") && line.ends_with("answ"), "{detail}");
    // A whole answer without its line break is one.
    let mut subject = shell(r#"read -r line; printf '{"id":"a","outcome":"answered"}'"#);
    assert!(is_answer(&ask(&mut subject, "a"), "a"));
    // Half an answer and silence is a hang.
    let mut subject = shell(r#"read -r line; printf '{"id":"a","outcome":"answ'; sleep 1000"#);
    assert!(matches!(ask(&mut subject, "a"), Reply::TimedOut { .. }));
}

#[test]
fn bytes_that_are_not_utf8_are_malformed() {
    let mut subject = shell(r#"read -r line; printf '{"id":"\377"}\n'; sleep 1000"#);
    let Reply::Malformed { detail, .. } = ask(&mut subject, "a") else { panic!("malformed") };
    assert!(detail.contains("UTF-8") && detail.contains("byte 7"), "{detail}");
}

#[test]
fn answers_may_hold_what_is_not_finite() {
    let mut subject = shell(
        r#"read -r line; echo '{"id":"a","outcome":"answered","steps":[{"filtered_mean":["NaN","-Infinity"]}]}'; sleep 1000"#,
    );
    let Reply::Answer(answer) = ask(&mut subject, "a") else { panic!("answer") };
    assert_eq!(answer.outcome, Outcome::Answered);
    let mean = &answer.steps[0][&Quantity::FilteredMean];
    assert_eq!(mean.entries(), [Number::NotANumber, Number::Infinite { negative: true }]);
}

#[test]
fn a_subject_that_never_reads_does_not_block_us() {
    // Far more than a pipe holds.
    let long = format!(r#"{{"id":"a","about":"{}"}}"#, "x".repeat(4 << 20));
    let mut subject = shell("sleep 1000");
    for _ in 0..2 {
        let start = Instant::now();
        assert!(matches!(subject.ask("a", &long), Reply::TimedOut { .. }));
        assert!(start.elapsed() < BOUND);
    }
    // One that answers without reading is let go on, and one that closes its input as well.
    let answers = "answer a; answer a; answer a; sleep 1000";
    for script in [answers.to_owned(), format!("exec 0<&-; {answers}")] {
        let mut subject = shell(&script);
        assert!(matches!(subject.ask("a", &long), Reply::Answer(_)));
        assert!(matches!(subject.ask("a", &long), Reply::Answer(_)));
        let start = Instant::now();
        let _answer_or_time = subject.ask("a", &long);
        assert!(start.elapsed() < BOUND);
    }
}

#[test]
fn a_grandchild_that_holds_the_output_does_not_hold_us() {
    let nap = marker(2);
    let mut subject = shell(&format!("sleep {nap} & read -r line; exit 7"));
    let start = Instant::now();
    let Reply::Died { status, .. } = ask(&mut subject, "a") else { panic!("died") };
    assert!(status.contains('7'), "{status}");
    assert!(start.elapsed() < LIMITS.case_time, "noticed by the death of the child, not by the clock");
    assert!(is_gone(&nap), "the grandchild still runs");
}

#[test]
fn a_subject_that_closes_its_output_and_stays_is_ended() {
    let nap = marker(3);
    let mut subject = shell(&format!("exec 1>&-; sleep {nap}"));
    let Reply::Died { status, .. } = ask(&mut subject, "a") else { panic!("died") };
    assert!(status.contains("closed its standard output"), "{status}");
    assert!(is_gone(&nap));
}

#[test]
fn dropping_ends_the_whole_group() {
    let nap = marker(4);
    let script = r#"while read -r line; do answer "$(id_of "$line")"; done; wait"#;
    let mut subject = shell(&format!("sleep {nap} & {script}"));
    assert!(is_answer(&ask(&mut subject, "a"), "a"));
    assert!(runs(&nap));
    let start = Instant::now();
    drop(subject);
    assert!(start.elapsed() < Duration::from_secs(3));
    assert!(is_gone(&nap));
}

#[test]
fn line_breaks_within_a_case_become_spaces() {
    let mut subject = shell(r#"while read -r line; do answer "$(id_of "$line")"; done"#);
    assert!(is_answer(&subject.ask("a", "{\n\"about\":\"\",\r\n\"id\":\"a\"}"), "a"));
    assert!(is_answer(&ask(&mut subject, "b"), "b"));
}

#[test]
fn a_program_that_is_not_there_is_named() {
    let mut subject = Subject::new(&["no-such-program-here".to_owned()], LIMITS);
    let reply = ask(&mut subject, "a");
    assert!(matches!(reply, Reply::NotStarted { .. }));
    assert!(reply.to_string().contains("no-such-program-here") && reply.to_string().contains("PATH"), "{reply}");
    let reply = ask(&mut Subject::new(&[], LIMITS), "a");
    assert!(reply.to_string().contains("no program to start"), "{reply}");
}

/// A declaration in a script.
const DECLARE: &str = r#"echo '{"format":"exact-kalman/subject/1","name":"shell","unsupported":["diffuse"]}'"#;
/// Answers every case.
const SERVE: &str = r#"while read -r line; do answer "$(id_of "$line")"; done"#;

fn declared(subject: &Subject) -> (Option<&str>, usize) {
    (subject.declaration().and_then(|it| it.name.as_deref()), subject.remarks().len())
}

#[test]
fn a_declaration_comes_before_or_with_the_first_answer() {
    let with_first = r#"read -r line; printf '{"format":"exact-kalman/subject/1","name":"shell"}\n{"id":"%s","outcome":"answered"}\n' "$(id_of "$line")""#;
    for script in [format!("{DECLARE}; {SERVE}"), format!("{with_first}; {SERVE}")] {
        let mut subject = shell(&script);
        assert_eq!(declared(&subject), (None, 0), "nothing is started before it is asked");
        for id in ["a", "b", "c"] {
            let reply = ask(&mut subject, id);
            assert!(is_answer(&reply, id), "{script}: {reply}");
            assert_eq!(declared(&subject), (Some("shell"), 0));
        }
        assert_eq!((subject.starts(), subject.strays().count), (1, 0));
    }
}

#[test]
fn declarations_that_do_not_count_are_passed_over() {
    let bad = r#"echo '{"format":"exact-kalman/subject/1","nam":"shell"}'"#;
    let newer = r#"echo '{"format":"exact-kalman/subject/2"}'"#;
    for (script, name) in [
        (format!("{DECLARE}; {DECLARE}; {SERVE}"), Some("shell")),
        (format!("{bad}; {SERVE}"), None),
        (format!("{newer}; {SERVE}"), None),
        (format!(r#"while read -r line; do answer "$(id_of "$line")"; {DECLARE}; done"#), None),
    ] {
        let mut subject = shell(&script);
        for id in ["a", "b"] {
            let reply = ask(&mut subject, id);
            assert!(is_answer(&reply, id), "{script}: {reply}");
        }
        assert_eq!((declared(&subject), subject.starts()), ((name, 1), 1), "{script}: {:?}", subject.remarks());
    }
}

#[test]
fn one_answer_per_run_may_declare_in_each() {
    let mut subject = shell(&format!(r#"{DECLARE}; read -r line; answer "$(id_of "$line")""#));
    for id in ["a", "b", "c"] {
        assert!(is_answer(&ask(&mut subject, id), id));
    }
    assert_eq!((declared(&subject), subject.starts()), ((Some("shell"), 0), 3));
}

#[test]
fn a_declaration_is_no_answer() {
    // A hang and a death after it are what they are without it.
    let mut subject = shell(&format!("{DECLARE}; sleep 1000"));
    assert!(matches!(ask(&mut subject, "a"), Reply::TimedOut { .. }));
    let mut subject = shell(&format!("{DECLARE}; read -r line; exit 3"));
    assert!(matches!(ask(&mut subject, "a"), Reply::Died { .. }));
    assert_eq!(declared(&subject), (Some("shell"), 0));
}

#[test]
fn declarations_without_end_are_cut_off() {
    let flood = r#"{"format":"exact-kalman/subject/1","name":"shell"}"#;
    let mut subject = shell(&format!("yes '{flood}'"));
    let reply = ask(&mut subject, "a");
    assert!(matches!(reply, Reply::Flooded { .. } | Reply::TimedOut { .. }), "{reply}");
    // A single one, longer than all that may be said of a case.
    let mut subject = shell(
        r#"printf '{"format":"exact-kalman/subject/1","name":"'; head -c 64000000 /dev/zero | tr '\0' x; echo '"}'"#,
    );
    assert_eq!(ask(&mut subject, "a"), Reply::Flooded { limit: 1 << 20 });
    // One that is shorter than that and longer than a declaration: the case is answered all the same.
    let mut subject = shell(&format!(
        r#"printf '{{"format":"exact-kalman/subject/1","name":"'; head -c 900000 /dev/zero | tr '\0' x; echo '"}}'; {SERVE}"#
    ));
    assert!(is_answer(&ask(&mut subject, "a"), "a"));
    assert_eq!(declared(&subject), (None, 1));
    assert!(subject.remarks()[0].contains("at most 65536") && subject.remarks()[0].len() < 300);
}

#[test]
fn a_name_that_is_not_utf8_is_malformed() {
    let mut subject = shell(&format!(r#"printf '{{"format":"exact-kalman/subject/1","name":"\377"}}\n'; {SERVE}"#));
    let Reply::Malformed { detail, .. } = ask(&mut subject, "a") else { panic!("malformed") };
    assert!(detail.contains("UTF-8"), "{detail}");
}
