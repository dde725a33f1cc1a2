#!/usr/bin/env python3
# SPDX-FileCopyrightText: The impinge authors
# SPDX-License-Identifier: MIT
"""Whether the tests see the faults of mutants.txt.

All of them are built into one program, and IMPINGE_MUTANT chooses the one at work (mutant.hpp). In a copy of the tree, or one
with nothing uncommitted, which git can restore:

  tests/mutants/mutants.py check           whether each expression stands in its file just once
  tests/mutants/mutants.py apply           writes the mutants into the sources
  tests/mutants/mutants.py run [ID...]     builds them (after ./dev test), and runs the tests on some of them, or on all
  git checkout src io report cli           the sources as they were

The tests that are known to see a mutant run first, and if none of these fails the rest, but for those that read the
sources or build them anew. A test that fails without a mutant too does not count.
"""
import os
import re
import subprocess
import sys
import time
from pathlib import Path
from typing import NamedTuple

HERE = Path(__file__).resolve().parent
TREE = HERE.parent.parent
BUILDS = [TREE / "build" / name for name in ("checked", "release")]
READ_SOURCES = "^house"  # and some of these build them


class Mutant(NamedTuple):
    id: int
    file: str
    original: str
    mutated: str
    tests: str
    words: str


def table():
    lines = (HERE / "mutants.txt").read_text().splitlines()
    rows = [line.split(" | ") for line in lines if line and not line.startswith("#")]
    return [Mutant(int(row[0]), *(cell.strip() for cell in row[1:])) for row in rows]


def check():
    bad = [m for m in table() if (TREE / m.file).read_text().count(m.original) != 1]
    for m in bad:
        print(f"{m.id}: {m.file} does not have '{m.original}' once")
    if bad:
        sys.exit(1)


def choice(m):
    """Between the two, as an expression, or as a statement if they end in a semicolon."""
    if m.original.endswith(";"):
        return f"if (::impinge_mutant == {m.id}) {{ {m.mutated} }} else {{ {m.original} }}"
    return f"(::impinge_mutant == {m.id} ? ({m.mutated}) : ({m.original}))"


def apply():
    check()
    for name in {m.file for m in table()}:
        text = (TREE / name).read_text()
        for m in table():
            if m.file == name:
                text = text.replace(m.original, choice(m))
        (TREE / name).write_text(f'#include "{HERE}/mutant.hpp"\n{text}')


def failed(build, mutant, *choice):
    """The tests that failed, and how."""
    command = ["ctest", "--test-dir", build, "--stop-on-failure", "-j2", "-LE", "thorough", *choice]
    environment = os.environ | {"IMPINGE_MUTANT": str(mutant)}
    done = subprocess.run(command, env=environment, capture_output=True, text=True)
    found = dict(re.findall(r"^\s*\d+ - (\S+) \((.*?)\)", done.stdout, re.MULTILINE))
    if done.returncode != 0 and not found:
        sys.exit(f"{' '.join(command)}: {done.stderr}")
    return found


class Runner:
    def __init__(self):
        self.passes = {}  # without a mutant, by test

    def killers(self, mutant, choice, never):
        """Tests that fail, but would not without the mutant."""
        for build in BUILDS:
            while True:
                broken = [f"^{test}$" for test, passes in self.passes.items() if not passes]
                found = failed(build, mutant, *choice, "-E", "|".join([never, *broken]))
                for test in found.keys() - self.passes.keys():
                    self.passes[test] = not failed(build, 0, "-R", f"^{test}$")
                    if not self.passes[test]:
                        print(f"{test} fails without a mutant too", flush=True)
                if not found:
                    break
                if any(self.passes[test] for test in found):
                    return [f"{test} ({how})" for test, how in found.items() if self.passes[test]]
        return []

    def run(self, m):
        start = time.monotonic()
        by = self.killers(m.id, ["-R", m.tests], READ_SOURCES) or self.killers(m.id, [], f"{READ_SOURCES}|{m.tests}")
        what = f"killed by {', '.join(by)}" if by else "SURVIVED"
        print(f"{m.id:2} {what}, {time.monotonic() - start:.1f} s: {m.file}, {m.words}", flush=True)


def main():
    verb, *ids = sys.argv[1:] or [""]
    if verb == "run":
        for build in BUILDS:
            subprocess.run(["cmake", "--build", build, "--target", "impinge_tests"], check=True)
        runner = Runner()
        for m in table():
            if not ids or str(m.id) in ids:
                runner.run(m)
    elif verb in ("check", "apply"):
        {"check": check, "apply": apply}[verb]()
    else:
        sys.exit(__doc__)


if __name__ == "__main__":
    main()
