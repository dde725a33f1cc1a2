#!/usr/bin/env bash
# SPDX-FileCopyrightText: The impinge authors
# SPDX-License-Identifier: MIT
#
# bench/run.sh [--quick] BUILD_DIR: runs every benchmark built there, draws the charts and writes the page.
# The full run replaces what the repository keeps: bench/baselines/*.csv, docs/charts and the tables of
# docs/benchmarks.md. --quick makes the same of fewer meshes, poses and repeats, too rough to keep: it goes to
# BUILD_DIR/bench-quick.
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
[ -x "$build/bin/bench_pairs" ] ||
  fail "$build/bin/bench_pairs is missing; configure with -DIMPINGE_BUILD_BENCH=ON and build"

# A run that ends half-way leaves the tables of the last whole one alone.
new=$build/bench-new
rm -rf "$new"
mkdir -p "$new"
for name in machine pairs paper unequal planner touching bodies assemblies build deforming growth one_shot threads cost distance micro; do
  start=$SECONDS
  printf 'bench_%-14s' "$name"
  "$build/bin/bench_$name" "${quick[@]}" "$new" >"$new/$name.log" ||
    fail "bench_$name failed; its output is in $new/$name.log"
  printf '%4d s\n' $((SECONDS - start))
done
if commit=$(git -C "$root" rev-parse --short HEAD 2>/dev/null); then
  git -C "$root" diff --quiet HEAD -- src include bench scenes io 2>/dev/null || commit="$commit and changes"
  printf 'commit,%s\n' "$commit" >>"$new/machine.csv"
fi
printf 'the whole run,%d min %d s\n' $((SECONDS / 60)) $((SECONDS % 60)) >>"$new/machine.csv"

if [ ${#quick[@]} -gt 0 ]; then
  tables=$build/bench-quick
  page=$tables/benchmarks.md
  mkdir -p "$tables"
  cp "$root/docs/benchmarks.md" "$page"
else
  tables=$root/bench/baselines
  page=$root/docs/benchmarks.md
fi
rm -f "$tables"/*.csv
mv "$new"/*.csv "$tables"
/usr/bin/python3 "$root/bench/report/page.py" "${quick[@]}" "$tables" "$page"
printf 'tables: %s\npage:   %s\n' "$tables" "$page"
