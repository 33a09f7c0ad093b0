//! The attributes of Kani that the harnesses use, without their meaning.

extern crate proc_macro;

use proc_macro::TokenStream;

/// `#[kani::proof]`: as with Kani, a harness counts as used though nothing calls it.
#[proc_macro_attribute]
pub fn proof(_: TokenStream, item: TokenStream) -> TokenStream {
    let used: TokenStream = "#[allow(dead_code)]".parse().expect("an attribute");
    used.into_iter().chain(item).collect()
}

/// `#[kani::unwind(n)]`
#[proc_macro_attribute]
pub fn unwind(_: TokenStream, item: TokenStream) -> TokenStream {
    item
}
