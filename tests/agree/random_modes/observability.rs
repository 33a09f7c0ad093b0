//! Decisions about observability against the Gramians of all windows.

use std::cell::Cell;

use exact_kalman::matrix::Matrix;
use exact_kalman::scalar::{Rational, Scalar, ratio};
use exact_kalman::stability::{MarginError, Mode, Start, UnobservableLoop, UnobservablePath, Window};
use proptest::test_runner::{Config, TestCaseError, TestRunner};

use super::super::systems::Q;
use super::draws::draws;
use super::{Process, windows};

const LONGEST: usize = 4;

/// WG-6: `G(k+h,k) = ∑[i=k..k+h−1] Φᵀ(i,k)Hᵀ(i)H(i)Φ(i,k),  𝒢(k) = σ{F(i), H(i), i ≤ k}`, or i = k+1, …, k+h.
pub fn gramian(process: &Process, window: Window, modes: &[usize]) -> Q {
    let d = process.states();
    let mut sum = Matrix::zeros(d, d);
    let mut transition = Matrix::identity(d);
    for (place, &mode) in modes.iter().enumerate() {
        let mode = &process.modes()[mode];
        if window == Window::Shifted || place > 0 {
            let seen = mode.observation() * &transition;
            sum = sum + seen.transpose() * &seen;
        }
        transition = mode.transition() * transition;
    }
    sum
}

/// All windows of h steps, with their Gramians.
fn gramians(process: &Process, window: Window, length: usize) -> Vec<(Vec<usize>, Q)> {
    let steps = length + usize::from(window == Window::Printed);
    let windows = windows(process, steps).into_iter();
    windows.map(|modes| (gramian(process, window, &modes), modes)).map(|(gramian, modes)| (modes, gramian)).collect()
}

fn is_singular(gramian: &Q) -> bool {
    gramian.determinant() == Ok(ratio(0, 1))
}

/// The modes at which a window begins that fails.
fn failing(process: &Process, window: Window, length: usize) -> Vec<usize> {
    let all = gramians(process, window, length).into_iter();
    let mut starts: Vec<usize> = all.filter(|(_, gramian)| is_singular(gramian)).map(|(modes, _)| modes[0]).collect();
    starts.sort_unstable();
    starts.dedup();
    starts
}

fn check(holds: bool, what: &str, process: &Process) -> Result<(), TestCaseError> {
    if holds { Ok(()) } else { Err(TestCaseError::fail(format!("{what}: {process:?}"))) }
}

fn check_path(process: &Process, path: &UnobservablePath<Rational>, length: usize) -> Result<(), TestCaseError> {
    let steps = length + usize::from(path.window == Window::Printed);
    check(path.modes.len() == steps, "the length of a path", process)?;
    check(windows(process, steps).contains(&path.modes), "a path of probability zero", process)?;
    let image = gramian(process, path.window, &path.modes) * &path.vector;
    check(image.is_zero() && !path.vector.is_zero(), "Gv = 0", process)?;
    check(path.is_valid_for(process), "the checker refuses a proof", process)
}

/// The loop run d times: what is not seen by then never is, by the theorem of Cayley and Hamilton.
fn check_loop(process: &Process, proof: &UnobservableLoop<Rational>) -> Result<(), TestCaseError> {
    let again = &proof.modes[proof.back_to..];
    let modes: Vec<usize> =
        proof.modes.iter().copied().chain((0..process.states()).flat_map(|_| again.iter().copied())).collect();
    let follows = modes.windows(2).all(|pair| process.transition()[(pair[0], pair[1])] > ratio(0, 1));
    check(follows, "a loop of probability zero", process)?;
    let image = gramian(process, proof.window, &modes) * proof.vector();
    check(image.is_zero() && !proof.vector().is_zero(), "a loop sees its vector", process)?;
    check(proof.is_valid_for(process), "the checker refuses a loop", process)
}

/// WG-A1, WG-6: for each mode and both windows, up to four steps: decided by subspaces, and by the determinants of all
/// Gramians; with the failing path, the smallest h, and the loop if there is none.
#[test]
fn observability_is_decided_as_by_all_determinants() -> Result<(), Box<dyn std::error::Error>> {
    let counts = [Window::Shifted, Window::Printed].map(|window| (window, Cell::new([0; LONGEST + 2])));
    let mut runner = TestRunner::new(Config { cases: 400, failure_persistence: None, ..Config::default() });
    runner.run(&draws(3, 3), |draw| {
        let process = &draw.process;
        for (window, count) in &counts {
            let failing: Vec<Vec<usize>> = (1..=LONGEST).map(|length| failing(process, *window, length)).collect();
            for (length, expected) in (1..).zip(&failing) {
                let found = process.observability(*window, length, 10_000).map_err(|error| failed(&error))?;
                let starts: Vec<usize> = found.failures.iter().map(|path| path.modes[0]).collect();
                check(starts == *expected, "the modes where A1 fails", process)?;
                check(found.holds() == expected.is_empty(), "whether A1 holds", process)?;
                found.failures.iter().try_for_each(|path| check_path(process, path, length))?;
            }
            let smallest = process.smallest_window(*window, 10_000).map_err(|error| failed(&error))?;
            for (mode, start) in &smallest.starts {
                let expected = failing.iter().position(|modes| !modes.contains(mode));
                let mut count_here = count.get();
                match start {
                    Start::Observable { length, shorter } => {
                        check(
                            expected.map_or(*length > LONGEST, |place| place + 1 == *length),
                            "the smallest h",
                            process,
                        )?;
                        check(shorter.is_some() == (*length > 1), "a shorter window fails", process)?;
                        shorter.iter().try_for_each(|path| check_path(process, path, length - 1))?;
                        count_here[(*length).min(LONGEST)] += 1;
                    }
                    Start::Never(proof) => {
                        check(expected.is_none(), "never", process)?;
                        check(proof.modes[0] == *mode, "where the loop begins", process)?;
                        check_loop(process, proof)?;
                        count_here[LONGEST + 1] += 1;
                    }
                }
                count.set(count_here);
            }
            let lengths: Option<Vec<usize>> = smallest
                .starts
                .iter()
                .map(|(_, start)| if let Start::Observable { length, .. } = start { Some(*length) } else { None })
                .collect();
            check(
                smallest.length() == lengths.and_then(|lengths| lengths.into_iter().max()),
                "the smallest h of all",
                process,
            )?;
        }
        Ok(())
    })?;
    for (window, count) in counts {
        let [_, one, two, three, more, never] = count.get();
        assert!(one > 50 && two > 20 && three + more >= 5 && never > 50, "{window:?}: {:?}", count.get());
    }
    Ok(())
}

