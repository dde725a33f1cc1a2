#!/usr/bin/env bash
# SPDX-FileCopyrightText: The impinge authors
# SPDX-License-Identifier: MIT
#
# scripts/wheel.sh WHEEL FOLDER: the wheel that `pip wheel` made, as one for any Linux of the same processor, in FOLDER. The
# libraries that a bare system lacks go into it, under names that no other package's library has, with their licences; never
# glibc, libstdc++ or libgcc_s. The importer's stay out: glTF, 3MF and what else assimp reads need the system's libassimp.so.5
# and lib3MF.so.1. The wheel is tried out in a new environment before this script ends well.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

fail() {
  printf 'wheel: %s\n' "$*" >&2
  exit 1
}

[ $# -eq 2 ] || fail 'usage: scripts/wheel.sh WHEEL FOLDER'
wheel=$(realpath "$1")
mkdir -p "$2"
folder=$(realpath "$2")
python=${PYTHON:-/usr/bin/python3}
for tool in ldd patchelf readelf strip sha256sum; do
  command -v "$tool" >/dev/null || fail "$tool is missing"
done

# What manylinux_2_34 (PEP 600) allows: the libraries of AlmaLinux 9.
readonly platform=manylinux_2_34_$(uname -m)
readonly newest_allowed=(GLIBC 2.34 GLIBCXX 3.4.29 CXXABI 1.3.13)
readonly most_megabytes=12

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$scratch"
"$python" -m wheel unpack --dest unpacked "$wheel" >/dev/null
tree=$(echo "$scratch"/unpacked/*)
package=$tree/impinge
libraries=$tree/impinge.libs
info=$(echo "$tree"/*.dist-info)
licences=$info/licenses
mkdir -p "$licences" "$scratch/packed"
. "$root/scripts/libraries.sh"

[ -s "$package/report.html" ] || fail "the page is not in $wheel; run './dev page', and build it again"
rm -f "$package"/*ifc*  # of no use without the importer's libraries
chmod 755 "$tree"/*.data/scripts/impinge "$package/impinge" "$package/impinge-import"  # `wheel unpack` drops it
programs=("$package"/_core.*.so "$package/impinge")
for program in "${programs[@]}"; do bring_libraries "$program" "$libraries"; done
strip --strip-unneeded "${programs[@]}" "$package/impinge-import" "$libraries"/*

# Names of their own, by their content: the loader takes any library of that name that the process has loaded before.
renamed=()
for library in "$libraries"/*; do
  name=$(basename "$library")
  own=${name%%.so*}-$(sha256sum "$library" | head -c 8).so${name#*.so}
  mv "$library" "$libraries/$own"
  patchelf --set-soname "$own" "$libraries/$own"
  renamed+=(--replace-needed "$name" "$own")
done
for file in "${programs[@]}" "$libraries"/*; do
  case $file in
    "$package"/*) run_path=\$ORIGIN/../impinge.libs ;;
    *) run_path=\$ORIGIN ;;
  esac
  patchelf "${renamed[@]}" "$file"
  patchelf --force-rpath --set-rpath "$run_path" "$file"  # not in one with the above: patchelf 0.14 spoils the file
done

for ((i = 0; i < ${#newest_allowed[@]}; i += 2)); do
  kind=${newest_allowed[i]} allowed=${newest_allowed[i + 1]}
  asked=$(newest "$kind" "$tree")
  [ "$(printf '%s\n' "$asked" "$allowed" | sort -V | tail -n 1)" = "$allowed" ] ||
    fail "something in the wheel asks for ${kind}_$asked; $platform has $allowed at most"
done
sed -i "s/^\(Tag: .*\)-linux_.*$/\1-$platform/" "$info/WHEEL"
"$python" -m wheel pack --dest-dir packed "$tree" >/dev/null
made=$(echo packed/*.whl)
size=$(stat -c %s "$made")
[ "$size" -lt $((most_megabytes * 1000000)) ] || fail "the wheel has $size bytes, and $most_megabytes MB are too many"

# --- whether it is as promised ------------------------------------------------------------------------------------------

# An environment without the system's packages. Where there is no index, numpy is lent by the interpreter that builds.
"$python" -m venv --without-pip bare
mkdir lent
ln -s "$("$python" -c 'import numpy; print(numpy.__path__[0])')" lent/numpy
site=$(bare/bin/python -c 'import sysconfig; print(sysconfig.get_path("purelib"))')
echo "$scratch/lent" >"$site/lent.pth"
"$python" -m pip --python bare/bin/python install --quiet --no-index --no-deps "$made" || fail 'pip does not install the wheel'
unset LD_LIBRARY_PATH PYTHONPATH IMPINGE_IMPORTER IMPINGE_PAGE
export HOME=$scratch
rm -rf unpacked

bare/bin/python - "$site" <<'PYTHON' || fail 'the package does not work'
import re
import sys
import impinge

flat = ([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
upright = ([[0.2, 0.2, -1], [0.2, 0.2, 1], [2, 2, 0]], [[0, 1, 2]])
contacts = impinge.collide(flat, upright)
assert contacts.pairs.tolist() == [[0, 0]] and contacts.kinds.tolist() == [impinge.Kind.CROSSING], contacts
assert impinge.__file__.startswith(sys.argv[1]), impinge.__file__
mapped = {line.split()[-1] for line in open("/proc/self/maps") if re.search(r"/lib(tbb|hwy)", line)}
assert len(mapped) >= 2 and all(path.startswith(sys.argv[1]) for path in mapped), mapped
PYTHON
for program in "$site"/impinge/_core.*.so "$site/impinge/impinge"; do check_origin "$program" "$site"; done
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >flat.obj
printf 'v 0.2 0.2 -1\nv 0.2 0.2 1\nv 2 2 0\nf 1 2 3\n' >upright.obj
status=0
bare/bin/impinge check --quiet flat.obj upright.obj || status=$?
[ "$status" -eq 1 ] || fail "'impinge check' ended with status $status, not 1"
bare/bin/impinge clash --quiet --fail-on inside flat.obj upright.obj --html report.html >/dev/null ||
  fail "'impinge clash' ended with status $?"
grep -q 'id="report"' report.html || fail 'there is no report in the page'

mv "$made" "$folder"
printf '%s\n%s bytes; tried out in a new environment\n' "$folder/$(basename "$made")" "$size"
