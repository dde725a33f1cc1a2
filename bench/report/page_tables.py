# SPDX-FileCopyrightText: The impinge authors
# SPDX-License-Identifier: MIT
"""The page's tables, by the name that stands in it. A name that is not here is a CSV file shown as it is."""
from data import by_library, digits, geometric_mean, grouped, markdown, number, slope
from targets import target_table

DEVICE_BACKENDS = ["impinge raster", "impinge gpu", "impinge hybrid"]
LIBRARIES = ["impinge", "impinge paper", *DEVICE_BACKENDS, "FCL", "FCL same flags", "FCL native", "RAPID",
             "Embree query alone", "Embree with refit", "CGAL query alone"]

# The paper's Table 1, in milliseconds, on its own machine: an Intel Core 2 Quad Q8200 with a Radeon HD 5750.
PAPER_RAPID = {"968": 4.1620, "3162": 7.6131, "5200": 11.0231, "7590": 14.4713, "9612": 18.3837}
PAPER_OWN = {"968": 3.9716, "3162": 6.5753, "5200": 9.5957, "7590": 11.7126, "9612": 13.2147}


def ratio_cell(row):
    return f"{row['ms']} ({row['ratio']})" if row else "-"


def disagreement_cell(rows):
    missed, added = (sum(int(row[column]) for row in rows) for column in ("missed", "added"))
    wrong = sum(int(row.get("wrong_answers", row.get("wrong_object_pairs"))) for row in rows)
    return ("0" if missed == added == 0 else f"−{missed} +{added}") + (f" ({wrong})" if wrong else "")


def touching(tables):
    """A row a family, a column a library: milliseconds, and how many times impinge's that is."""
    groups = [(family, by_library(rows)) for (family,), rows in grouped(tables.rows("touching"), "family")]
    present = [library for library in LIBRARIES if any(library in libraries for _, libraries in groups)]
    lines = []
    for family, libraries in groups:
        ours = libraries["impinge"]
        count = digits(number(ours["exact_pairs"]) / number(ours["questions"]))
        lines.append([family, count, ours["ms"], *(ratio_cell(libraries.get(library)) for library in present[1:])])
    return markdown(["family", "pairs a query", *present], lines)


def pairs(tables):
    """A row a shape and case over all its meshes, a column a library: the mean of the ratios, the lowest and the highest."""
    libraries = [library for library in LIBRARIES[1:] if tables.rows("pairs", library=library)]
    lines = []
    for values, rows in grouped(tables.rows("pairs"), "shape", "case"):
        times = [number(row["ms"]) for row in rows if row["library"] == "impinge"]
        cells = [spread_cell([number(row["ratio"]) for row in rows if row["library"] == library]) for library in libraries]
        lines.append([*values, len(times), f"{digits(min(times))} to {digits(max(times))}", *cells])
    return markdown(["shape", "case", "meshes", "impinge, ms", *libraries], lines)


def spread_cell(ratios):
    return f"{digits(geometric_mean(ratios))} ({digits(min(ratios))} to {digits(max(ratios))})" if ratios else "-"


def build(tables):
    """A row a mesh, a column a library: milliseconds, how many times impinge's that is, and bytes a triangle."""
    rows = tables.rows("build")
    libraries = [library for (library,), _ in grouped(rows, "library")]
    lines = []
    for values, group in grouped(rows, "mesh", "triangles"):
        of = by_library(group)
        lines.append([*values, *(f"{of[lib]['ms']} ({of[lib]['ratio']}), {of[lib]['bytes_a_triangle']}" for lib in libraries)])
    return markdown(["mesh", "triangles", *libraries], lines)


def cost(tables):
    """A row a query, for both backends what T said and what the clock did."""
    rows = tables.rows("cost")
    backends = [backend for (backend,), _ in grouped(rows, "backend")]
    columns = ["predicted ms", "measured ms", "predicted / measured"]
    lines = [[query, *(row[column] for row in of_query for column in columns)]
             for (query,), of_query in grouped(rows, "query")]
    return markdown(["query", *(f"{backend}: {column}" for backend in backends for column in columns)], lines)


