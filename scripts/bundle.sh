#!/usr/bin/env bash
# SPDX-FileCopyrightText: The impinge authors
# SPDX-License-Identifier: MIT
#
# scripts/bundle.sh [BUILD_DIR [FOLDER]]: what a release ships, to be unpacked anywhere on a Linux of the same
# processor: FOLDER/impinge-VERSION-linux-ARCH and the same as .tar.gz. From build/release to build/bundle unless said
# otherwise. The bundle has the libraries that a bare system lacks. It never has glibc, libstdc++ or libgcc_s, without
# whose own versions the host's GPU driver does not load, nor libvulkan, which belongs to that driver. It is unpacked
# elsewhere and tried out before this script ends well.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

fail() {
  printf 'bundle: %s\n' "$*" >&2
  exit 1
}

[ $# -le 2 ] || fail 'usage: scripts/bundle.sh [BUILD_DIR [FOLDER]]'
build=${1:-$root/build/release}
folder=${2:-$root/build/bundle}
for program in cli/impinge bin/impinge-import bin/impinge-gpu-figures; do
  [ -x "$build/$program" ] || fail "$build/$program is missing; build the preset release first"
done
[ -e "$root/build/page/report.html" ] || fail "$root/build/page/report.html is missing; './dev page' builds it"
[ -e "$root/build/ifc/import-ifc.cjs" ] || fail "$root/build/ifc/import-ifc.cjs is missing; './dev page' builds it"
for tool in cmake ldd readelf tar gzip; do
  command -v "$tool" >/dev/null || fail "$tool is missing"
done

version=$("$build/cli/impinge" --version | grep -oE '[0-9]+\.[0-9]+\.[0-9]+')
name=impinge-$version-linux-$(uname -m)
bundle=$folder/$name
readonly most_megabytes=60
readonly programs=(bin/impinge bin/impinge-gpu-figures libexec/impinge/impinge-import)

licences=$bundle/licenses
. "$root/scripts/libraries.sh"

rm -rf "$bundle" "$bundle.tar.gz"
mkdir -p "$licences"
cmake --install "$build" --prefix "$bundle" --component programs --strip >/dev/null
libdir=$(sed -n 's/^CMAKE_INSTALL_LIBDIR:[A-Z]*=//p' "$build/CMakeCache.txt")
# The importer first: it looks in the others' folder too, and would find there what the system is to be asked for.
bring_libraries "$bundle/libexec/impinge/impinge-import" "$bundle/libexec/impinge"
bring_libraries "$bundle/bin/impinge" "$bundle/$libdir"
bring_libraries "$bundle/bin/impinge-gpu-figures" "$bundle/$libdir"
for header in /usr/include/CLI/CLI.hpp /usr/include/nlohmann/json.hpp /usr/include/valijson/validator.hpp \
  /usr/include/utf8cpp/utf8.h /usr/include/eigen3/Eigen/Dense /usr/include/fmt/format.h /usr/include/volk.h /usr/include/vulkan/vulkan.h; do
  bring_licence "$header"
done
cp "$root/LICENSE" "$bundle/LICENSE"
mv "$bundle/libexec/impinge/web-ifc-license.md" "$licences/web-ifc.md"
install -m 755 "$root/scripts/gpu-figures.sh" "$bundle/gpu-figures.sh"

cat >"$bundle/README.md" <<README
# impinge $version

impinge finds every pair of triangles that touch between meshes, exactly. Unpack this folder anywhere; nothing needs to
be installed. It runs on a Linux ($(uname -m)) with glibc $(newest GLIBC "$bundle") or newer and a libstdc++ that has
GLIBCXX_$(newest GLIBCXX "$bundle").

    bin/impinge check FILE...     # which objects touch: OBJ, OFF, PLY, STL, glTF, 3MF, COLLADA and others, and IFC
    bin/impinge clash FILE... --html report.html   # which parts clash, and a page to look at it
    bin/impinge --help
    ./gpu-figures.sh              # measures the CPU, a GPU and both: one table, within minutes
    ./gpu-figures.sh --quick      # whether that works, within a minute

A GPU needs its maker's driver and the Vulkan loader, libvulkan.so.1, which are the system's: this folder has neither.
Without them impinge works on the CPU, with the same answers.

IFC needs Node.js 18 or newer as the command \`node\`, which is not in this folder. \`node\` runs libexec/impinge/import-ifc.cjs, which
contains web-ifc (MPL-2.0; its source: https://github.com/ThatOpen/engine_web-ifc).

Licence: MIT, see LICENSE. Those of the libraries within are in the folder licenses.
README

# --- whether it is as promised ------------------------------------------------------------------------------------------

# check_needs FILE FOLDER: every library that the file needs is in the folder or the host's.
check_needs() {
  local library
  while read -r library; do
    is_of_the_host "$library" || [ -f "$2/$library" ] ||
      fail "${1#"$bundle/"} needs $library, which is not in the bundle"
  done < <(needs_of "$1")
}

while read -r -d '' file; do
  base=$(basename "$file")
  case $base in libvulkan*.so*) fail "${file#"$bundle/"} must not be in the bundle" ;; esac
  if is_of_the_host "$base"; then fail "${file#"$bundle/"} must not be in the bundle"; fi
  if ! is_elf "$file"; then continue; fi
  case $file in
    "$bundle"/libexec/*) check_needs "$file" "$bundle/libexec/impinge" ;;
    *) check_needs "$file" "$bundle/$libdir" ;;
  esac
done < <(find "$bundle" -type f -print0)
[ -z "$(find "$bundle" -type l)" ] || fail 'there is a link in the bundle'

mkdir -p "$folder"
tar --create --sort=name --owner=0 --group=0 --numeric-owner --mtime="@${SOURCE_DATE_EPOCH:-$(date +%s)}" \
  --directory "$folder" "$name" | gzip -9n >"$bundle.tar.gz"
size=$(du -sm --apparent-size "$bundle" | cut -f1)
packed_size=$(du -sm --apparent-size "$bundle.tar.gz" | cut -f1)
[ "$size" -lt "$most_megabytes" ] || fail "the bundle has $size MB, and $most_megabytes are too many"

# Unpacked and used elsewhere.
elsewhere=$(mktemp -d)
trap 'rm -rf "$elsewhere"' EXIT
tar -xzf "$bundle.tar.gz" -C "$elsewhere"
cd "$elsewhere"
unset LD_LIBRARY_PATH IMPINGE_IMPORTER
for program in "${programs[@]}"; do
  readelf -d "$name/$program" | grep -qE '\((RUNPATH|RPATH)\).*\[\$ORIGIN' || fail "$program has no run path of its own"
  check_origin "$name/$program" "$elsewhere"
done

printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >flat.obj
printf 'v 0.2 0.2 -1\nv 0.2 0.2 1\nv 2 2 0\nf 1 2 3\n' >upright.obj
# The flat one again, as three points in base 64.
cat >flat.gltf <<'GLTF'
{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0,"name":"flat"}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}],
"bufferViews":[{"buffer":0,"byteLength":36}],
"buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]}
GLTF
# touches FILE FILE: the command says so, by status 1.
touches() {
  local status=0
  "$name/bin/impinge" check --quiet "$@" || status=$?
  [ "$status" -eq 1 ] || fail "'impinge check $*' ended with status $status, not 1"
}
said=$("$name/bin/impinge" --version)
case $said in *"$version"*) ;; *) fail "'impinge --version' says $said" ;; esac
touches flat.obj upright.obj
touches flat.gltf upright.obj
[ -s "$name/libexec/impinge/web-ifc-node.wasm" ] || fail 'the reader of IFC is missing'
"$name/bin/impinge" clash --quiet --fail-on inside flat.gltf upright.obj --html report.html --bcf report.bcf >report.txt ||
  fail "'impinge clash' ended with status $?"
grep -q 'id="report"' report.html || fail 'there is no report in the page'
"$name/gpu-figures.sh" --quick --only 'mutual motion' >figures.md
grep -q '^| paper: mutual motion' figures.md || fail 'gpu-figures.sh printed no table'

printf '%s\n%s.tar.gz\n%s MB, packed %s MB; tried out in another folder\n' "$bundle" "$bundle" "$size" "$packed_size"
