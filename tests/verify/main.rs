//! Certificates are accepted as they are made, and what is accepted is true: decided by the exact filter.
#![cfg(feature = "judge")]

mod accepted;
mod corrupted;
mod files;
mod kept;
mod models;
mod steady;
mod steady_models;
mod streamed;
mod tight;
mod truth;
