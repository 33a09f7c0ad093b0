//! What a flag of a case exercises, and what failing it means.

const MEANINGS: [(&str, &str); 15] = [
    ("basic", "an ordinary model: a failure here is a mistake of the adapter or of a convention, not of arithmetic"),
    ("input", "a known input is added to the state or to the observation; a failure drops or shifts it"),
    ("missing", "readings are missing: a failure uses them, stops, or keeps a gain that was meant for other sensors"),
    ("time-varying", "matrices differ from step to step: a failure freezes them or shifts their index"),
    ("adapted", "matrices depend on past readings, as in identification and adaptive control"),
    ("correlated", "process and observation noise are correlated: a failure drops or mistimes the cross term"),
    ("arriving", "the noise of y_k is shared with the transition that leads into k, not out of it"),
    ("before-transition", "the initial law comes before a transition: a failure starts one step early or late"),
    ("diffuse", "nothing is known of (part of) the first state: a failure puts a large number where a limit is meant"),
    ("unstable", "a mode grows: a failure lets rounding errors grow with it"),
    ("units", "very small or large units: a failure compares with an absolute tolerance somewhere"),
    ("ill-conditioned", "digits are lost by the form of the recursion: a square-root form keeps them"),
    ("singular", "the innovation covariance is singular: a failure inverts it or adds something to its diagonal"),
    ("contradiction", "the data have probability zero under the model, and a good program says so"),
    ("bad-input", "no valid problem: a good program refuses it"),
];

/// What a flag of a case exercises, and what failing it means.
pub fn meaning(flag: &str) -> Option<&'static str> {
    if flag == "real-data" {
        return Some("observations of the world, with published variances");
    }
    MEANINGS.iter().find(|(name, _)| *name == flag).map(|(_, meaning)| *meaning)
}
