//! How long the rest of a run of lengthening numbers takes.

use std::time::Duration;

/// Steps that are too few to tell how times grow.
const FEW: usize = 8;

/// How many times as many steps are foretold: beyond, an error of p counts too much.
const FARTHEST: usize = 4;

/// The rest that is to be expected when the first steps were done at these times and there are `all` of them; nothing while
/// there is too little to tell.
///
/// Numbers lengthen step by step, so each step takes longer than the one before it. The time of k steps is taken to be
/// proportional to kᵖ, p between 1 (all steps alike) and 4, as the last doubling of k has shown.
pub(super) fn rest(done_at: &[Duration], all: usize) -> Option<Duration> {
    let done = done_at.len();
    if done < FEW || all < done || all > done.saturating_mul(FARTHEST) {
        return None;
    }
    let half = done_at.get(done / 2 - 1)?.as_secs_f64();
    let now = done_at.last()?.as_secs_f64();
    let count = |steps: usize| u32::try_from(steps).map(f64::from).ok();
    let doubled = count(done)? / count(done / 2)?;
    let power = ((now / half).ln() / doubled.ln()).clamp(1.0, 4.0);
    Duration::try_from_secs_f64(now * ((count(all)? / count(done)?).powf(power) - 1.0)).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Times that grow as a power are told within a thousandth; a p of 2.6 is that of products of long numbers.
    #[test]
    fn powers_are_found() {
        for power in [1.0, 2.0, 2.6, 3.5] {
            let at = |step: u32| Duration::from_secs_f64(f64::from(step).powf(power) / 1000.0);
            for done in [8, 9, 31, 100] {
                let all = 4 * done;
                let times: Vec<_> = (1..=done).map(at).collect();
                let told = rest(&times, usize::try_from(all).expect("few steps")).expect("enough steps");
                let right = at(all).saturating_sub(at(done));
                let error = (told.as_secs_f64() / right.as_secs_f64() - 1.0).abs();
                assert!(error < 1e-3, "{done} steps, power {power}: {told:?} for {right:?}");
            }
        }
    }

    #[test]
    fn too_little_tells_nothing() {
        let times: Vec<_> = (1..8).map(Duration::from_secs).collect();
        assert_eq!(rest(&times, 10), None);
        // A first half too short for the clock.
        let none = [Duration::ZERO; 8];
        assert!(rest(&none, 10).is_none_or(|rest| rest.is_zero()));
        let last: Vec<_> = (1..=8).map(Duration::from_secs).collect();
        assert_eq!(rest(&last, 8), Some(Duration::ZERO));
        assert!(rest(&last, 32).is_some() && rest(&last, 33).is_none(), "too far ahead");
    }
}
