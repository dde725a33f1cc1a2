#!/usr/bin/env bash
# SPDX-FileCopyrightText: The impinge authors
# SPDX-License-Identifier: MIT
#
# command_line_test.sh PROGRAM MODELS LAVAPIPE: the command line with a device, with a wrong one, and with none.
set -euo pipefail
program=$1 engine=$2/glTF2/2CylinderEngine-glTF-Binary/2CylinderEngine.glb driver=$3
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
export XDG_CACHE_HOME=$folder/cache VK_ICD_FILENAMES=$driver VK_DRIVER_FILES=$driver
fail() {
  echo "$*" >&2
  exit 1
}
# status WANTED COMMAND...
status() {
  local wanted=$1 found=0
  shift
  "$@" >"$folder/out" 2>"$folder/err" || found=$?
  [ "$found" = "$wanted" ] || fail "$* ended with $found instead of $wanted: $(cat "$folder/out" "$folder/err")"
}
says() { grep -q -- "$2" "$folder/$1" || fail "expected '$2' in: $(cat "$folder/$1")"; }
hash_of() { grep -o '"hash":"[0-9a-f]*"' "$1"; }

status 0 "$program" devices
says out llvmpipe
says out 'software on the CPU'
says out 'tried out'
status 0 env IMPINGE_DEVICE=0 "$program" devices

status 1 "$program" check "$engine" --quiet --backend paper --json "$folder/paper.json"
for way in '--backend gpu' '--backend gpu --device LLVMpipe' '--backend hybrid' '--backend hybrid --device-share 0.5' \
  '--backend hybrid --device-share 1' '--backend raster' '--backend auto'; do
  # shellcheck disable=SC2086
  status 1 "$program" check "$engine" --quiet $way --json "$folder/other.json"
  [ "$(hash_of "$folder/paper.json")" = "$(hash_of "$folder/other.json")" ] || fail "$way: another hash"
done
status 1 "$program" check "$engine" --backend hybrid --device-share 0.5 --stats
says out 'device '
says out 'CPU beside it'

# What was measured is kept, and a file that was meddled with does no harm.
[ -s "$folder/cache/impinge/calibration" ] || fail 'nothing was kept'
head -c 4000 /dev/urandom >"$folder/cache/impinge/calibration"
status 1 "$program" check "$engine" --quiet --backend hybrid --device-share 0.5 --stats
grep -q '^impinge calibration' "$folder/cache/impinge/calibration" || fail 'the calibration was not written anew'

status 2 "$program" check "$engine" --backend gpu --device voodoo
says err "no device 'voodoo'"
says err llvmpipe
status 2 env IMPINGE_DEVICE=9 "$program" check "$engine" --backend hybrid
says err IMPINGE_DEVICE
status 1 env IMPINGE_DEVICE=none "$program" check "$engine" --backend hybrid --device-share 1
says err "IMPINGE_DEVICE is 'none'"

export VK_ICD_FILENAMES=/nonexistent.json VK_DRIVER_FILES=/nonexistent.json
status 2 "$program" devices
says err 'no driver'
status 1 "$program" check "$engine" --backend gpu --json "$folder/none.json"
says err 'the CPU does all the work'
[ "$(hash_of "$folder/paper.json")" = "$(hash_of "$folder/none.json")" ] || fail 'another hash without a device'
status 1 "$program" check "$engine" --backend gpu --quiet
[ ! -s "$folder/err" ] || fail "--quiet is not: $(cat "$folder/err")"
