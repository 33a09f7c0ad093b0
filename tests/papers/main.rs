//! Published numbers, and the claims of the papers, one module each.

mod chen_kumar_van_schuppen;
mod nile;
