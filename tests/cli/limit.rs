//! Exact numbers that grow too long.

use serde_json::Value;

use crate::program::{feed, run, walk};

const WALK: &str = "examples/cases/walk.json";

/// What is told is what an unlimited run tells at first, and as much of it as the limit allows.
#[test]
fn what_was_computed_before_the_limit_is_printed() {
    let case = walk("long", &["0.1"; 40]);
    let all = feed(&["solve", "-"], &case).quietly(0);
    assert_eq!(all, feed(&["solve", "-", "--max-bits", "none"], &case).quietly(0));
    let mut before = 0;
    for limit in ["8", "20", "40", "100000"] {
        let ran = feed(&["solve", "-", "--max-bits", limit], &case);
        let steps = ran.stdout.matches(" · step ").count();
        assert!(steps > before || steps == 40, "{steps} steps with {limit} bits");
        before = steps;
        assert!(all.starts_with(&ran.stdout), "{}", ran.stdout);
        if steps == 40 {
            assert_eq!((ran.code, ran.stderr.as_str()), (0, ""));
            continue;
        }
        assert_eq!(ran.code, 3);
        let opening = format!("long: at step {steps} exact numbers have grown to ");
        let bits = ran.stderr.strip_prefix(&opening).and_then(|rest| rest.split(' ').next()).expect(&ran.stderr);
        assert!(bits.parse::<u64>().expect("a number") > limit.parse().expect("a number"), "{}", ran.stderr);
        assert!(ran.stderr.contains(&format!("beyond the limit of {limit}; ")), "{}", ran.stderr);
        assert!(ran.stderr.contains("higher --max-bits") && ran.stderr.lines().count() == 1, "{}", ran.stderr);
    }
    assert_eq!(before, 40);
    let ran = feed(&["solve", "-", "--max-bits", "20", "--last"], &case);
    assert!(
        ran.code == 3 && ran.stdout.matches(" · step ").count() == 1 && all.contains(&ran.stdout),
        "{}",
        ran.stdout
    );
}

#[test]
fn an_answer_that_grows_too_long_is_an_answer() {
    let case = walk("long", &["0.1"; 40]);
    let ran = feed(&["solve", "-", "--max-bits", "20", "--format", "json"], &case);
    let answer: Value = serde_json::from_str(&ran.stdout).expect("it is JSON");
    let steps = answer["steps"].as_array().expect("as the schema has it").len();
    assert!((1..40).contains(&steps));
    assert_eq!((&answer["outcome"], &answer["step"]), (&"error".into(), &steps.into()));
    assert!(
        answer["message"].as_str().expect("as the schema has it").starts_with("exact numbers have grown to"),
        "{answer}"
    );
    assert_eq!(ran.code, 3);
}

/// By hand: a walk has the variances 1/2, 3/5, 8/13, … of Fibonacci's numbers. The first denominator of more than twenty
/// bits is 1346269, at step 14; a sixteenth of 320 bits is twenty.
#[test]
fn the_readable_recursion_is_bounded_too() {
    for more in [&["--trace"][..], &["--ahead", "1"], &["--ahead", "3", "--trace"]] {
        let ran = feed(&[&["solve", "-", "--exact", "--max-bits", "320"], more].concat(), &walk("walk", &["1"; 40]));
        assert!(ran.stderr.starts_with("walk: at step 15 exact numbers have grown to 21 bits, "), "{}", ran.stderr);
        assert!(ran.stderr.contains("beyond the limit of 20;") && ran.code == 3, "{}", ran.stderr);
        assert!(ran.stdout.contains("walk · step 14\n") && !ran.stdout.contains("walk · step 15\n"));
        assert!(ran.stdout.contains("832040/1346269\n"), "{}", ran.stdout);
        // Where nothing follows, nothing is too long.
        let whole = feed(&[&["solve", "-", "--max-bits", "320"], more].concat(), &walk("walk", &["1"; 15]));
        assert_eq!(whole.quietly(0).matches(" · step ").count(), 15);
    }
}

/// One case that is too long does not hide the others, and what is worse counts.
#[test]
fn the_worst_exit_code_counts() {
    let stream = [walk("long", &["0.1"; 40]), walk("short", &["1"]), walk("bad", &["NaN"])];
    let ran = feed(&["solve", "-", "--max-bits", "20"], &stream[..2].join("\n"));
    assert!(ran.code == 3 && ran.stdout.contains("short · step 0"), "{}", ran.stdout);
    assert_eq!(feed(&["solve", "-", "--max-bits", "20"], &stream.join("\n")).code, 2);
}

#[test]
fn limits_are_numbers() {
    for limit in ["0", "-1", "1e6", "all", ""] {
        let ran = run(&["solve", WALK, &format!("--max-bits={limit}")]);
        assert_eq!((ran.code, ran.stdout.as_str()), (2, ""));
        assert!(ran.stderr.contains("at least 1, or `none`"), "{}", ran.stderr);
    }
}