/// WG-A1: a mode may leave one of several directions unseen, according to what follows, and each of them matters to one of the
/// modes before it.
#[test]
fn each_direction_that_may_be_unseen_is_kept() {
    let read = |h: [i64; 2]| {
        let noise = Matrix::identity(2);
        Mode::new(noise.clone(), Matrix::from_integers(&[h]), noise, Matrix::identity(1)).expect("covariances")
    };
    // Nothing, then the second entry or the first; before it the first or the second.
    let modes = [[0, 0], [0, 1], [1, 0], [1, 0], [0, 1]].map(read).to_vec();
    let follows: [&[usize]; 5] = [&[1, 2], &[3, 4], &[3, 4], &[0], &[0]];
    let share = |i: usize| ratio(1, i64::try_from(follows[i].len()).expect("small"));
    let chain = Matrix::from_fn(5, 5, |i, j| if follows[i].contains(&j) { share(i) } else { ratio(0, 1) });
    let process = Process::markov(modes, vec![ratio(1, 5); 5], chain).expect("law");
    let verdict = process.observability(Window::Shifted, 3, 1000).expect("few subspaces");
    let paths: Vec<&[usize]> = verdict.failures.iter().map(|path| path.modes.as_slice()).collect();
    assert!(paths.contains(&[3, 0, 2].as_slice()) && paths.contains(&[4, 0, 1].as_slice()), "{paths:?}");
    for (length, starts) in [(1, 5), (2, 5), (3, 5)] {
        let found = process.observability(Window::Shifted, length, 1000).expect("few subspaces");
        assert_eq!(failing(&process, Window::Shifted, length).len(), starts);
        assert_eq!(found.failures.len(), starts);
    }
}

/// WG-A1: δ is below every eigenvalue of every Gramian, and is half the smallest 1/tr G⁻¹ of all windows.
#[test]
fn the_margin_is_that_of_all_gramians() -> Result<(), Box<dyn std::error::Error>> {
    let found = Cell::new(0);
    let mut runner = TestRunner::new(Config { cases: 300, failure_persistence: None, ..Config::default() });
    runner.run(&draws(3, 2), |draw| {
        let process = &draw.process;
        for (window, length) in [(Window::Shifted, 2), (Window::Shifted, 3), (Window::Printed, 2)] {
            let all = gramians(process, window, length);
            match process.gramian_margin(window, length, 10_000) {
                Ok(margin) => {
                    let shift = Matrix::identity(process.states()).scaled(&margin);
                    let above = all
                        .iter()
                        .all(|(_, gramian)| (gramian - &shift).ldl().is_ok_and(|ldl| ldl.is_positive_definite()));
                    check(above && margin > ratio(0, 1), "δ is below all eigenvalues", process)?;
                    let halves = all.iter().map(|(_, gramian)| half_margin(gramian));
                    check(halves.min() == Some(margin), "δ", process)?;
                    found.set(found.get() + 1);
                }
                Err(MarginError::Unobservable(path)) => {
                    check(all.iter().any(|(_, gramian)| is_singular(gramian)), "a failure", process)?;
                    check_path(process, &path, length)?;
                }
                Err(error) => return Err(failed(&error)),
            }
        }
        Ok(())
    })?;
    assert!(found.get() > 100, "{}", found.get());
    Ok(())
}

/// 1/(2 tr G⁻¹) by cofactors: tr G⁻¹ is the sum of the principal minors of order d − 1 by the determinant.
fn half_margin(gramian: &Q) -> Rational {
    let d = gramian.rows();
    let minors = (0..d).map(|left_out| {
        let kept: Vec<usize> = (0..d).filter(|&i| i != left_out).collect();
        gramian.select(&kept, &kept).determinant().expect("a field decides zero")
    });
    let trace = minors.fold(ratio(0, 1), |sum, minor| sum.plus(&minor));
    gramian.determinant().expect("a field decides zero") / (trace.plus(&trace))
}

fn failed(error: &dyn std::error::Error) -> TestCaseError {
    TestCaseError::fail(error.to_string())
}
