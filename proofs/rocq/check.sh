#!/usr/bin/env bash
# Checks the theorems of this directory and keeps the lists of them right.
#
#   proofs/rocq/check.sh              sources, proofs, assumptions, lists
#   proofs/rocq/check.sh --faults     the same for each fault of faults.txt, which must fail
#   proofs/rocq/check.sh --coqchk     besides, the small checker on all compiled files (some minutes)
#   proofs/rocq/check.sh --update     writes assumptions.txt and the table of README.md
#   proofs/rocq/check.sh --install    installs the Debian packages first
#
# Compiled files go to target/rocq.
set -euo pipefail
export LC_ALL=C.UTF-8

here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../.." && pwd)
sources=${ROCQ_SOURCES:-$here}
build=${ROCQ_BUILD:-$root/target/rocq}
spec=$root/SPEC.md
packages=(coq libcoq-mathcomp libcoq-mathcomp-real-closed libcoq-mathcomp-algebra-tactics)

fail() { echo "check.sh: $*" >&2; exit 1; }

install=0 coqchk=0 update=0 faults=0
for option in "$@"; do
  case $option in
    --install) install=1 ;;
    --coqchk) coqchk=1 ;;
    --update) update=1 ;;
    --faults) faults=1 ;;
    *) fail "unknown option $option" ;;
  esac
done

if [ $install = 1 ]; then
  sudo=(); [ "$(id -u)" = 0 ] || sudo=(sudo)
  for attempt in 1 2 3; do
    if "${sudo[@]}" apt-get update && "${sudo[@]}" apt-get install -y --no-install-recommends make "${packages[@]}"; then break; fi
    [ $attempt -lt 3 ] || fail "the packages could not be installed"
    sleep 15
  done
fi

command -v coqc > /dev/null || fail "coqc is missing; try --install (Debian 12: ${packages[*]})"
version=$(coqc --print-version | cut -d' ' -f1)
case $version in 8.16.*) ;; *) fail "coqc is $version; the files are written for 8.16 with MathComp 1.15" ;; esac

files=$(grep '\.v$' "$sources/_CoqProject")
for file in "$sources"/*.v; do
  grep -qx "$(basename "$file")" <<< "$files" || fail "$(basename "$file") is not in _CoqProject"
done

# Each line: file, keyword, name, comment; the comment is the one that stands directly before.
theorems() {
  for file in $files; do
    awk -v file="$file" '
      /^\(\*\*/ { comment = $0; sub(/^\(\*\* /, "", comment); open = !/\*\)$/; sub(/ \*\)$/, "", comment); next }
      open      { line = $0; open = !/\*\)$/; sub(/^ +/, " ", line); sub(/ \*\)$/, "", line); comment = comment line; next }
      /^(Theorem|Lemma|Fact|Corollary) / {
        name = $2; sub(/:$/, "", name); print file "\t" $1 "\t" name "\t" comment }
      { comment = "" }' "$sources/$file"
  done
}

# 1. Nothing is taken for granted: no axiom by any of its names, nothing left open, no hypothesis outside a section.
check_sources() {
  for file in $files; do
    awk -v file="$file" '
      function bad(what) { print "check.sh: " file ":" FNR ": " what > "/dev/stderr"; failed = 1 }
      { line = $0
        while (match(line, /\(\*([^*]|\*[^)])*\*\)/)) line = substr(line, 1, RSTART - 1) substr(line, RSTART + RLENGTH)
        if (inside) { if (line ~ /\*\)/) { inside = 0 } ; next }
        if (line ~ /\(\*/) { inside = 1; next } }
      line ~ /^ *Section /                  { depth++ }
      line ~ /^ *End /                      { depth-- }
      line ~ /(^|[^[:alnum:]_])(Axioms?|Parameters?|Conjectures?|Admitted|admit|Admit|Abort|bypass_check|Unset (Guard|Universe|Positivity))([^[:alnum:]_]|$)/ { bad("taken for granted: " line) }
      line ~ /^ *(Hypothes[ie]s|Variables?|Context)([^[:alnum:]_]|$)/ && depth == 0 { bad("outside any section: " line) }
      END { exit failed }' "$sources/$file" || exit 1
  done
}

# 2. Every identifier is one of SPEC.md, every comment with one ends in a full stop.
check_comments() {
  theorems | while IFS=$'\t' read -r file keyword name comment; do
    identifiers=$(grep -oE '^[A-Z]+-[A-Za-z0-9.-]+(, [A-Z]+-[A-Za-z0-9.-]+)*: ' <<< "$comment" || true)
    [ -n "$identifiers" ] || continue
    [ "${comment: -1}" = . ] || { echo "check.sh: $file: the comment of $name does not end in a full stop" >&2; exit 1; }
    for identifier in $(tr -d ',:' <<< "$identifiers"); do
      grep -q "^### $identifier " "$spec" || { echo "check.sh: $file: $name names $identifier, which SPEC.md has not" >&2; exit 1; }
    done
  done
}

# 3. Coq accepts every proof.
compile() {
  mkdir -p "$build"
  for file in _CoqProject $files; do
    cmp -s "$sources/$file" "$build/$file" || cp "$sources/$file" "$build/$file"
  done
  (cd "$build" && coq_makefile -f _CoqProject -o Makefile > /dev/null && make -j2 --no-print-directory)
}

