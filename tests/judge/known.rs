//! The suite with its truths and what the built-in forms make of it, computed once for all tests.

use std::sync::LazyLock;

use exact_kalman::float::Form;
use exact_kalman::judge::{Examinee as _, Judgement, Truth, suite};
use exact_kalman::protocol::Case;
use rayon::prelude::*;

/// A case, what the judge knows of it, and the judgement on each form.
pub(crate) struct Known {
    pub(crate) case: Case,
    pub(crate) truth: Truth,
    pub(crate) forms: Vec<(Form, Judgement)>,
}

impl Known {
    fn of(case: Case) -> Self {
        let truth = Truth::of(&case);
        let judged = |form: Form| (form, Judgement::of(case.expect, &truth, &{ form }.reply(&case)));
        Self { forms: Form::ALL.map(judged).to_vec(), truth, case }
    }

    pub(crate) fn judgement(&self, form: Form) -> &Judgement {
        let found = self.forms.iter().find(|(known, _)| *known == form);
        &found.expect("each form is judged").1
    }
}

static SUITE: LazyLock<Vec<Known>> = LazyLock::new(|| suite().into_par_iter().map(Known::of).collect());

/// Every case of the suite.
pub(crate) fn known() -> &'static [Known] {
    &SUITE
}

/// One case of the suite.
pub(crate) fn known_case(id: &str) -> &'static Known {
    known().iter().find(|known| known.case.id == id).unwrap_or_else(|| panic!("no case {id}"))
}
