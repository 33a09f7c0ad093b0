//! Conventions of start and timing.

use super::super::problem::{Cross, Start, cross_noise, other_timing, started};
use super::{Entry, Kind, Ways, entry};

pub(super) fn entries() -> Vec<Entry> {
    vec![
        entry(
            "initial-law-before-a-transition",
            Kind::Reading,
            [
                "you read the initial law as that of the state before a first transition; it is that of the state which y_0 sees",
                "A loop that predicts before each update, the first one included.",
                "The first variance has one step of process noise too much; wrong until that is forgotten.",
                "Skip the prediction before the first reading.",
            ],
            Ways::named([
                ("the first transition twice", started(Start::Moved { with_input: true })),
                ("without its input", started(Start::Moved { with_input: false })),
                ("transition k into k", started(Start::MovedByEachStep)),
            ]),
        ),
        entry(
            "initial-law-after-the-transition",
            Kind::Reading,
            [
                "you read the initial law as that of the state which y_0 sees; it is that of the state one transition before",
                "A loop that begins with an update, whatever the case says.",
                "The first variance lacks one step of process noise.",
                "Where the case says that the initial law comes before a transition, predict first.",
            ],
            Ways::one(started(Start::NotMoved)),
        ),
        entry(
            "transitions-of-the-other-timing",
            Kind::Reading,
            [
                "you read transition k as leading into the other of its two neighbours: into k for out of k, or out of k for into k",
                "Both conventions are common, and agree where nothing varies.",
                "Every matrix and input of the state acts one step early or late.",
                "Follow the field `timing` of the case.",
            ],
            Ways::one(other_timing()),
        ),
        entry(
            "cross-covariance-of-the-other-timing",
            Kind::Reading,
            [
                "you take the noise of a transition as correlated with the reading at its other end",
                "cov(w_k, v_k) and cov(w_{k−1}, v_k) are both called the cross covariance; formulas for the one are used with the other.",
                "Another model: the estimate may be worse than without the term, and claim to be better.",
                "Follow the field `timing` of the case: departing is cov(w_k, v_k) of the transition out of k.",
            ],
            Ways::one(cross_noise(Cross::OtherEnd)),
        ),
        entry(
            "cross-covariance-dropped",
            Kind::Mistake,
            [
                "you leave out the correlation between process and observation noise",
                "The gain is computed as if they were independent.",
                "Information in the readings is not used, or used twice; the stated covariance is wrong either way.",
                "Use the gain with the cross term, or say that such models are unsupported.",
            ],
            Ways::one(cross_noise(Cross::Dropped)),
        ),
        entry(
            "cross-covariance-of-the-other-sign",
            Kind::Mistake,
            [
                "you take the correlation between process and observation noise with the other sign",
                "The term is subtracted where it should be added, or the innovation has the other sign.",
                "Worse than leaving it out.",
                "Check the sign against a scalar example worked by hand.",
            ],
            Ways::one(cross_noise(Cross::OtherSign)),
        ),
    ]
}
