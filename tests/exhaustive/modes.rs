//! Every pair of modes with F in {0, 1}²ˣ² and H in {0, 1}¹ˣ²: which window sees everything.

use exact_kalman::matrix::Matrix;
use exact_kalman::scalar::{Rational, ratio};
use exact_kalman::stability::{Mode, ModeProcess, Start, Window};

use crate::worlds::matrices;

const LONGEST: usize = 6;

type Transition = [[i64; 2]; 2];
type Observation = [i64; 2];

fn entry(value: &Rational) -> i64 {
    i64::from(*value == ratio(1, 1))
}

fn modes() -> Vec<(Mode<Rational>, Transition, Observation)> {
    let bits = [ratio(0, 1), ratio(1, 1)];
    let transitions = matrices(2, 2, &bits);
    let all = transitions.flat_map(|f| matrices(1, 2, &bits).map(move |h| (f.clone(), h)));
    all.map(|(f, h)| {
        let plain = [[entry(&f[(0, 0)]), entry(&f[(0, 1)])], [entry(&f[(1, 0)]), entry(&f[(1, 1)])]];
        let row = [entry(&h[(0, 0)]), entry(&h[(0, 1)])];
        (Mode::new(f, h, Matrix::identity(2), Matrix::identity(1)).expect("covariances"), plain, row)
    })
    .collect()
}

/// The smallest h up to [`LONGEST`] such that no path of h modes from one of `begins` has a Gramian with determinant zero.
/// `pair` holds the modes, and `follows[i]` those that may follow mode i.
fn smallest(pair: [(Transition, Observation); 2], begins: &[usize], follows: &[Vec<usize>; 2]) -> Option<usize> {
    (1..=LONGEST).find(|&length| begins.iter().all(|&mode| sees(pair, follows, mode, length, [[1, 0], [0, 1]], [0; 3])))
}

/// Whether all paths see everything that begin with `mode` and have `left` modes more than are in `transition` and `gramian`
/// (the entries 11, 12 and 22).
fn sees(
    pair: [(Transition, Observation); 2],
    follows: &[Vec<usize>; 2],
    mode: usize,
    left: usize,
    transition: Transition,
    gramian: [i64; 3],
) -> bool {
    let (f, h) = pair[mode];
    let row = [0, 1].map(|j| h[0] * transition[0][j] + h[1] * transition[1][j]);
    let gramian = [gramian[0] + row[0] * row[0], gramian[1] + row[0] * row[1], gramian[2] + row[1] * row[1]];
    if left == 1 {
        return gramian[0] * gramian[2] != gramian[1] * gramian[1];
    }
    let next = [0, 1].map(|i| [0, 1].map(|j| f[i][0] * transition[0][j] + f[i][1] * transition[1][j]));
    follows[mode].iter().all(|&mode| sees(pair, follows, mode, left - 1, next, gramian))
}

/// WG-A1: the smallest h is that of all determinants; where none is found up to six steps there is none. What proves it holds.
///
/// Domain: all pairs of modes with F 2×2 and H 1×2 over {0, 1}, free to follow each other, alternating, or one of them lasting.
#[test]
fn smallest_windows_of_pairs_of_modes() {
    let half = || ratio(1, 2);
    let one = || ratio(1, 1);
    let chains = [
        (vec![half(), half()], [[half(), half()], [half(), half()]], vec![0, 1], [vec![0, 1], vec![0, 1]]),
        (vec![one(), ratio(0, 1)], [[ratio(0, 1), one()], [one(), ratio(0, 1)]], vec![0, 1], [vec![1], vec![0]]),
        (vec![one(), ratio(0, 1)], [[half(), half()], [ratio(0, 1), one()]], vec![0, 1], [vec![0, 1], vec![1]]),
    ];
    let mut counts = [[0; LONGEST + 1]; 3];
    let all = modes();
    for (one, first, h_first) in &all {
        for (other, second, h_second) in &all {
            for ((initial, rows, begins, follows), count) in chains.iter().zip(&mut counts) {
                let transition = Matrix::from_fn(2, 2, |i, j| rows[i][j].clone());
                let process = ModeProcess::markov(vec![one.clone(), other.clone()], initial.clone(), transition)
                    .expect("probabilities");
                let windows = process.smallest_window(Window::Shifted, 1000).expect("few subspaces");
                let found = windows.length();
                let proved = windows.starts.iter().all(|(_, start)| match start {
                    Start::Observable { length, shorter } => {
                        // A path of one mode less, if that is any.
                        shorter.as_ref().map_or(0, |path| path.modes.len()) == length - 1
                            && shorter.as_ref().is_none_or(|path| path.is_valid_for(&process))
                    }
                    Start::Never(path) => path.is_valid_for(&process),
                });
                assert!(proved, "{windows:?}");
                let expected = smallest([(*first, *h_first), (*second, *h_second)], begins, follows);
                assert_eq!(found, expected, "{process:?}");
                count[found.unwrap_or(0)] += 1;
            }
        }
    }
    assert!(
        counts.iter().all(|count| count.iter().sum::<usize>() == 4096 && count[2] > 0 && count[0] > 0),
        "{counts:?}"
    );
}
