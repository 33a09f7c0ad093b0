#!/bin/sh
# Type-checks the harnesses as Kani would compile them, on stable Rust and without Kani.
#
# The crate `kani` is supplied by Kani's own driver; a stub with the same names stands in for it here. This proves
# nothing about the code: it keeps the Kani side of each harness from rotting.
set -eu
cd "$(dirname "$0")/.."

stub=${CARGO_TARGET_DIR:-target}/kani-stub
mkdir -p "$stub"
stub=$(cd "$stub" && pwd)

rustc --edition 2024 --crate-type proc-macro --crate-name kani_attributes \
    --out-dir "$stub" proofs/kani/stub/attributes.rs
# An extension differs between systems, a crate name does not.
rustc --edition 2024 --crate-type rlib --crate-name kani -L "$stub" --extern kani_attributes \
    --out-dir "$stub" proofs/kani/stub/kani.rs

# Flags after the dashes reach the harnesses only: some dependencies have a `cfg(kani)` of their own.
# `-C metadata` keeps the result apart from that of the native run.
# `judge` adds the harnesses on doubles and on literals.
for features in "" judge; do
    cargo rustc --profile check --no-default-features --features "$features" --test proofs -- \
        --cfg kani --extern "kani=$stub/libkani.rlib" -L "dependency=$stub" -C metadata=kani -D warnings
done
