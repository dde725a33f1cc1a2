#!/usr/bin/env bash
# SPDX-FileCopyrightText: The impinge authors
# SPDX-License-Identifier: MIT
#
# bench/run.sh [--quick] BUILD_DIR: runs every benchmark built there and puts its tables into a page.
# The full run writes what the repository keeps: bench/baselines/*.csv and the tables of docs/benchmarks.md. --quick makes
# the same tables of fewer repeats, too rough to keep: they and their page go to BUILD_DIR/bench-quick.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

fail() {
  printf 'bench/run.sh: %s\n' "$*" >&2
  exit 2
}

quick=()
build=
for argument in "$@"; do
  case $argument in
    --quick) quick=(--quick) ;;
    -*) fail "there is no option '$argument'; usage: bench/run.sh [--quick] BUILD_DIR" ;;
    *) [ -z "$build" ] || fail "one build folder, not '$argument' as well"; build=$argument ;;
  esac
done
[ -n "$build" ] || fail 'usage: bench/run.sh [--quick] BUILD_DIR'
[ -x "$build/bin/bench_fcl" ] || fail "$build/bin/bench_fcl is missing; configure with -DIMPINGE_BUILD_BENCH=ON and build"

page=$root/docs/benchmarks.md
tables=$root/bench/baselines
if [ ${#quick[@]} -gt 0 ]; then
  tables=$build/bench-quick
  page=$tables/benchmarks.md
  mkdir -p "$tables"
  awk '{ print } NR == 1 { print "\n**Rough: made by --quick, with fewer poses, objects and repeats than the text says.**" }' \
    "$root/docs/benchmarks.md" >"$page"
fi

for name in machine assemblies fcl ablation flush_boxes cost micro; do
  printf '\n== bench_%s\n' "$name"
  "$build/bin/bench_$name" "${quick[@]}" "$tables"
done
if commit=$(git -C "$root" rev-parse --short HEAD 2>/dev/null); then
  git -C "$root" diff --quiet HEAD -- src include bench scenes io 2>/dev/null || commit="$commit and changes"
  printf 'commit,%s\n' "$commit" >>"$tables/machine.csv"
fi

# What stands between <!-- table: NAME --> and <!-- end --> becomes NAME.csv as a table.
awk -v tables="$tables" '
  function row(line) { gsub(/,/, " | ", line); return "| " line " |" }
  /^<!-- table: [a-z_]+ -->$/ {
    print; print ""
    file = tables "/" $3 ".csv"
    first = 1
    while ((status = (getline line < file)) > 0) {
      print row(line)
      if (first) { gsub(/[^,]+/, "---", line); print row(line); first = 0 }
    }
    if (status < 0) { print "bench/run.sh: cannot read " file > "/dev/stderr"; exit 2 }
    close(file); print ""; skipping = 1
  }
  /^<!-- end -->$/ { skipping = 0 }
  !skipping && !/^<!-- table:/ { print }
' "$page" >"$page.new"
mv "$page.new" "$page"
printf '\ntables: %s\npage:   %s\n' "$tables" "$page"
