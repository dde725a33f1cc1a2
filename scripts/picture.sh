#!/usr/bin/env bash
# SPDX-FileCopyrightText: The impinge authors
# SPDX-License-Identifier: MIT
#
# scripts/picture.sh [PROGRAM]: takes docs/report.png anew, the picture in the README: the report of the engine with its
# deepest clash chosen. PROGRAM is the command line, build/release's unless said otherwise; ./dev page and ./dev demo
# build what it needs.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
program=${1:-$root/build/release/cli/impinge}
engine=/usr/share/assimp/models/glTF2/2CylinderEngine-glTF-Binary/2CylinderEngine.glb
report=$(mktemp --suffix=.html)
trap 'rm -f "$report"' EXIT
: >"$report"
"$program" clash "$engine" --html "$report" --quiet || [ $? -eq 1 ]
cd "$root/page"
node picture.mjs "$report" "$root/docs/report.png" '#clash=1'
