#!/bin/sh
# SPDX-FileCopyrightText: The impinge authors
# SPDX-License-Identifier: MIT
#
# Puts the meshes of Debian's libcgal-demo (about 100 in OFF, PLY and STL) into FOLDER/cgal/data/meshes, FOLDER being
# .data beside this repository's README unless given. Needs neither root nor the package installed: slim systems drop
# /usr/share/doc, where its archive lies, so the package is downloaded and unpacked here. Does nothing when they are there.
set -eu

if [ "${1:-}" = "--help" ]; then
  echo "usage: scripts/fetch_data.sh [FOLDER]"
  exit 0
fi
folder=${1:-$(cd "$(dirname "$0")/.." && pwd)/.data}
meshes=$folder/cgal/data/meshes

if [ -f "$folder/cgal/complete" ]; then
  echo "fetch_data: $meshes is there."
  exit 0
fi
for tool in apt-get dpkg tar gzip; do
  if ! command -v "$tool" > /dev/null; then
    echo "fetch_data: $tool is missing: this script needs a Debian system. Put libcgal-demo's data.tar.gz, unpacked, into" \
      "$folder/cgal and create the empty file $folder/cgal/complete." >&2
    exit 2
  fi
done

mkdir -p "$folder"
work=$(mktemp -d "$folder/fetch.XXXXXX")
trap 'rm -rf "$work"' EXIT INT TERM

echo "fetch_data: downloading Debian's libcgal-demo (24 MB)"
if ! (cd "$work" && apt-get -qq download libcgal-demo 2> apt.log); then
  cat "$work/apt.log" >&2
  echo "fetch_data: apt-get could not download libcgal-demo: run 'apt-get update' and check the network." >&2
  exit 2
fi
echo "fetch_data: unpacking its meshes into $meshes"
dpkg -x "$work"/libcgal-demo_*.deb "$work/package"
mkdir "$work/cgal"
tar -xzf "$work/package/usr/share/doc/libcgal-dev/data.tar.gz" -C "$work/cgal" data/meshes
touch "$work/cgal/complete"
rm -rf "$folder/cgal"
mv "$work/cgal" "$folder/cgal"
echo "fetch_data: $(ls "$meshes" | wc -l) files in $meshes"
