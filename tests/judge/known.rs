//! The suite with its truths and what the built-in forms make of it, computed once for all tests.

use std::sync::LazyLock;

use exact_kalman::float::Form;
use exact_kalman::judge::{Examinee as _, Judgement, Truth};
use exact_kalman::protocol::Case;
use rayon::prelude::*;

use crate::samples::TRUTHS;

/// A case, what the judge knows of it, and the judgement on each form.
pub(crate) struct Known {
    pub(crate) case: &'static Case,
    pub(crate) forms: Vec<(Form, Judgement)>,
}

impl Known {
    fn of(case: &'static Case, truth: &Truth) -> Self {
        let judged = |form: Form| (form, Judgement::of(case.expect, truth, &{ form }.reply(case)));
        Self { forms: Form::ALL.map(judged).to_vec(), case }
    }

    pub(crate) fn judgement(&self, form: Form) -> &Judgement {
        let found = self.forms.iter().find(|(known, _)| *known == form);
        &found.expect("each form is judged").1
    }
}

static SUITE: LazyLock<Vec<Known>> =
    LazyLock::new(|| TRUTHS.par_iter().map(|(case, truth)| Known::of(case, truth)).collect());

/// Every case of the suite.
pub(crate) fn known() -> &'static [Known] {
    &SUITE
}

/// One case of the suite.
pub(crate) fn known_case(id: &str) -> &'static Known {
    known().iter().find(|known| known.case.id == id).unwrap_or_else(|| panic!("no case {id}"))
}
