# SPDX-FileCopyrightText: The impinge authors
# SPDX-License-Identifier: MIT
"""The page's tables, by the name that stands in it. A name that is not here is a CSV file shown as it is."""
from data import by_library, digits, grouped, markdown, number, slope
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
    return "0" if missed == added == 0 else f"−{missed} +{added}"


def contest(tables, name, *keys):
    """A row a question, a column a library: milliseconds, and how many times impinge's that is."""
    groups = [(values, by_library(rows)) for values, rows in grouped(tables.rows(name), *keys)]
    present = [library for library in LIBRARIES if any(library in libraries for _, libraries in groups)]
    rows = []
    for values, libraries in groups:
        ours = libraries["impinge"]
        pairs = digits(number(ours["exact_pairs"]) / number(ours["questions"]))
        rows.append([*values, pairs, ours["ms"], *(ratio_cell(libraries.get(library)) for library in present[1:])])
    return markdown([*keys, "pairs a query", *present], rows)


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
    """Pairs missed and added by each library, summed over all that was asked."""
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


def yes_or_no(tables):
    """Questions of which the yes or no was wrong."""
    lines = []
    for (family,), rows in grouped(tables.rows("touching"), "family"):
        lines.append([family, rows[0]["questions"], *(row["wrong_answers"] for row in rows)])
    for (assembly,), rows in grouped(tables.rows("assemblies"), "assembly"):
        touching = f"{rows[0]['exact_object_pairs']} touching"
        lines.append([assembly, touching, *(row["wrong_object_pairs"] for row in rows)])
    libraries = [row["library"] for row in grouped(tables.rows("touching"), "family")[0][1]]
    return markdown(["scenes", "motions, or pairs of parts", *libraries], lines)


def slopes(tables):
    lines = []
    for (grows, library), rows in grouped(tables.rows("growth"), "grows", "library"):
        fit = slope([(number(row[grows]), number(row["ms"])) for row in rows])
        lines.append([f"with {grows}", library, f"{rows[0][grows]} to {rows[-1][grows]}",
                      f"{rows[0]['ms']} to {rows[-1]['ms']}", f"{fit:.2f}"])
    return markdown(["time grows", "library", "from, to", "ms", "slope"], lines)


def plain(tables, name):
    columns = tables.columns(name)
    return markdown([column.replace("_", " ") for column in columns],
                    [[row[column] for column in columns] for row in tables.rows(name)])


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
    "yes_or_no": yes_or_no,
    "slopes": slopes,
    "pairs": lambda tables: contest(tables, "pairs", "shape", "mesh", "triangles", "case"),
    "touching": lambda tables: contest(tables, "touching", "family"),
    "assembly_contest": lambda tables: plain(tables, "assemblies"),
}


def page_table(name, tables):
    return NAMED[name](tables) if name in NAMED else plain(tables, name)
