//! The document of an identification: data, and what is to be estimated from them.

use std::fmt;
use std::marker::PhantomData;

use serde::de::value::MapAccessDeserializer;
use serde::de::{Deserializer, MapAccess, Visitor};
use serde::{Deserialize, Serialize};

use super::document;
use super::{Datum, InputError, Numbers};

/// A question of identification; exactly one of the two methods is there.
///
/// # Examples
///
/// ```
/// use exact_kalman::protocol::Identification;
///
/// let text = r#"{"format": "exact-kalman/identification/1", "numbers": "exact",
///     "moments": {"readings": [["1"], [2], ["7/2"]]}}"#;
/// assert!(Identification::parse(text)?.moments.is_some());
/// # Ok::<(), exact_kalman::protocol::InputError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Identification {
    /// The format and its version.
    pub format: IdentificationFormat,
    /// What the numbers mean.
    #[serde(default)]
    pub numbers: Numbers,
    /// Estimate A, V and W of AK-1.1, AK-1.2.
    #[serde(default, deserialize_with = "object")]
    pub moments: Option<Moments>,
    /// Learn the coefficients of an autoregression with inputs (CKS-ARX).
    #[serde(default, deserialize_with = "object")]
    pub least_squares: Option<LeastSquares>,
}

/// The format of the document, with its version.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum IdentificationFormat {
    /// The only version so far.
    #[serde(rename = "exact-kalman/identification/1")]
    One,
}

/// The estimators of Anderson et al.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Moments {
    /// y(1), y(2), …
    pub readings: Vec<Vec<Datum>>,
    /// Which estimate of A stands in the residuals (AK-2.2).
    #[serde(default)]
    pub residuals: ResidualsName,
    /// Runs the adaptive filter, too.
    #[serde(default, deserialize_with = "object")]
    pub adaptive_filter: Option<AdaptiveStart>,
}

/// The start of the adaptive filter: after y(2), or after y(p+1) where estimates are kept as they are.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct AdaptiveStart {
    /// x̂(2|2).
    pub mean: Vec<Datum>,
    /// P̂ at that time.
    pub covariance: Vec<Vec<Datum>>,
    /// What stands for an estimated covariance that is none.
    #[serde(default)]
    pub repair: RepairName,
}

/// The names of [`Reading`](crate::model::Reading).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum ResidualsName {
    /// Â(k), as printed.
    #[default]
    Printed,
    /// Â(n) throughout.
    Last,
    /// Â(k−1) and Â(k)Â(k−1).
    Predictive,
}

/// The names of [`Repair`](crate::model::Repair).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum RepairName {
    /// As it is.
    Keep,
    /// The zero matrix.
    #[default]
    Zero,
    /// The last good one.
    #[serde(rename = "last semidefinite")]
    LastSemidefinite,
}

/// Recursive least squares.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LeastSquares {
    /// How many earlier outputs are in a regressor.
    pub output_lags: usize,
    /// How many earlier inputs are.
    #[serde(default)]
    pub input_lags: usize,
    /// The prior mean of the coefficients.
    pub mean: Vec<Datum>,
    /// Their prior covariance.
    pub covariance: Vec<Vec<Datum>>,
    /// The variance of the noise.
    pub noise: Datum,
    /// y_0, y_1, …
    pub outputs: Vec<Datum>,
    /// u_0, u_1, …
    #[serde(default)]
    pub inputs: Vec<Datum>,
    /// y_{−1}, y_{−2}, …; zero where none is given.
    #[serde(default)]
    pub earlier_outputs: Vec<Datum>,
    /// u_{−1}, u_{−2}, …; zero where none is given.
    #[serde(default)]
    pub earlier_inputs: Vec<Datum>,
}

impl Identification {
    /// Reads one document.
    ///
    /// # Errors
    ///
    /// [`InputError`] with the place; also if there is not exactly one method.
    pub fn parse(text: &str) -> Result<Self, InputError> {
        let document: Self = document::parse_object(text)?;
        if document.moments.is_some() == document.least_squares.is_some() {
            return Err(InputError::at("", "give either `moments` or `least_squares`"));
        }
        Ok(document)
    }
}

/// A field that is an object: a derived reader would take a list of its parts as well.
fn object<'de, T: Deserialize<'de>, D: Deserializer<'de>>(deserializer: D) -> Result<Option<T>, D::Error> {
    struct Object<T>(PhantomData<T>);

    impl<'de, T: Deserialize<'de>> Visitor<'de> for Object<T> {
        type Value = T;

        fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
            f.write_str("an object")
        }

        fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<T, A::Error> {
            T::deserialize(MapAccessDeserializer::new(map))
        }
    }

    deserializer.deserialize_map(Object(PhantomData)).map(Some)
}
