#!/usr/bin/env bash
# SPDX-FileCopyrightText: The impinge authors
# SPDX-License-Identifier: MIT
#
# scripts/picture.sh [PROGRAM]: takes the pictures in the README anew. docs/report.png is the report of the engine with its deepest clash
# chosen; docs/notebook.png two cells of examples/assembly.ipynb, run by Debian's jupyter-nbconvert and python3-ipykernel with the Python
# package that ./dev test installs. PROGRAM is the command line, build/release's unless said otherwise; ./dev page and ./dev demo build
# what else it needs.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
program=${1:-$root/build/release/cli/impinge}
engine=/usr/share/assimp/models/glTF2/2CylinderEngine-glTF-Binary/2CylinderEngine.glb
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"$program" clash "$engine" --html "$folder/report.html" --quiet || [ $? -eq 1 ]
python=$root/build/python/bin/python
# The kernel is that of Debian, which does not know the environment.
PYTHONPATH=$(cd / && "$python" -c 'import impinge, os; print(os.path.dirname(os.path.dirname(impinge.__file__)))')
export PYTHONPATH PYDEVD_DISABLE_FILE_VALIDATION=1
"$python" -m nbconvert --to html --execute --log-level ERROR --HTMLExporter.mathjax_url= \
  --HTMLExporter.require_js_url= --output-dir "$folder" "$root/examples/assembly.ipynb"
cd "$root/page"
node picture.mjs "$folder/report.html" "$root/docs/report.png" '#clash=1'
node notebook-picture.mjs "$folder/assembly.html" "$root/docs/notebook.png" 'find_clashes(scene, clear' 'clashes.show'
