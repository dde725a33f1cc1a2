#!/usr/bin/env bash
# SPDX-FileCopyrightText: The impinge authors
# SPDX-License-Identifier: MIT
#
# gpu-figures.sh [--quick] [--software] [--device DEVICE] [--only TEXT]: measures impinge on this machine's CPU, its GPU
# and both at once; one table in Markdown, to standard output, progress to standard error. From a bundle, unpacked
# anywhere, or from a clone in which ./dev build release has run. docs/gpu-figures.md says what the table tells.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)

program=
for place in "$here/bin" "$here/../build/release/bin"; do
  if [ -x "$place/impinge-gpu-figures" ]; then
    program=$place/impinge-gpu-figures
    break
  fi
done
if [ -z "$program" ]; then
  printf 'gpu-figures: impinge-gpu-figures is neither in %s nor in the build; run ./dev build release first\n' \
    "$here/bin" >&2
  exit 2
fi

command=./$(basename "${BASH_SOURCE[0]}")
if [ "$here" != "${here%/scripts}" ]; then command=scripts/$(basename "${BASH_SOURCE[0]}"); fi
for word in "$@"; do command+=" $(printf '%q' "$word")"; done
IMPINGE_FIGURES_COMMAND=$command exec "$program" "$@"
