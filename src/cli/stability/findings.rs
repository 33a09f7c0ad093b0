//! What is found of a model.

use super::Model;
use crate::cli::exit::Exit;
use crate::matrix::Matrix;
use crate::scalar::{Rational, ratio};
use crate::stability::{
    CovarianceLaw, CriticalArrival, LargestMoment, ModeProcess, MomentVerdict, Start, TooManySubspaces, UniformBound,
    UnobservableLoop, UnobservablePath, Window,
};

/// How far is looked.
#[derive(Clone, Copy)]
pub(super) struct Limits {
    pub(super) steps: u32,
    pub(super) moments: u32,
    pub(super) most: usize,
}

/// Everything that is printed.
pub(super) struct Findings {
    pub(super) observability: Observed,
    pub(super) bound: Option<Result<UniformBound<Rational>, String>>,
    pub(super) moments: Vec<(usize, Moment)>,
    pub(super) arrivals: Option<Arrivals>,
    pub(super) curve: Vec<Point>,
    pub(super) stopped: Option<String>,
}

/// Whether A1 holds.
pub(super) enum Observed {
    /// With windows of this length; all their Gramians are above the margin times I; a path that is one shorter and fails.
    Within {
        length: usize,
        margin: Option<Rational>,
        shorter: Option<UnobservablePath<Rational>>,
    },
    /// With none.
    Never(UnobservableLoop<Rational>),
    Undecided(TooManySubspaces),
}

/// Whether a moment stays bounded.
pub(super) enum Moment {
    /// P(k) itself does, on every path.
    OnEveryPath,
    Decided(MomentVerdict),
}

/// Readings that arrive or not.
pub(super) struct Arrivals {
    /// The probability that one arrives.
    pub(super) probability: Rational,
    /// The probability above which the mean stays bounded.
    pub(super) critical: Critical,
    /// Up to which order moments do, between two decimals.
    pub(super) largest_moment: Option<(Rational, Rational)>,
}

/// The critical probability.
pub(super) enum Critical {
    Exact(Rational),
    Between(Box<CriticalArrival>),
    /// There are too many states to look for it.
    NotSought,
}

/// With more states each certificate of the critical probability takes seconds, and a bisection many of them.
const MOST_STATES: usize = 4;

/// P(k) over all paths.
pub(super) struct Point {
    pub(super) time: usize,
    pub(super) mean: Matrix<Rational>,
    pub(super) worst: Matrix<Rational>,
    pub(super) path: Vec<usize>,
    pub(super) values: usize,
}

impl Findings {
    pub(super) fn of(model: &Model, limits: Limits) -> Self {
        let process = &model.process;
        let observability = observed(process, limits.most);
        let bound = match &observability {
            Observed::Within { length, .. } => {
                Some(process.uniform_bound(*length, limits.most).map_err(|error| error.to_string()))
            }
            _ => None,
        };
        let moment = |order: u32| {
            let order = order as usize;
            match observability {
                Observed::Within { .. } => (order, Moment::OnEveryPath),
                _ => (order, Moment::Decided(process.moment(order, &model.start))),
            }
        };
        let moments = (1..=limits.moments).map(moment).collect();
        let (curve, stopped) = curve(model, limits);
        Self { observability, bound, moments, arrivals: arrivals(process), curve, stopped }
    }

    /// By the first moment.
    pub(super) fn exit(&self) -> Exit {
        match self.moments.first() {
            Some((_, Moment::OnEveryPath | Moment::Decided(MomentVerdict::Bounded(_)))) => Exit::Clean,
            Some((_, Moment::Decided(MomentVerdict::Unbounded(_)))) => Exit::Findings,
            _ => Exit::Undecided,
        }
    }
}

fn observed(process: &ModeProcess<Rational>, most: usize) -> Observed {
    let smallest = match process.smallest_window(Window::Shifted, most) {
        Ok(smallest) => smallest,
        Err(error) => return Observed::Undecided(error),
    };
    let mut longest = (0, None);
    for (_, start) in smallest.starts {
        match start {
            Start::Never(certificate) => return Observed::Never(certificate),
            Start::Observable { length, shorter } if length > longest.0 => longest = (length, shorter),
            Start::Observable { .. } => {}
        }
    }
    let (length, shorter) = longest;
    let margin = process.gramian_margin(Window::Shifted, length, most).ok();
    Observed::Within { length, margin, shorter }
}

/// If one of two independent modes is the other without its readings.
fn arrivals(process: &ModeProcess<Rational>) -> Option<Arrivals> {
    let [one, other] = process.modes() else { return None };
    let seen = usize::from(one.observation().is_zero());
    let (mode, probability) = (&process.modes()[seen], process.initial()[seen].clone());
    let same = ModeProcess::intermittent(mode, &probability)?;
    let [lost, received] = same.modes() else { return None };
    let ordered = if seen == 1 { [lost, received] } else { [received, lost] };
    if ordered != [one, other] || (0..2).any(|from| process.transition().row(from) != process.initial()) {
        return None;
    }
    let critical = match mode.scalar_critical_arrival() {
        Some(exact) => Critical::Exact(exact),
        None if mode.states() > MOST_STATES => Critical::NotSought,
        None => Critical::Between(Box::new(mode.critical_arrival(&ratio(1, 1000))?)),
    };
    let loss = ratio(1, 1) - &probability;
    let moment = || LargestMoment::new(&loss, &mode.transition()[(0, 0)])?.decimals(4);
    let largest_moment = if mode.states() == 1 { moment() } else { None };
    Some(Arrivals { probability, critical, largest_moment })
}

fn curve(model: &Model, limits: Limits) -> (Vec<Point>, Option<String>) {
    let d = model.process.states();
    let most = (limits.most / d.saturating_pow(3).max(1)).max(1);
    let mut points = Vec::new();
    let mut law = match CovarianceLaw::start(&model.process, model.start.clone(), most) {
        Ok(law) => law,
        Err(error) => return (points, Some(error.to_string())),
    };
    for _ in 0..limits.steps {
        if let Err(error) = law.advance() {
            return (points, Some(error.to_string()));
        }
        let worst = law.worst();
        points.push(Point {
            time: law.time(),
            mean: law.mean(),
            worst: worst.covariance.clone(),
            path: worst.path.clone(),
            values: law.states().len(),
        });
    }
    (points, None)
}
