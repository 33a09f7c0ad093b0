//! A textbook filter in doubles that can make each known mistake, and some that are not known. It shares nothing with
//! the catalogue but the names.

use super::model::{M, Model, Motion, Sight};

/// What the filter says of a step.
#[derive(Clone)]
pub(crate) struct Said {
    pub(crate) predicted: (M, M),
    pub(crate) filtered: (M, M),
    pub(crate) innovation: Option<(M, M)>,
}

/// A filter with its habit, and the size or the way of it.
pub(crate) struct Filter<'a> {
    pub(crate) habit: &'a str,
    pub(crate) way: f64,
}

struct State {
    x: M,
    p: M,
    last: Option<M>,
    gain: Option<M>,
    rests: bool,
}

impl Filter<'_> {
    pub(crate) fn is(&self, habit: &str) -> bool {
        self.habit == habit
    }

    fn goes(&self, way: f64) -> bool {
        self.way.total_cmp(&way).is_eq()
    }

    /// Another index where the habit says so: the step before (way 0) or the next (way 1) that `has` one.
    fn index(&self, habit: &str, frozen: &str, k: usize, has: impl Fn(usize) -> bool, count: usize) -> usize {
        let first = (0..count).find(|&i| has(i)).unwrap_or(k);
        let last = (0..count).rfind(|&i| has(i)).unwrap_or(k);
        if self.is(habit) {
            let other = if self.goes(0.0) { k.saturating_sub(1).max(first) } else { (k + 1).min(last) };
            if has(other) { other } else { k }
        } else if self.is(frozen) {
            if self.goes(0.0) { first } else { last }
        } else {
            k
        }
    }

    fn motion(&self, model: &Model, k: usize) -> Option<Motion> {
        let has = |i: usize| model.motions[i].is_some();
        let own = model.motions[k].clone()?;
        let count = model.motions.len();
        let of = |habit: &str, frozen: &str| {
            model.motions[self.index(habit, frozen, k, has, count)].clone().expect("a motion of this index")
        };
        let mut motion = Motion {
            a: of("transition-of-another-step", "transition-frozen").a,
            u: of("input-of-another-step", "input-frozen").u,
            q: of("process-noise-of-another-step", "process-noise-frozen").q,
            cross: own.cross,
        };
        let n = model.states();
        match self.habit {
            "transition-transposed" => motion.a = motion.a.transpose(),
            "input-dropped" => motion.u.fill(0.0),
            "input-of-the-other-sign" => motion.u = -motion.u,
            "process-noise-dropped" => motion.q.fill(0.0),
            "process-noise-twice" => motion.q *= 2.0,
            "process-noise-in-other-units" => motion.q = self.in_other_units(&motion.q),
            "process-noise-diagonal" => motion.q = M::from_diagonal(&motion.q.diagonal()),
            "process-noise-raised" => motion.q += M::identity(n, n) * self.way,
            "noises-exchanged" if model.sights[k].r.nrows() == n => motion.q = model.sights[k].r.clone(),
            "cross-covariance-dropped" => motion.cross.fill(0.0),
            "cross-covariance-of-the-other-sign" => motion.cross = -motion.cross,
            _ => {}
        }
        Some(motion)
    }

    fn in_other_units(&self, matrix: &M) -> M {
        matrix.map(|entry| if self.goes(0.0) { entry * entry } else { entry.abs().sqrt().copysign(entry) })
    }

    fn sight(&self, model: &Model, k: usize, last: &mut [Option<f64>]) -> Sight {
        let count = model.sights.len();
        let of = |habit: &str, frozen: &str| &model.sights[self.index(habit, frozen, k, |_| true, count)];
        let mut sight = Sight {
            c: of("observation-matrix-of-another-step", "observation-matrix-frozen").c.clone(),
            r: of("observation-noise-of-another-step", "observation-noise-frozen").r.clone(),
            ..model.sights[k].clone()
        };
        let m = sight.y.len();
        match self.habit {
            "observation-matrix-transposed" if sight.c.is_square() => sight.c = sight.c.transpose(),
            "observation-input-dropped" => sight.g.fill(0.0),
            "observation-input-of-the-other-sign" => sight.g = -sight.g,
            "observation-noise-dropped" => sight.r.fill(0.0),
            "observation-noise-in-other-units" => sight.r = self.in_other_units(&sight.r),
            "observation-noise-diagonal" => sight.r = M::from_diagonal(&sight.r.diagonal()),
            "innovation-covariance-raised" => sight.r += M::identity(m, m) * self.way,
            "noises-exchanged" if m == model.states() => {
                if let Some(motion) = &model.motions[k] {
                    sight.r = motion.q.clone();
                }
            }
            "missing-as-zero" => sight.y.iter_mut().for_each(|y| *y = y.or(Some(0.0))),
            "missing-as-last-reading" => sight.y.iter_mut().zip(&*last).for_each(|(y, last)| *y = y.or(*last)),
            "missing-entry-drops-the-reading" if sight.y.contains(&None) => sight.y.fill(None),
            _ => {}
        }
        last.copy_from_slice(&sight.y);
        sight
    }

    /// Means and covariances before and after each reading.
    pub(crate) fn run(&self, model: &Model) -> Vec<Said> {
        let n = model.states();
        let mut state = State { x: model.x.clone(), p: model.p.clone(), last: None, gain: None, rests: false };
        match self.habit {
            "initial-mean-zero" => state.x.fill(0.0),
            "initial-covariance-identity" => state.p = M::identity(n, n),
            "initial-covariance-zero" => state.p.fill(0.0),
            "initial-covariance-diagonal" => state.p = M::from_diagonal(&state.p.diagonal()),
            "initial-covariance-in-other-units" => state.p = self.in_other_units(&state.p),
            "large-number-for-diffuse" => {
                if let Some(diffuse) = &model.diffuse {
                    state.p += diffuse * self.way;
                }
            }
            _ => {}
        }
        let count = model.sights.len();
        let mut last = vec![None; model.sights[0].y.len()];
        let mut said = Vec::new();
        for k in 0..count {
            if self.moves_before(model, k)
                && let Some(motion) = self.motion_before(model, k)
            {
                self.predict(&mut state, &motion);
            }
            let sight = self.sight(model, k, &mut last);
            let shared = self.shared_before(model, k);
            let (step, gain, inverse) = self.update(&mut state, &sight, shared, model, k);
            let before = step.predicted.clone();
            if self.moves_after(model)
                && let Some(motion) = self.motion_after(model, k)
            {
                self.depart(&mut state, &motion, &step, &gain, &inverse, &sight);
                if self.is("no-prediction-in-gaps") && sight.y.iter().all(Option::is_none) {
                    (state.x, state.p) = step.filtered.clone();
                }
            }
            self.rest(&mut state, &before.1);
            state.last = Some(step.filtered.0.clone());
            said.push(step);
        }
        said
    }

    fn swaps_timing(&self) -> bool {
        self.is("transitions-of-the-other-timing") || self.is("cross-covariance-of-the-other-timing")
    }

    fn moves_after(&self, model: &Model) -> bool {
        model.arriving == self.swaps_timing() && !(self.is("initial-law-before-a-transition") && self.goes(2.0))
    }

    fn moves_before(&self, model: &Model, k: usize) -> bool {
        if self.is("initial-law-before-a-transition") {
            return k == 0 || model.arriving || self.goes(2.0);
        }
        if self.is("cross-covariance-of-the-other-timing") && k == 0 {
            return model.before_transition;
        }
        if self.is("initial-law-after-the-transition") && k == 0 {
            return false;
        }
        !self.moves_after(model) && (k > 0 || model.before_transition && !self.swaps_timing())
    }

    /// The motion that is made before reading k.
    fn motion_before(&self, model: &Model, k: usize) -> Option<Motion> {
        let count = model.motions.len();
        if self.is("initial-law-before-a-transition") && (k == 0 || self.goes(2.0)) {
            let known = |i: usize| model.motions[i].is_some();
            let own = if known(k) {
                k
            } else if k == 0 {
                (0..count).find(|&i| known(i))?
            } else {
                (0..count).rfind(|&i| known(i))?
            };
            let mut motion = self.motion(model, own)?;
            if self.goes(1.0) && k == 0 {
                motion.u.fill(0.0);
            }
            return Some(motion);
        }
        if self.is("cross-covariance-of-the-other-timing") && !model.arriving {
            return self.motion(model, k.checked_sub(1)?);
        }
        if self.is("transitions-of-the-other-timing") && model.motions[k].is_none() {
            return self.motion(model, (0..count).rfind(|&i| model.motions[i].is_some())?);
        }
        if self.is("no-prediction-in-gaps") && model.arriving && k > 0 && model.sights[k].y.iter().all(Option::is_none)
        {
            return None;
        }
        self.motion(model, k)
    }

    fn motion_after(&self, model: &Model, k: usize) -> Option<Motion> {
        let count = model.motions.len();
        if self.is("cross-covariance-of-the-other-timing") {
            return if k + 1 < count { self.motion(model, k + 1) } else { None };
        }
        if self.is("transitions-of-the-other-timing") && model.motions[k].is_none() && k + 1 < count {
            return self.motion(model, (0..count).find(|&i| model.motions[i].is_some())?);
        }
        self.motion(model, k)
    }

    /// The covariance of the noise of reading k with that of the transition made before it.
    fn shared_before(&self, model: &Model, k: usize) -> Option<M> {
        if self.moves_after(model) || !self.moves_before(model, k) {
            return None;
        }
        self.motion_before(model, k).map(|motion| motion.cross)
    }

    fn predict(&self, state: &mut State, motion: &Motion) {
        let Motion { a, u, q, .. } = motion;
        state.x = if self.is("mean-not-moved") { state.x.clone() } else { a * &state.x } + u;
        let p = &state.p;
        state.p = match self.habit {
            "covariance-not-moved" => p + q,
            "transition-without-transpose" => a * p * a + q,
            "transition-on-one-side" => a * p + q,
            "process-noise-through-the-transition" => a * (p + q) * a.transpose(),
            _ => a * p * a.transpose() + q,
        };
    }

    /// The prediction after a reading, with which the noise is shared.
    fn depart(&self, state: &mut State, motion: &Motion, step: &Said, gain: &M, inverse: &M, sight: &Sight) {
        self.predict(state, motion);
        let rows: Vec<usize> = (0..sight.y.len()).filter(|&i| sight.y[i].is_some()).collect();
        let Some((innovation, _)) = &step.innovation else { return };
        let cross = motion.cross.select_columns(&rows);
        let ahead = &motion.a * gain * cross.transpose();
        state.x += &cross * inverse * innovation;
        state.p -= &ahead + ahead.transpose() + &cross * inverse * cross.transpose();
        if self.is("filter-gain-in-the-predictor") {
            state.x = &motion.a * &step.predicted.0 + &motion.u + gain * innovation;
        }
    }

    fn update(&self, state: &mut State, sight: &Sight, shared: Option<M>, model: &Model, k: usize) -> (Said, M, M) {
        let rows: Vec<usize> = (0..sight.y.len()).filter(|&i| sight.y[i].is_some()).collect();
        let n = state.x.nrows();
        let predicted = (state.x.clone(), state.p.clone());
        if rows.is_empty() {
            if self.is("filtered-covariance-raised") {
                state.p += M::identity(n, n) * self.way;
            }
            let filtered = (state.x.clone(), state.p.clone());
            return (Said { predicted, filtered, innovation: None }, M::zeros(n, 0), M::zeros(0, 0));
        }
        let (c, g) = (sight.c.select_rows(&rows), sight.g.select_rows(&rows));
        let r = sight.r.select_rows(&rows).select_columns(&rows);
        let y = M::from_iterator(rows.len(), 1, rows.iter().filter_map(|&i| sight.y[i]));
        let shared = shared.map_or_else(|| M::zeros(n, rows.len()), |shared| shared.select_columns(&rows));
        let cross = &state.p * c.transpose() + &shared;
        let mixed = &c * &shared;
        let s = &c * &state.p * c.transpose() + &r + &mixed + mixed.transpose();
        let seen_from = match &state.last {
            Some(last) if self.is("innovation-of-the-state-before") => last,
            _ => &state.x,
        };
        let innovation = y - &c * seen_from - g;
        let inverse = inverted(&s);
        let mut gain = match self.habit {
            "gain-without-noise" => &cross * inverted(&(&s - &r)),
            "gain-of-the-diagonal" => {
                &cross * M::from_diagonal(&s.diagonal().map(|v| if v == 0.0 { 0.0 } else { 1.0 / v }))
            }
            "small-variances-ignored" if s.diagonal().iter().all(|v| *v < self.way) => &cross * 0.0,
            "gain-times-nine-tenths" => &cross * &inverse * 0.9,
            _ => &cross * &inverse,
        };
        if self.is("gain-of-the-first-step") {
            match &state.gain {
                Some(first) if first.ncols() == gain.ncols() => gain = first.clone(),
                Some(_) => {}
                None => state.gain = Some(gain.clone()),
            }
        }
        let left = M::identity(n, n) - &gain * &c;
        let p = &state.p;
        let ahead = model.motions[k].as_ref().map_or_else(|| gain.clone(), |motion| &motion.a * &gain);
        let filtered_p = match self.habit {
            "covariance-not-updated" => p.clone(),
            "joseph-without-noise" => &left * p * left.transpose(),
            "joseph-with-unit-noise" => &left * p * left.transpose() + &gain * gain.transpose(),
            "covariance-update-adds" => p + &gain * &s * gain.transpose(),
            "predictor-gain-for-filtered" if self.goes(1.0) => (M::identity(n, n) - &ahead * &c) * p,
            "filtered-covariance-raised" => p - &gain * cross.transpose() + M::identity(n, n) * self.way,
            "fading-memory" => (p - &gain * cross.transpose()) * 1.01,
            _ => p - &gain * cross.transpose(),
        };
        let multiplied = &cross * &s;
        let used = match self.habit {
            "predictor-gain-for-filtered" => &ahead,
            "gain-without-inverse" => &multiplied,
            _ => &gain,
        };
        let x = if self.is("mean-not-updated") { state.x.clone() } else { &state.x + used * &innovation };
        let s_given = if self.is("innovation-covariance-without-noise") { &s - &r } else { s };
        (state.x, state.p) = (x, filtered_p);
        let filtered = (state.x.clone(), state.p.clone());
        (Said { predicted, filtered, innovation: Some((innovation, s_given)) }, gain, inverse)
    }

    fn rest(&self, state: &mut State, before: &M) {
        if self.is("covariance-rests-too-early") {
            state.rests |= (&state.p - before).amax() < self.way;
            if state.rests {
                state.p = before.clone();
            }
        }
    }
}

fn inverted(s: &M) -> M {
    match s.clone().try_inverse() {
        Some(inverse)
            if s.nrows() == 1 || s.determinant().abs() > 1e-14 * s.diagonal().iter().product::<f64>().abs() =>
        {
            inverse
        }
        _ => {
            s.clone().pseudo_inverse(1e-12 * s.amax().max(f64::MIN_POSITIVE)).expect("a tolerance that is not negative")
        }
    }
}
