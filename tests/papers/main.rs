//! Published numbers, and the claims of the papers, one module each.

mod nile;
