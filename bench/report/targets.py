# SPDX-FileCopyrightText: The impinge authors
# SPDX-License-Identifier: MIT
"""The targets that the project set itself, each with its number, computed from the tables and from nothing else."""
from dataclasses import dataclass
from typing import Callable, Optional

from data import digits, geometric_mean, grouped, markdown, number, slope

# What was tried for a target that is missed; shown only while it is. By the target's name.
NOTES = {
    "the same, FCL compiled for this machine":
        "beyond the target, which is the package: docs/performance.md lists what was tried for first contact",
}


@dataclass
class Measured:
    value: float
    low: Optional[float] = None  # the lowest and the highest single mesh or repeat
    high: Optional[float] = None
    of: str = ""  # what the value and its spread are over


@dataclass
class Target:
    name: str
    must: float
    stretch: float
    measure: Callable  # Tables -> Measured, or None where this run did not measure it
    unit: str = "x"
    more_is_better: bool = True
    extra: bool = False  # not among the targets; shown beside the one before it

    def reached(self, value, bound):
        return value >= bound if self.more_is_better else value <= bound

    def verdict(self, measured):
        if measured is None:
            return "not measured"
        if self.reached(measured.value, self.stretch):
            return "met, stretch too"
        return "met" if self.reached(measured.value, self.must) else "**missed**"


def mean_of(values, of):
    values = list(values)
    return Measured(geometric_mean(values), min(values), max(values), of) if values else None


def pair_ratio(library, *cases):
    def measure(tables):
        rows = [row for row in tables.rows("pairs", shape="compact", library=library) if row["case"] in cases]
        return mean_of((number(row["ratio"]) for row in rows), f"{len(rows)} mesh and depth pairs")

    return measure


def touching_ratio(tables):
    rows = tables.rows("touching", library="CGAL query alone")
    return mean_of((number(row["ratio"]) for row in rows), f"{len(rows)} families")


def build_ratio(library):
    def measure(tables):
        if not tables.rows("build", library="impinge"):
            return None
        rows = tables.rows("build", library=library)
        return mean_of((number(row["ratio"]) for row in rows), f"{len(rows)} meshes")

    return measure


def bytes_a_triangle(tables):
    values = [number(row["beyond_the_input_bytes_a_triangle"]) for row in tables.rows("build", library="impinge")]
    return mean_of(values, f"{len(values)} meshes") if values and min(values) > 0 else None


def thread_share(tables):
    rows = tables.rows("threads")
    worst = min(rows, key=lambda row: number(row["share"]))
    return Measured(number(worst["share"]), number(worst["share_low"]), number(worst["share_high"]),
                    f"repeats of the worse one: {worst['work']}")


def one_shot(column):
    def measure(tables):
        rows = [row for row in tables.rows("one_shot", library="impinge", threads="2")
                if number(row["triangles_each"]) > 6.5e6 and number(row["pairs"]) > 1e7]
        return Measured(number(rows[0][column]), of=f"{rows[0]['pairs']} pairs") if rows else None

    return measure


def growth_slope(tables):
    rows = tables.rows("growth", grows="triangles", library="impinge")
    return Measured(slope([(number(row["triangles"]), number(row["ms"])) for row in rows]),
                    of=f"{rows[0]['triangles']} to {rows[-1]['triangles']} triangles")


def broad_phase(tables):
    rows = tables.rows("bodies", bodies="10000", library="impinge")
    return Measured(number(rows[0]["broad_ms"]), of=f"{rows[0]['frames']} frames, median")


CONTACT = ("light", "deep")
FIRST = ("first contact near miss", "first contact light")
TARGETS = [
    Target("light and deep against FCL OBB", 10, 16, pair_ratio("FCL", *CONTACT)),
    Target("the same, FCL compiled for this machine", 10, 16, pair_ratio("FCL native", *CONTACT), extra=True),
    Target("near miss against FCL OBB", 5, 10, pair_ratio("FCL", "near miss")),
    Target("the same, FCL compiled for this machine", 5, 10, pair_ratio("FCL native", "near miss"), extra=True),
    Target("first contact against FCL OBB", 5, 8, pair_ratio("FCL", *FIRST)),
    Target("the same, FCL compiled for this machine", 5, 8, pair_ratio("FCL native", *FIRST), extra=True),
    Target("light and deep against Embree's query alone", 2.5, 4, pair_ratio("Embree query alone", *CONTACT)),
    Target("light and deep against Embree with its refit", 10, 20, pair_ratio("Embree with refit", *CONTACT)),
    Target("light and deep against CGAL's exact tree", 35, 60, pair_ratio("CGAL query alone", *CONTACT)),
    Target("touching families against CGAL's exact tree", 5, 20, touching_ratio),
    Target("build of a full tree against FCL OBB", 4, 8, build_ratio("FCL")),
    Target("the same, FCL compiled for this machine", 4, 8, build_ratio("FCL native"), extra=True),
    Target("what a Mesh holds beyond vertices and indices", 128, 80, bytes_a_triangle, "bytes a triangle", False),
    Target("2 threads, of what an independent loop scales to", 0.9, 0.95, thread_share, ""),
    Target("one-shot, 2 x 7 million triangles, 2 threads", 15, 8, one_shot("seconds"), "s", False),
    Target("the same, peak memory of the process", 6, 4, one_shot("peak_GB"), "GB", False),
    Target("slope with triangles at fixed contacts", 0.25, 0.15, growth_slope, "", False),
    Target("10,000 slowly moving bodies, broad phase a frame", 1, 0.5, broad_phase, "ms", False),
]


def with_unit(value, unit):
    return f"{value}{unit}" if unit == "x" else f"{value} {unit}".rstrip()


def measured_cell(target, measured):
    if measured is None:
        return "-", "-"
    spread = measured.of
    if measured.low is not None:
        spread = f"{digits(measured.low)} to {digits(measured.high)} over {measured.of}"
    return with_unit(digits(measured.value), target.unit), spread


def target_table(tables):
    rows = []
    for target in TARGETS:
        measured = target.measure(tables)
        value, spread = measured_cell(target, measured)
        verdict = target.verdict(measured)
        note = NOTES.get(target.name, "") if "missed" in verdict else ""
        name = f"*{target.name}*" if target.extra else target.name
        rows.append([name, with_unit(target.must, target.unit), with_unit(target.stretch, target.unit), value, verdict,
                     spread, note])
    return markdown(["what", "must", "stretch", "measured", "verdict", "spread", "what was tried"], rows)
