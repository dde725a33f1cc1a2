#!/usr/bin/env bash
# SPDX-FileCopyrightText: The impinge authors
# SPDX-License-Identifier: MIT
#
# Writes tests/oracle/answers.txt anew: the oracle's answer to each question that the tests ask. Run it after a change of the
# scenes or of the oracle, from anywhere: scripts/keep_answers.sh. Needs CGAL, as ./dev test --all does. Answers that are not in
# build/release/oracle take some minutes.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
kept=tests/oracle/answers.txt
written=$(mktemp)
trap 'rm -f "$written"' EXIT
# Whether impinge agrees with the oracle is no matter here, whether the oracle answered is.
export IMPINGE_ANSWERS_OUT=$written
scripts/fetch_data.sh
cmake --preset release -DIMPINGE_BUILD_TESTS=release -DIMPINGE_BUILD_ORACLE=ON
cmake --build build/release --target oracle_test clash_test
ctest --preset release --parallel "$(nproc)" -R '^oracle[.]|^clash.verdict' ||
  echo 'Some tests failed: see above whether the oracle did, or only impinge disagrees with it.' >&2
{
  printf '%s\n' '# SPDX-FileCopyrightText: The impinge authors' '# SPDX-License-Identifier: MIT' '#' \
    "# By scripts/keep_answers.sh: the hash of a question's bytes; of a set its hash and how many pairs cross, touch and are" \
    '# coplanar, of two solids the number of the verdict and which one is inside; # a test that asks.'
  LC_ALL=C sort "$written" | awk '!seen[$1]++'
} >"$kept"
printf '%s answers in %s\n' "$(grep -vc '^#' "$kept")" "$kept"
