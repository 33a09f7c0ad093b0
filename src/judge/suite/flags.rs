//! What a flag of a case exercises, what failing it means, and for whom that matters.

/// A flag that cases carry.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Flag {
    /// Its name.
    pub name: &'static str,
    /// What its cases exercise.
    pub exercises: &'static str,
    /// What failing them means.
    pub failing: &'static str,
    /// For whom it matters.
    pub concerns: &'static str,
}

const fn flagged(name: &'static str, exercises: &'static str, failing: &'static str, concerns: &'static str) -> Flag {
    Flag { name, exercises, failing, concerns }
}

const FLAGS: [Flag; 22] = [
    flagged(
        "basic",
        "an ordinary model",
        "a failure here is a mistake of the adapter or of a convention, not of arithmetic",
        "everybody: look here first",
    ),
    flagged(
        "input",
        "a known input is added to the state or to the observation",
        "a failure drops or shifts it",
        "control and navigation, where inputs are commands and measured accelerations",
    ),
    flagged(
        "missing",
        "readings are missing",
        "a failure uses them, stops, or keeps a gain that was meant for other sensors",
        "econometrics and sensor networks, where gaps are the rule",
    ),
    flagged(
        "ahead",
        "the last steps have no reading, so their moments are predictions",
        "a failure ends with the last reading, or carries the state on without its covariance",
        "forecasting, tracking through occlusion",
    ),
    flagged(
        "time-varying",
        "matrices differ from step to step",
        "a failure freezes them or shifts their index",
        "navigation with irregular sampling, regressions whose coefficients drift",
    ),
    flagged(
        "adapted",
        "matrices depend on past readings",
        "a failure takes them from the wrong step, or takes them for constant",
        "identification and adaptive control",
    ),
    flagged(
        "convention",
        "numbers for which each other reading of start, timing, index or order gives another answer",
        "a failure most likely reads the model otherwise than it is written",
        "everybody who writes an adapter or moves from one library to another",
    ),
    flagged(
        "correlated",
        "process and observation noise are correlated",
        "a failure drops or mistimes the cross term",
        "navigation with one sensor for input and observation, ARMA models, innovation forms",
    ),
    flagged(
        "arriving",
        "the noise of y_k is shared with the transition that leads into k, not out of it",
        "a failure shifts the cross term or the transitions by one step",
        "whoever takes a model from a text with the other index",
    ),
    flagged(
        "before-transition",
        "the initial law comes before a transition",
        "a failure starts one step early or late",
        "whoever moves models between libraries: both starts are in use",
    ),
    flagged(
        "diffuse",
        "nothing is known of (part of) the first state",
        "a failure puts a large number where a limit is meant",
        "econometrics: trends and seasons start so",
    ),
    flagged(
        "likelihood",
        "the log likelihood is easy to get wrong",
        "a failure counts missing sensors, forgets log 2 pi, or takes the logarithm of a determinant that underflows",
        "econometrics and everybody who estimates parameters or compares models",
    ),
    flagged(
        "unstable",
        "a mode grows",
        "a failure lets rounding errors grow with it",
        "control of unstable plants, inertial navigation",
    ),
    flagged(
        "units",
        "very small or large units",
        "a failure compares with an absolute tolerance somewhere",
        "everybody whose numbers are not near one: radians beside metres, returns of markets, charges",
    ),
    flagged(
        "ill-conditioned",
        "digits are lost by the form of the recursion",
        "a square-root form keeps them",
        "navigation, orbits, geodesy: sharp sensors beside vague priors",
    ),
    flagged(
        "long",
        "hundreds of steps and more",
        "a failure lets errors pile up, or stops updating the covariance",
        "embedded filters that run for days",
    ),
    flagged(
        "large",
        "a dozen states and more",
        "a failure has a limit of its own, or mixes up indices that small models do not tell apart",
        "meteorology, networks, econometrics with seasons",
    ),
    flagged(
        "singular",
        "the innovation covariance is singular",
        "a failure inverts it or adds something to its diagonal",
        "redundant sensors, exact constraints, stochastic singularity in economics",
    ),
    flagged(
        "contradiction",
        "the data have probability zero under the model",
        "a good program says so; a failure returns numbers that mean nothing",
        "redundant sensors, of which one is broken",
    ),
    flagged(
        "real-data",
        "observations of the world",
        "a failure is one that users meet",
        "everybody; econometrics, hydrology, climate",
    ),
    flagged(
        "binary32",
        "numbers mean single-precision numbers",
        "a failure loses more digits than single precision must",
        "embedded filters and accelerators",
    ),
    flagged(
        "bad-input",
        "no valid problem",
        "a good program refuses it",
        "everybody: what is accepted here is answered with numbers elsewhere",
    ),
];

/// The flags, in the order in which they are explained.
pub fn flags() -> &'static [Flag] {
    &FLAGS
}

/// The flag of this name.
///
/// # Examples
///
/// ```
/// use exact_kalman::judge::flag;
///
/// assert!(flag("units").is_some_and(|flag| flag.failing.contains("absolute tolerance")));
/// assert_eq!(flag("no-such-flag"), None);
/// ```
pub fn flag(name: &str) -> Option<&'static Flag> {
    FLAGS.iter().find(|flag| flag.name == name)
}

/// What a flag of a case exercises, and what failing it means.
pub fn meaning(name: &str) -> Option<String> {
    flag(name).map(|flag| format!("{}: {}", flag.exercises, flag.failing))
}