# 4. The list of theorems, and what each rests on, one line a theorem; two files at a time.
named() { theorems | awk -F'\t' '$2 == "Theorem" || $4 ~ /^[A-Z]+-[A-Za-z0-9.-]+(, [A-Z]+-[A-Za-z0-9.-]+)*: / { sub(/\.v$/, "", $1); print $1 "." $3 }'; }

check_names() {
  diff <(cut -d: -f1 "$sources/assumptions.txt") <(named) || fail "the list of theorems differs from assumptions.txt; see --update"
}

# Asking once for all theorems together takes seconds, asking for each minutes: a bundle that rests on nothing has no part
# that rests on something. If it does rest on something, that is printed.
assumptions() {
  { for file in $files; do echo "From Kalman Require $(basename "$file" .v)."; done
    echo "Definition bundle := ("
    named | sed 's/.*/@Kalman.&,/'
    echo "tt). Print Assumptions bundle."; } > "$build/bundle.v"
  (cd "$build" && coqtop -q -w none -Q . Kalman -batch -l bundle.v 2> bundle.err) > "$build/bundle.out" || { cat "$build/bundle.err" >&2; return 1; }
  [ "$(cat "$build/bundle.out")" = "Closed under the global context" ] || { cat "$build/bundle.out" >&2; return 1; }
  named | sed 's/$/: Closed under the global context/'
}

# 5. The table of README.md.
table() {
  echo "| identifiers | theorem | file |"
  echo "| --- | --- | --- |"
  theorems | awk -F'\t' '
    $4 ~ /^[A-Z]+-[A-Za-z0-9.-]+(, [A-Z]+-[A-Za-z0-9.-]+)*: / { split($4, part, ":"); print "| " part[1] " | `" $3 "` | `" $1 "` |" }'
  echo
  echo "$(named | wc -l) theorems, $(theorems | cut -f4 | grep -oE '^[A-Z]+-[A-Za-z0-9.-]+(, [A-Z]+-[A-Za-z0-9.-]+)*: ' | tr -d ',:' | tr ' ' '\n' | grep . | sort -u | wc -l) entries of SPEC.md."
}

readme_with_table() {
  awk -v table="$1" '
    /^<!-- table -->$/     { print; while ((getline line < table) > 0) print line; skip = 1; next }
    /^<!-- end table -->$/ { skip = 0 }
    !skip' "$here/README.md"
}

if [ $faults = 1 ]; then
  copy=$root/target/rocq-fault
  while IFS='|' read -r file edit what; do
    [ -n "$file" ] && [ "${file:0:1}" != '#' ] || continue
    rm -rf "$copy"; mkdir -p "$copy/sources"
    cp "$here"/*.v "$here/_CoqProject" "$here/assumptions.txt" "$copy/sources"
    cp -a "$build" "$copy/build"
    sed -i -E "$edit" "$copy/sources/$file"
    cmp -s "$here/$file" "$copy/sources/$file" && fail "the fault \"$what\" changes nothing"
    if ROCQ_SOURCES=$copy/sources ROCQ_BUILD=$copy/build "$0" > "$copy/log" 2>&1; then fail "not caught: $what"; fi
    echo "caught: $what ($(grep -m1 -E 'Error|check.sh:|^[<>]' "$copy/log" | cut -c1-90))"
  done < "$here/faults.txt"
  exit 0
fi

start=$SECONDS
check_sources
check_comments
[ $update = 1 ] || check_names
compile
compiled=$SECONDS
assumptions > "$build/assumptions.txt" || fail "a theorem rests on an assumption"
if [ $update = 1 ]; then
  cp "$build/assumptions.txt" "$here/assumptions.txt"
  table > "$build/table.md"; readme_with_table "$build/table.md" > "$build/README.md"; cp "$build/README.md" "$here/README.md"
fi
diff "$sources/assumptions.txt" "$build/assumptions.txt" || fail "assumptions.txt is out of date; see --update"
if [ "$sources" = "$here" ]; then
  table > "$build/table.md"
  readme_with_table "$build/table.md" | diff "$here/README.md" - || fail "the table of README.md is out of date; see --update"
fi
echo "$(wc -l < "$build/assumptions.txt") theorems, none rests on an assumption; compiled in $((compiled - start)) s, $((SECONDS - start)) s in all"

if [ $coqchk = 1 ]; then
  start=$SECONDS
  (cd "$build" && coqchk -silent -o -Q . Kalman $(for file in $files; do echo "Kalman.$(basename "$file" .v)"; done)) > "$build/coqchk.out" 2>&1 || {
    cat "$build/coqchk.out" >&2; fail "coqchk refuses the files"; }
  # The axioms of the loaded libraries are the machine's integers and floats, which no theorem uses (step 4).
  if sed -n '/^\* Axioms/,/^\* Constants/p' "$build/coqchk.out" | grep -E '^ +[A-Z]' | grep -vE 'Coq\.(Numbers\.Cyclic\.Int63\.PrimInt63|Floats\.PrimFloat)\.'; then
    fail "coqchk finds an axiom"
  fi
  [ "$(grep -cE '(type-in-type|unsafe \(co\)fixpoints|positivity is assumed): <none>' "$build/coqchk.out")" = 3 ] || {
    cat "$build/coqchk.out" >&2; fail "coqchk finds an unsafe setting"; }
  echo "coqchk: $((SECONDS - start)) s"
fi
