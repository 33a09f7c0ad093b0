#!/bin/sh
# Random tests with other seeds than those of `cargo test`, which draws the same cases every time: a slow campaign, run by hand.
#
# Usage: tests/campaign.sh [ROUNDS] [CARGO-TEST-ARGUMENT...]     10 rounds of all tests by default
#
#   tests/campaign.sh 100 --test agree absence
#
# The first failing round ends it: exit 1, with the command that repeats it.
set -eu
case "${1-}" in -*) sed -n '2,/^set /{/^set /!s/^# \{0,1\}//p;}' "$0"; exit 2 ;; esac
rounds=${1:-10}
[ $# -eq 0 ] || shift
[ $# -gt 0 ] || set -- --lib --bins --tests
cd "$(dirname "$0")/.."
log=$(mktemp)
trap 'rm -f "$log"' EXIT
trap 'exit 1' INT TERM

round=0
while [ "$round" -lt "$rounds" ]; do
    round=$((round + 1))
    seed=$(od -An -N4 -tu4 /dev/urandom | tr -d ' ')
    echo "round $round of $rounds: seed $seed"
    PROPTEST_RNG_SEED=$seed cargo test --quiet --no-fail-fast "$@" >"$log" 2>&1 || {
        cat "$log"
        echo "to repeat it: PROPTEST_RNG_SEED=$seed cargo test $*"
        exit 1
    }
done
