#!/bin/sh
# Asks the solvers about every statement and every control below this directory; exit 0 if all answers are those expected.
#
# Usage: proofs/smt/check.sh [WORD...]     only files whose names hold one of the words
#
# Needs Python 3 with venv and a package index; the solvers, of fixed versions, are installed once, under target/smt.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../.." && pwd)
venv="${CARGO_TARGET_DIR:-$root/target}/smt/venv"
solvers="z3-solver==5.4.0.0 bitwuzla==0.9.1"
if ! command -v python3 >/dev/null; then
    echo "check.sh: python3 is missing; on Debian: apt-get install python3 python3-venv" >&2
    exit 2
fi
if [ "$(cat "$venv/solvers" 2>/dev/null || true)" != "$solvers" ]; then
    rm -rf "$venv"
    mkdir -p "$(dirname "$venv")"
    if ! python3 -m venv "$venv"; then
        echo "check.sh: Python's venv is missing; on Debian: apt-get install python3-venv" >&2
        exit 2
    fi
    tries=0
    # shellcheck disable=SC2086
    until "$venv/bin/python" -m pip install --quiet --disable-pip-version-check $solvers; do
        tries=$((tries + 1))
        [ "$tries" -lt 4 ] || { echo "check.sh: the solvers cannot be installed" >&2; exit 2; }
        sleep $((tries * 5))
    done
    echo "$solvers" >"$venv/solvers"
fi
exec "$venv/bin/python" -B "$here/check.py" "$@"
