//! The laws of the next states, enclosed: steps at which nothing is read.

use super::enclosed::Enclosed;
use super::groups::Groups;
use super::law::Law;
use super::target::{moved, prior};
use crate::model::{PathAhead, Timing, Transition};
use crate::scalar::{Interval, Rational};
use crate::trace::Moments;

/// Predictions along a path.
#[derive(Debug)]
pub(super) struct Ahead<'a> {
    path: &'a PathAhead<Rational>,
    /// The law of the last transition, which the next one may share.
    law: Option<(&'a Transition<Rational>, Law)>,
}

impl<'a> Ahead<'a> {
    pub(super) fn new(path: &'a PathAhead<Rational>) -> Self {
        Self { path, law: None }
    }

    /// The laws of x_next, x_{next+1}, … as far as there are transitions, from the state given the reading before it, and from
    /// the next one if that is known already.
    pub(super) fn laws(
        &mut self,
        next: usize,
        filtered: &Enclosed,
        departed: Option<&Enclosed>,
        groups: &Groups,
        bits: u64,
    ) -> Vec<Moments<Interval>> {
        let steps = self.path.steps_ahead().get();
        let mut laws: Vec<Moments<Interval>> = departed.iter().map(|belief| moments(belief, groups, bits)).collect();
        let mut groups = groups.clone();
        let mut last = match (departed, self.path.path().timing()) {
            (Some(belief), _) => belief.clone(),
            (None, Timing::Arriving) => filtered.clone(),
            (None, Timing::Departing) => return laws,
        };
        while laws.len() < steps
            && let Some(transition) = self.path.transition_into(next + laws.len())
        {
            last = self.after(transition, &last, bits);
            groups = groups.moved(transition);
            laws.push(moments(&last, &groups, bits));
        }
        laws
    }

    fn after(&mut self, transition: &'a Transition<Rational>, belief: &Enclosed, bits: u64) -> Enclosed {
        let law = match self.law.take() {
            Some((last, law)) if last.matrix == transition.matrix && last.noise == transition.noise => law,
            _ => Law::of_transition(transition),
        };
        let law = &self.law.insert((transition, law)).1;
        let exact = prior(belief, law, &law.filtered);
        moved(belief, law, &law.input(transition), (&law.filtered, &exact), bits)
    }
}

fn moments(belief: &Enclosed, groups: &Groups, bits: u64) -> Moments<Interval> {
    let mut covariance = belief.covariance_intervals(bits);
    groups.apart(&mut covariance);
    Moments { mean: belief.mean_intervals(bits), covariance, diffuse: None }
}
