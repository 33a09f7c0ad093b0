//! A case in doubles, for filters that are written for these tests.

use exact_kalman::matrix::Matrix;
use exact_kalman::model::{Before, Timing};
use exact_kalman::protocol::Case;
use exact_kalman::scalar::{Rational, nearest_double};
use nalgebra::DMatrix;

pub(crate) type M = DMatrix<f64>;

/// A transition: A, Bu, Q, and the covariance of its noise with that of the reading of the same index.
#[derive(Clone)]
pub(crate) struct Motion {
    pub(crate) a: M,
    pub(crate) u: M,
    pub(crate) q: M,
    pub(crate) cross: M,
}

#[derive(Clone)]
pub(crate) struct Sight {
    pub(crate) c: M,
    pub(crate) g: M,
    pub(crate) r: M,
    pub(crate) y: Vec<Option<f64>>,
}

#[derive(Clone)]
pub(crate) struct Model {
    pub(crate) arriving: bool,
    pub(crate) before_transition: bool,
    pub(crate) x: M,
    pub(crate) p: M,
    pub(crate) diffuse: Option<M>,
    pub(crate) motions: Vec<Option<Motion>>,
    pub(crate) sights: Vec<Sight>,
}

fn doubles(matrix: &Matrix<Rational>) -> M {
    M::from_fn(matrix.rows(), matrix.columns(), |i, j| nearest_double(&matrix[(i, j)]))
}

impl Model {
    pub(crate) fn of(case: &Case) -> Self {
        let path = case.problem().expect("a valid case").realised().expect("a valid problem");
        let initial = path.initial();
        let motion = |step: &exact_kalman::model::Step<Rational>| {
            step.transition.as_ref().map(|t| Motion {
                a: doubles(&t.matrix),
                u: doubles(&t.input),
                q: doubles(&t.noise),
                cross: doubles(&t.cross_noise),
            })
        };
        let sight = |step: &exact_kalman::model::Step<Rational>| Sight {
            c: doubles(&step.observation),
            g: doubles(&step.observation_input),
            r: doubles(&step.observation_noise),
            y: step.reading.entries().iter().map(|y| y.as_ref().map(nearest_double)).collect(),
        };
        Self {
            arriving: path.timing() == Timing::Arriving,
            before_transition: initial.before == Before::Transition,
            x: doubles(&initial.mean),
            p: doubles(&initial.covariance),
            diffuse: initial.diffuse.as_ref().map(doubles),
            motions: path.steps().iter().map(motion).collect(),
            sights: path.steps().iter().map(sight).collect(),
        }
    }

    pub(crate) fn shares_noise(&self) -> bool {
        self.motions.iter().flatten().any(|motion| motion.cross.iter().any(|entry| *entry != 0.0))
    }

    pub(crate) fn states(&self) -> usize {
        self.x.nrows()
    }
}
