#!/usr/bin/env bash
# SPDX-FileCopyrightText: The impinge authors
# SPDX-License-Identifier: MIT
#
# Writes tests/oracle/verdicts.txt anew: the oracle's verdict on each pair of solids that the tests ask for. Run it after a
# change of scenes/solid_pairs* or of the oracle, from anywhere: scripts/keep_verdicts.sh [BUILD], build/dev by default.
# Verdicts that are not in the build's oracle folder take CGAL some minutes.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
build=${1:-build/dev}
kept=tests/oracle/verdicts.txt
cmake --build "$build" --target verdict_test verdict_oracle_test
written=$(mktemp)
trap 'rm -f "$written"' EXIT
export IMPINGE_VERDICTS_OUT=$written
"$build/tests/oracle/verdict_oracle_test" --gtest_brief=1
# The pairs of which nothing is known by hand; whether impinge agrees is no matter here.
"$build/tests/clash/verdict_test" --gtest_brief=1 '--gtest_filter=*AreExact/*' || true
{
  printf '%s\n' '# SPDX-FileCopyrightText: The impinge authors' '# SPDX-License-Identifier: MIT' '#' \
    "# By scripts/keep_verdicts.sh: the hash of a pair's bytes, the number of the oracle's verdict, which one is inside, a name."
  LC_ALL=C sort -u "$written"
} >"$kept"
printf '%s verdicts in %s\n' "$(grep -vc '^#' "$kept")" "$kept"
