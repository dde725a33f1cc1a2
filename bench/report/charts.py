# SPDX-FileCopyrightText: The impinge authors
# SPDX-License-Identifier: MIT
"""The page's charts, as SVG. Colours are Okabe and Ito's, which colour-blind readers tell apart; each
library has its marker as well."""
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

from data import digits, grouped, number
from page_tables import PAPER_OWN, PAPER_RAPID
from targets import TARGETS

# library: colour, marker, line
STYLES = {
    "impinge": ("#0072B2", "o", "-"),
    "impinge paper": ("#56B4E9", "o", "--"),
    "impinge raster": ("#000000", "o", ":"),
    "impinge gpu": ("#0072B2", "*", ":"),
    "impinge hybrid": ("#56B4E9", "*", "-."),
    "FCL": ("#D55E00", "s", "-"),
    "FCL same flags": ("#D55E00", "s", ":"),
    "FCL native": ("#E69F00", "s", "--"),
    "RAPID": ("#000000", "X", "-"),
    "Embree query alone": ("#009E73", "^", "-"),
    "Embree with refit": ("#009E73", "v", "--"),
    "CGAL query alone": ("#CC79A7", "D", "-"),
}
LABELS = {"impinge paper": "impinge, the paper's way", "impinge raster": "impinge, image space",
          "impinge gpu": "impinge on a GPU", "impinge hybrid": "impinge, CPU and GPU", "FCL": "FCL, OBB tree",
          "FCL same flags": "FCL, compiled as impinge is", "FCL native": "FCL, compiled for this machine",
          "Embree query alone": "Embree, query alone", "Embree with refit": "Embree, with refit",
          "CGAL query alone": "CGAL, exact kernel, query alone"}

plt.rcParams.update({
    "font.size": 10, "axes.titlesize": 11, "axes.spines.top": False, "axes.spines.right": False, "axes.grid": True,
    "grid.color": "#dddddd", "grid.linewidth": 0.6, "axes.axisbelow": True, "figure.facecolor": "white",
    "savefig.facecolor": "white", "legend.frameon": False, "svg.hashsalt": "impinge", "svg.fonttype": "none", "lines.linewidth": 1.8,
    "lines.markersize": 5,
})


def save(figure, folder, name):
    # Without a date the same figures give the same files.
    figure.savefig(folder / f"{name}.svg", metadata={"Date": None}, bbox_inches="tight")
    plt.close(figure)


def short(value, _=None):
    """1k, 10k, 1M on an axis of triangles; 0.01, 10 on one of milliseconds."""
    for size, letter in ((1e6, "M"), (1e3, "k")):
        if value >= size:
            return f"{value / size:g}{letter}"
    return f"{value:g}"


def logarithmic(axes, x=True, y=True):
    """After plotting: ticks at 1, 2 and 5 where powers of ten would be too few."""
    for wanted, scale, axis, limits in ((x, axes.set_xscale, axes.xaxis, axes.get_xlim),
                                        (y, axes.set_yscale, axes.yaxis, axes.get_ylim)):
        if not wanted:
            continue
        scale("log")
        low, high = limits()
        axis.set_major_locator(LogLocator(subs=(1,) if high / low > 150 else (1, 2, 5)))
        axis.set_major_formatter(FuncFormatter(short))
        axis.set_minor_formatter(NullFormatter())


def line(axes, library, points, **more):
    color, marker, style = STYLES[library]
    style = {"color": color, "marker": marker, "linestyle": style, "label": LABELS.get(library, library), **more}
    axes.plot([x for x, _ in points], [y for _, y in points], **style)


def legend_below(figure, axes, columns):
    handles, labels = axes.get_legend_handles_labels()
    figure.legend(handles, labels, loc="upper center", bbox_to_anchor=(0.5, 0.0), ncol=columns)


