#!/usr/bin/env bash
# SPDX-FileCopyrightText: The impinge authors
# SPDX-License-Identifier: MIT
#
# figures_test.sh PROGRAM PAGE DRIVER: impinge-gpu-figures prints every row; on a software driver it measures nothing
# unless told to, and then says what it is; the page keeps the same columns.
set -u
program=$1 page=$2
export VK_ICD_FILENAMES=$3 VK_DRIVER_FILES=$3
unset IMPINGE_DEVICE IMPINGE_FIGURES_COMMAND
failures=0

fail() {
  echo "FAILED: $*"
  failures=$((failures + 1))
}

# has TEXT PATTERN COUNT WHAT: so many lines of the text match.
has() {
  local found
  found=$(grep -cE "$2" <<<"$1")
  [ "$found" -eq "$3" ] || fail "$4: $found lines, not $3, match '$2' in: $1"
}

readonly rows=20
number='[0-9]+(\.[0-9]+)?'

# has_rows TABLE WHAT: one for each case, two more for each case that is rated.
has_rows() {
  has "$1" '^\| case \| triangles \| contacts \| simd ms \| gpu ms \| hybrid ms \| raster ms \| hybrid / better \|' 1 "$2"
  has "$1" '^\| narrow stage: ' 2 "$2"
  has "$1" '^\| its pairs of triangles tested, ' 4 "$2"
  has "$1" '^\| paper: mutual motion' 5 "$2"
  has "$1" '^\| pair of knots, (light|deep) \| 2 x 70,000 ' 2 "$2"
  has "$1" '^\| [0-9,]+ poses, .*, (first contact|all contacts) ' 4 "$2"
  has "$1" '^\| [0-9,]+ moving bodies' 1 "$2"
  has "$1" '^\| sheets, (from raw vertices|meshes resident) ' 2 "$2"
  has "$1" '^\| .* \|$' $((rows + 2)) "$2"
  has "$1" '^\| .*(\| [^|]+){11}\|$' $((rows + 2)) "$2"
}

software=$("$program" --quick --software 2>/dev/null) || fail 'it does not end well on a software driver'
has_rows "$software" 'with --software'
has "$software" 'software driver, not a GPU' 1 'with --software'
has "$software" 'Command: `impinge-gpu-figures --quick --software`' 1 'with --software'
has "$software" 'The answers of all backends are the same in every case' 1 'with --software'
timed="\\| $number \\| $number \\| $number \\| "
has "$software" "^\\| paper: .* $timed$number \\| $number \\| " 5 'with --software'
has "$software" "^\\| (narrow|pair|[0-9]|sheets).* $timed- \\| $number \\| " 11 'with --software'
has "$software" 'not measured|left to the CPU' 0 'with --software'

default=$("$program" --quick 2>/dev/null) || fail 'it does not end well without --software'
has_rows "$default" 'without --software'
has "$default" '\| not measured \| not measured \| - \|' 20 'without --software'
has "$default" '^\| paper: .*(\| not measured ){3}\|' 5 'without --software'
has "$default" 'are the same in every case' 0 'without --software'

none=$(VK_ICD_FILENAMES=/nowhere VK_DRIVER_FILES=/nowhere "$program" --quick --software --only sheets 2>/dev/null) ||
  fail 'it does not end well without a device'
has "$none" 'device: none \(' 1 'without a device'
has "$none" '\| not measured \| not measured \| - \|' 2 'without a device'

[ "$(grep '^| case ' <<<"$default")" = "$(grep '^| case ' "$page")" ] || fail "$page has other columns"

for wrong in --fast '--only nothing' --device '--device 99'; do
  # shellcheck disable=SC2086  # a word and its value
  "$program" --quick $wrong >/dev/null 2>&1 && fail "it takes '$wrong'"
done

[ "$failures" -eq 0 ] && echo 'all as promised'
exit "$((failures > 0))"
