//! Anderson, Kleindorfer, Kleindorfer, Woodroofe 1969: parallel sum, Stein, the filter, the map and its fixed point.
//!
//! Expectations come from second routes: elimination of a bordered matrix for the parallel sum, finite probability
//! spaces for projections, fixed points known by construction.

mod continuity;
mod draws;
mod filter;
mod fixed_point;
mod gaussian;
mod model;
mod order;
mod parallel_sum;
mod riccati;
mod stein;