def paper(tables):
    """What was not measured has no column, but for the backends that need a device: those are what the paper is about."""
    measured = {row["library"] for row in tables.rows("paper")}
    shown = [library for library in LIBRARIES if library in measured or library in DEVICE_BACKENDS]
    rows = []
    for (triangles,), group in grouped(tables.rows("paper"), "triangles"):
        libraries = by_library(group)
        rows.append([triangles, *(libraries[library]["ms"] if library in libraries else "not measured"
                                  for library in shown),
                     f"{PAPER_RAPID[triangles]:.4f}", f"{PAPER_OWN[triangles]:.4f}"])
    return markdown(["triangles", *(f"{library}, ms" for library in shown), "RAPID, ms, 2009 hardware (paper)",
                     "the paper's method, ms, 2009 hardware (paper)"], rows)


def truth(tables):
    """Pairs missed and added by each library, summed over all that was asked, and how often its yes or no was wrong."""
    cases = [row for row in tables.rows("pairs") if not row["case"].startswith("first")]
    groups = [(f"{shape}, {case}", rows) for (shape, case), rows in grouped(cases, "shape", "case")]
    groups.append(("the paper's motion", tables.rows("paper")))
    groups += [(family, rows) for (family,), rows in grouped(tables.rows("touching"), "family")]
    groups += [(assembly, rows) for (assembly,), rows in grouped(tables.rows("assemblies"), "assembly")]
    libraries = ["impinge", "impinge paper", "FCL", "Embree query alone", "CGAL query alone"]
    lines = []
    for name, rows in groups:
        exact = sum(int(row["exact_pairs"]) for row in rows if row["library"] == "impinge")
        of = {library: [row for row in rows if row["library"] == library] for library in libraries}
        lines.append([name, exact, *(disagreement_cell(of[lib]) if of[lib] else "-" for lib in libraries)])
    return markdown(["scenes", "pairs", *libraries], lines)


def slopes(tables):
    lines = []
    for (grows, library), rows in grouped(tables.rows("growth"), "grows", "library"):
        fit = slope([(number(row[grows]), number(row["ms"])) for row in rows])
        lines.append([f"with {grows}", library, f"{rows[0][grows]} to {rows[-1][grows]}",
                      f"{rows[0]['ms']} to {rows[-1]['ms']}", f"{fit:.2f}"])
    return markdown(["time grows", "library", "from, to", "ms", "slope"], lines)


def plain(tables, name, **wanted):
    columns = tables.columns(name)
    return markdown([column.replace("_", " ") for column in columns],
                    [[row[column] for column in columns] for row in tables.rows(name, **wanted)])


def unequal(tables):
    """A row a pair of meshes, a column a place and question; what is the same for every place without contact is left out."""
    columns = [("far", "touches"), ("near", "touches"), ("touching", "touches"),
               ("far", "first contact"), ("near", "first contact"), ("touching", "first contact"),
               ("touching", "all contacts"), ("far", "distance"), ("near", "distance"), ("touching", "distance")]
    kept = {(row["place"], row["question"]) for row in tables.rows("unequal")}
    columns = [column for column in columns if column in kept]  # baselines may be older than a question
    rows = []
    for values, group in grouped(tables.rows("unequal"), "large mesh", "its triangles", "small mesh's"):
        asked = {(row["place"], row["question"]): row for row in group}
        rows.append([*values, *(f"{asked[c]['impinge us']} ({asked[c]['FCL / impinge']}, {asked[c]['FCL native / impinge']})"
                                for c in columns)])
    return markdown(["large mesh", "triangles", "small mesh's", *(f"{place}: {question}" for place, question in columns)], rows)


NAMED = {
    "unequal": unequal,
    "targets": target_table,
    "paper": paper,
    "truth": truth,
    "slopes": slopes,
    "pairs": pairs,
    "build": build,
    "cost": cost,
    "cost_constants": lambda tables: plain(tables, "cost_constants", **{"leaf size": "default"}),
    "touching": touching,
    "assembly_contest": lambda tables: plain(tables, "assemblies"),
}


def page_table(name, tables):
    return NAMED[name](tables) if name in NAMED else plain(tables, name)
