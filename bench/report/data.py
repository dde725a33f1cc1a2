# SPDX-FileCopyrightText: The impinge authors
# SPDX-License-Identifier: MIT
"""The benchmarks' CSV files, and figures in the form that the page shows."""
import csv
import math
from pathlib import Path


class Tables:
    """The CSV files of a folder, each a list of rows (dicts of strings)."""

    def __init__(self, folder):
        self.folder = Path(folder)

    def rows(self, name, **wanted):
        with open(self.folder / f"{name}.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        return [row for row in rows if all(row[key] == value for key, value in wanted.items())]

    def columns(self, name):
        with open(self.folder / f"{name}.csv", newline="") as file:
            return next(csv.reader(file))


def number(text):
    return float(text)


def geometric_mean(values):
    values = list(values)
    return math.exp(sum(math.log(v) for v in values) / len(values))


def slope(points):
    """Of the straight line through (x, y) in logarithms, by least squares."""
    xs, ys = [math.log(x) for x, _ in points], [math.log(y) for _, y in points]
    mean_x, mean_y = sum(xs) / len(xs), sum(ys) / len(ys)
    return sum((x - mean_x) * (y - mean_y) for x, y in zip(xs, ys)) / sum((x - mean_x) ** 2 for x in xs)


def digits(value, significant=3):
    """Three significant digits, never in powers of ten."""
    if value == 0:
        return "0"
    whole = math.floor(math.log10(abs(value))) + 1
    return f"{value:.{max(0, significant - whole)}f}"


def grouped(rows, *keys):
    """Rows that agree in `keys`, in order of appearance: [(values, rows)]."""
    groups = {}
    for row in rows:
        groups.setdefault(tuple(row[key] for key in keys), []).append(row)
    return list(groups.items())


def by_library(rows):
    return {row["library"]: row for row in rows}


def markdown(columns, rows):
    def line(cells):
        return "| " + " | ".join(str(cell) for cell in cells) + " |"

    return "\n".join([line(columns), line(["---"] * len(columns)), *(line(row) for row in rows)])
