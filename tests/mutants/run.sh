#!/bin/sh
# Makes each of the listed mistakes in a copy of the tree, one at a time, and runs the tests that must notice.
#
# Usage: tests/mutants/run.sh [PATCH...]     all patches beside this script by default
#        tests/mutants/run.sh --check        only whether all of them apply
#
# Exit 0 if every mistake was caught, 1 if one survived, no longer applies or does not compile.
# Compiled files are kept in CARGO_TARGET_DIR (by default a directory under the temporary one) for all of them.
set -eu
case "${1-}" in
--check)
    failures=0
    cd "$(dirname "$0")/../.."
    for patch in tests/mutants/*.patch; do
        git apply --check --whitespace=nowarn "$patch" || failures=1
    done
    exit "$failures"
    ;;
-*)
    sed -n '2,/^set /{/^set /!s/^# \{0,1\}//p;}' "$0"
    exit 2
    ;;
esac
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../.." && pwd)
[ $# -gt 0 ] || set -- "$here"/*.patch

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
trap 'exit 1' INT TERM
tree=$work/tree
export CARGO_TARGET_DIR="${CARGO_TARGET_DIR:-${TMPDIR:-/tmp}/exact-kalman-mutants}"
# A shrunk counterexample is not wanted here, only the verdict.
export PROPTEST_MAX_SHRINK_ITERS=0

# The files that are there, committed or not; build products are ignored ones.
mkdir "$tree"
(cd "$root" && git ls-files -co --exclude-standard -z | tar --null --ignore-failed-read -cf - -T - 2>/dev/null) \
    | (cd "$tree" && tar xmf -)

# `tests COMMAND-LINE`: the result of the tests on the tree as it is, written to $work/log.
tests() (
    cd "$tree"
    # shellcheck disable=SC2086 # the words of the line are the arguments
    cargo test --quiet --no-run $1 >"$work/log" 2>&1 || return 2
    # shellcheck disable=SC2086
    timeout 600 cargo test --quiet $1 >"$work/log" 2>&1 || return 1
)

asked_of() { sed -n 's/^test: //p' "$1"; }

# Tests that fail without any mistake would catch everything.
for patch in "$@"; do asked_of "$patch"; done | sort -u >"$work/lines"
while read -r line; do
    tests "$line" </dev/null || { cat "$work/log"; echo "without a mistake, cargo test $line fails"; exit 1; }
done <"$work/lines"

failures=0
for patch in "$@"; do
    name=$(basename "$patch" .patch)
    line=$(asked_of "$patch")
    begun=$(date +%s)
    if ! (cd "$tree" && git apply --whitespace=nowarn "$patch") 2>"$work/log"; then
        verdict="DOES NOT APPLY"
    else
        # Cargo compares times to the second.
        sleep 1
        (cd "$tree" && git apply --numstat "$patch" | cut -f3 | xargs touch)
        status=0
        tests "$line" || status=$?
        case $status in
            0) verdict=SURVIVED ;;
            1) verdict=caught ;;
            *) verdict="DOES NOT COMPILE" ;;
        esac
        (cd "$tree" && git apply -R --whitespace=nowarn "$patch" && git apply --numstat "$patch" | cut -f3 | xargs touch)
    fi
    by=$(sed -n 's/^---- \(.*\) stdout ----$/\1/p' "$work/log" | sort | tr '\n' ' ')
    printf '%-16s %-42s %4ss  %s\n' "$verdict" "$name" "$(($(date +%s) - begun))" "$by"
    if [ "$verdict" != caught ]; then
        failures=$((failures + 1))
        [ "$verdict" = SURVIVED ] || cat "$work/log"
    fi
done
echo "$# mistakes, $failures not caught"
[ "$failures" -eq 0 ]
