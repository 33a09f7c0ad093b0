//! The stirred tank reactor of Hilgert and Vila 1999, section 3: biomass predicted from readings of the substrate.
//!
//! The biomass x_B grows on the substrate x_S; the feed brings substrate and washes both out. Only x_S is read, without
//! noise. Since the growth rate depends on a substrate that was read before, the system is linear with coefficients
//! adapted to the readings, and the ordinary ("standard") predictor is exact for it; the extended one takes the old
//! substrate for a further state and makes the growth law linear there.
//!
//! What the paper leaves unsaid is a named input here: the readings before the first ([`Earlier`]), the start of the old
//! substrate and the point of linearisation ([`Start`]). [`Preset`] names some choices. Concentrations are in mg/l,
//! times in hours.
//!
//! **Index rule.** The paper numbers states from 1; index k of the code counts readings from 0, so it is the paper's
//! k + 1. Transition k leads from x_k to x_{k+1}.

mod error;
mod extended;
mod figure;
mod options;
mod printed;
mod quantile;
mod rate;
mod reactor;
mod setting;
mod squares;
mod standard;
mod start;
mod system;
mod table;
mod trial;

pub use error::{BioreactorError, Unphysical};
pub use extended::{extended_predictions, linear_at};
pub use figure::{Figure, Point, figure};
pub use options::{Options, Truth};
pub use printed::{PRINTED, Printed};
pub use quantile::Band;
pub use rate::{Concentration, Exponent};
pub use reactor::Reactor;
pub use setting::{Coefficients, Earlier, Setting};
pub use squares::{mean_squared_error, relative_efficiency};
pub use standard::{standard_predictions, standard_predictions_exact};
pub use start::{Belief, Preset, Start};
pub use system::{path_in_doubles, realised, system};
pub use table::{Row, Table, table};
pub use trial::{Errors, trial};
