#!/usr/bin/env bash
# SPDX-FileCopyrightText: The impinge authors
# SPDX-License-Identifier: MIT
#
# dev_script_test.sh SOURCE: ./dev teaches its verbs, and refuses what it does not know with a sentence and status 2,
# before it looks for packages or builds anything.
set -u
dev=$1/dev
failures=0

fail() {
  echo "FAILED: $*"
  failures=$((failures + 1))
}

help=$("$dev" --help) || fail '--help does not end with status 0'
for words in './dev demo' './dev test' './dev test --all' './dev build' './dev bench' './dev bundle' './dev wheel' './dev docs' './dev format' 'README.md'; do
  case $help in
    *"$words"*) ;;
    *) fail "--help does not speak of '$words'" ;;
  esac
done

# refuses WORD ARGUMENT...: status 2, nothing on standard output, a sentence with the word on standard error.
refuses() {
  local word=$1 out err status=0
  shift
  out=$("$dev" "$@" 2>/dev/null </dev/null) || status=$?
  err=$("$dev" "$@" 2>&1 >/dev/null </dev/null)
  [ "$status" -eq 2 ] || fail "'dev $*' ends with status $status, not 2"
  [ -z "$out" ] || fail "'dev $*' prints on standard output: $out"
  case $err in
    *"$word"*'--help'*) ;;
    *) fail "'dev $*' does not name '$word' and --help: $err" ;;
  esac
}
refuses 'no verb'
refuses frobnicate frobnicate
refuses --fast test --fast
refuses extra test --all extra
refuses nowhere build nowhere
refuses extra build dev extra
refuses 'here' demo here
refuses --slow bench --slow
refuses extra bundle extra
refuses extra wheel extra
refuses extra docs extra
refuses --fix format --fix

[ "$failures" -eq 0 ] && echo 'all as promised'
exit "$((failures > 0))"
