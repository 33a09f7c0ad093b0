#!/bin/sh
# Runs fuzz targets for a time, from the seeds.
#
# Usage: fuzz/run.sh [SECONDS [TARGET...]]     60 seconds of every target by default
set -eu
cd "$(dirname "$0")"

seconds=${1:-60}
[ $# -gt 0 ] && shift
[ $# -gt 0 ] || set -- parse_case recursion_agrees verify_certificate

for target in "$@"; do
    # No address sanitizer: it costs half the speed, and unsafe code is forbidden here.
    # New inputs go to the first directory, which is not kept; seeds are read only.
    mkdir -p "corpus/$target"
    cargo +nightly fuzz run --sanitizer none "$target" "corpus/$target" "seeds/$target" -- \
        -max_total_time="$seconds" -max_len=2048 -timeout=20 -rss_limit_mb=4096 -print_final_stats=1
done