def paper(tables, folder):
    """As the paper's Figure 5: average detection time over the number of triangles."""
    figure, (then, now) = plt.subplots(1, 2, figsize=(10, 4.2), constrained_layout=True)
    triangles = [int(t) for t in PAPER_RAPID]
    then.plot(triangles, list(PAPER_RAPID.values()), color="#D55E00", marker="s", label="RAPID")
    then.plot(triangles, list(PAPER_OWN.values()), color="#0072B2", marker="o", label="the paper's method")
    then.set_title("The paper's Figure 5 (Core 2 Quad, Radeon HD 5750)")
    then.legend(loc="upper left")
    rows = tables.rows("paper")
    for library in STYLES:
        points = [(number(row["triangles"]), number(row["ms"])) for row in rows if row["library"] == library]
        if points:
            label = {"FCL": "FCL, OBB tree (in RAPID's place)"}.get(library, LABELS.get(library, library))
            line(now, library, points, label=label)
    now.set_title("The same experiment here, one thread")
    now.legend(loc="upper left", fontsize=8.5)
    now.set_ylim(top=1.4 * max(number(row["ms"]) for row in rows))
    for axes in (then, now):
        axes.set_ylim(bottom=0)
        axes.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:,.0f}"))
        axes.set_xlabel("triangles of each body")
        axes.set_ylabel("T = t / C, milliseconds a detection")
    save(figure, folder, "paper_figure_5")


def pairs(tables, folder):
    cases = ["near miss", "light", "deep"]
    shapes = [shape for (shape,), _ in grouped(tables.rows("pairs"), "shape")]
    figure, grid = plt.subplots(len(shapes), 3, figsize=(11, 3.6 * len(shapes)), sharey=True, sharex=True,
                                squeeze=False, constrained_layout=True)
    for shape, row_of_axes in zip(shapes, grid):
        for case, axes in zip(cases, row_of_axes):
            for library in STYLES:
                rows = tables.rows("pairs", shape=shape, case=case, library=library)
                knots = [row for row in rows if row["mesh"] == "torus knot"]
                others = [row for row in rows if row["mesh"] != "torus knot"]
                points = [[(number(r["triangles"]), number(r["ms"])) for r in of] for of in (knots, others)]
                if points[0]:
                    line(axes, library, points[0])
                if points[1]:
                    line(axes, library, points[1], linestyle="none", alpha=0.5, label=None)
            logarithmic(axes)
            axes.set_title(f"{shape}, {case}")
    for axes in grid[:, 0]:
        axes.set_ylabel("milliseconds a query")
    for axes in grid[-1]:
        axes.set_xlabel("triangles of each body")
    legend_below(figure, grid[0][1], 4)
    save(figure, folder, "pairs")


def speedups(tables, folder):
    """The ratios among the targets, with the spread over meshes, and what they were to be."""
    measured = [(target, target.measure(tables)) for target in TARGETS if target.unit == "x"]
    measured = [(target, result) for target, result in measured if result is not None]
    figure, axes = plt.subplots(figsize=(9, 0.52 * len(measured) + 1.2), constrained_layout=True)
    for place, (target, result) in enumerate(reversed(measured)):
        axes.plot([result.low, result.high], [place, place], color="#0072B2", alpha=0.35, linewidth=5,
                  solid_capstyle="round")
        axes.plot(result.value, place, "o", color="#0072B2", markersize=8)
        axes.annotate(f"{digits(result.value)}x", (result.value, place), xytext=(0, 9), textcoords="offset points",
                      ha="center", fontsize=9, bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.8})
        for bound, style in ((target.must, "-"), (target.stretch, ":")):
            axes.plot([bound, bound], [place - 0.3, place + 0.3], color="#333333", linestyle=style, linewidth=1.6)
    axes.plot([], [], "o", color="#0072B2", label="geometric mean (bar: lowest to highest mesh)")
    axes.plot([], [], color="#333333", label="must")
    axes.plot([], [], color="#333333", linestyle=":", label="stretch")
    axes.set_yticks(range(len(measured)), [target.name for target, _ in reversed(measured)])
    logarithmic(axes, y=False)
    axes.axvline(1, color="#999999", linewidth=1)
    axes.set_ylim(-0.6, len(measured) - 0.2)
    axes.grid(axis="y", visible=False)
    axes.set_xlabel("times impinge's time")
    legend_below(figure, axes, 3)
    save(figure, folder, "targets")


def draw_all(tables, folder):
    folder.mkdir(parents=True, exist_ok=True)
    for draw in (paper, pairs, speedups):
        draw(tables, folder)
