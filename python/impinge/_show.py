# SPDX-FileCopyrightText: The impinge authors
# SPDX-License-Identifier: MIT
"""What is shown of answers: tables in notebooks, reports, drawings."""

from __future__ import annotations

import html
import importlib
import os
import tempfile
import time
from typing import TYPE_CHECKING, Any, Callable, Hashable, Iterable, Sequence

import numpy as np

from . import _arrays, _core
from ._errors import ImpingeError, OptionError
from ._mesh import Mesh, MeshLike, as_mesh

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from ._clash import Clashes
    from ._queries import Contacts
    from ._scene import Scene

MOST_ROWS = 50  #: of a table
MOST_BYTES = 20_000_000  #: of a page within a notebook, which keeps it in its file

#: The page's colours of verdicts; white on each has a contrast of 4.5 or more.
COLOURS = {
    "duplicate": "#6d3fd0",
    "inside": "#a8177f",
    "penetrating": "#c7222c",
    "crossing": "#a84f08",
    "touching": "#2a6aa5",
    "apart": "#3d7553",
}
FORMATS = {".html": "html", ".json": "json", ".csv": "csv", ".bcf": "bcf", ".bcfzip": "bcf", ".glb": "glb"}


# --- tables: static HTML with styles of their own, since notebooks drop style sheets and scripts


class _Badge(str):
    """A word on a ground of its colour."""


def _cell(value: object) -> str:
    if isinstance(value, _Badge):
        style = f"background:{COLOURS[value]};color:#fff;border-radius:0.6em;padding:0.1em 0.6em;font-size:90%"
        return f'<td style="text-align:left"><span style="{style}">{value}</span></td>'
    if isinstance(value, (int, float, np.number)) and not isinstance(value, bool):
        text = f"{value:,}" if isinstance(value, (int, np.integer)) else f"{value:.4g}"
        return f'<td style="text-align:right;font-variant-numeric:tabular-nums">{text}</td>'
    text = " ".join(str(value).split())
    text = text if len(text) <= 80 else text[:76] + " ..."
    return f'<td style="text-align:left">{html.escape(text)}</td>'


def _table(caption: str, heads: Sequence[str], rows: Iterable[Sequence[object]], count: int) -> str:
    """Of `count` rows the first ones."""
    head = "".join(f'<th style="text-align:left">{html.escape(name)}</th>' for name in heads)
    body = "".join(f"<tr>{''.join(map(_cell, row))}</tr>" for row in rows)
    more = f"<p><em>and {count - MOST_ROWS:,} more</em></p>" if count > MOST_ROWS else ""
    style = "text-align:left;caption-side:top;font-weight:bold;padding-bottom:0.4em"
    caption = f'<caption style="{style}">{html.escape(caption)}</caption>'
    return f"<div><table>{caption}<thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>{more}</div>"


def _counted(count: int, noun: str) -> str:
    return f"{count:,} {noun}{'' if count == 1 else 's'}"


def table_of_clashes(clashes: Clashes) -> str:
    worst = sorted(clashes.pairs, key=lambda pair: (not pair.fails, -pair.fails_below, pair.verdict))[:MOST_ROWS]
    verdicts = [pair.verdict.name.lower() for pair in clashes.pairs]
    said = [f"{verdicts.count(name):,} {name}" for name in COLOURS if name in verdicts]
    caption = f"{_counted(len(verdicts), 'pair')} of {_counted(len(clashes.parts), 'part')}{': ' if said else ''}{', '.join(said)}"
    rows = [
        (
            _Badge(pair.verdict.name.lower()),
            *pair.objects,
            "" if pair.overlap_depth is None else max(depth.hi for depth in pair.overlap_depth),
            "" if pair.nearest is None else pair.nearest.distance,
            *pair.contacts,
        )
        for pair in worst
    ]
    return _table(caption, ("verdict", "a", "b", "depth", "distance", "crossing", "touching", "coplanar"), rows, len(verdicts))


def table_of_contacts(contacts: Contacts) -> str:
    shown = contacts.objects[:MOST_ROWS].tolist()
    names = contacts.names if contacts.names is not None else shown
    rows = []
    for (a, b), begin, end in zip(names, contacts.offsets.tolist(), contacts.offsets[1 : len(shown) + 1].tolist()):
        rows.append((a, b, end - begin, *np.bincount(contacts.kinds[begin:end], minlength=3).tolist()))
    count = len(contacts.objects)
    caption = f"{_counted(len(contacts.kinds), 'pair')} of triangles that touch, of {_counted(count, 'pair')} of objects"
    return _table(
        caption + (", the first ones" if contacts.truncated else ""),
        ("a", "b", "pairs", "crossing", "touching", "coplanar"),
        rows,
        count,
    )


def table_of_scene(scene: Scene) -> str:
    names = list(scene)[:MOST_ROWS]
    rows = []
    for name in names:
        mesh, pose = scene.mesh(name), scene.pose(name)
        rows.append((name, len(mesh.vertices), len(mesh.faces), *pose[:3, 3].tolist()))
    caption = f"{_counted(len(scene), 'object')}, {_counted(scene._core.triangles, 'face')}"
    return _table(caption, ("object", "vertices", "faces", "x", "y", "z"), rows, len(scene))


# --- reports


class Source:
    """What a report is made of: the scene as it was when the clashes were found. It does not pickle: None comes of it."""

    __slots__ = ("judged", "objects")

    def __init__(self, judged: _core.Judged, objects: dict[Hashable, tuple[int, Mesh]]) -> None:
        self.judged = judged
        texts = [str(name).encode(errors="replace").decode() for name in objects]
        unique = len(set(texts)) == len(texts)
        self.objects = [  # index in the scene, name, mesh
            (index, text if unique else f"{text} #{index}", mesh._core)
            for text, (index, mesh) in zip(texts, objects.values())
        ]

    def __reduce__(self) -> tuple[Any, ...]:
        return type(None), ()


def save(
    source: Source | None,
    path: str | os.PathLike[str],
    title: str,
    unit_in_metres: float | None,
    y_up: bool | None,
    stop: _core.Stop | None,
) -> None:
    file = os.fspath(path)
    ending = os.path.splitext(file)[1].lower()
    if ending not in FORMATS:
        raise OptionError(f"{file!r} ends in {ending!r}; save knows {', '.join(FORMATS)}")
    if unit_in_metres is not None and not 0 < unit_in_metres < float("inf"):
        raise OptionError(f"unit_in_metres is {unit_in_metres}; give the metres in one unit, such as 0.001")
    if source is None:
        raise ImpingeError("these clashes were unpickled, and their scene was not with them; find them again to write a report")
    title = title.replace("/", "\u2215").encode(errors="replace").decode()  # documents take it for the name of a file
    page = os.path.join(os.path.dirname(__file__), "report.html")
    if "IMPINGE_PAGE" in os.environ or not os.path.exists(page):
        page = ""
    seconds = float(os.environ.get("SOURCE_DATE_EPOCH") or time.time())
    date = time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime(seconds))
    _core.write_report(
        source.judged, source.objects, title, unit_in_metres, y_up, page, date, FORMATS[ending], file, stop
    )


def page(source: Source | None, **settings: Any) -> str:
    with tempfile.TemporaryDirectory() as folder:
        file = os.path.join(folder, "report.html")
        save(source, file, **settings)
        with open(file, encoding="utf-8") as text:
            return text.read()


def in_notebook(make: Callable[[], str], height: int) -> Any:
    """A page in a frame, which neither reaches the notebook nor anything else; a large one beside it, in a file."""
    display = _optional("IPython.display", "show", "save('report.html') writes the page to a file")
    text = make()
    if len(text) <= MOST_BYTES:
        style = f"width:100%;height:{int(height)}px;border:1px solid #8886;border-radius:6px"
        sandbox = "allow-scripts allow-downloads allow-modals"
        return display.HTML(f'<div><iframe sandbox="{sandbox}" style="{style}" srcdoc="{html.escape(text)}"></iframe></div>')
    with tempfile.NamedTemporaryFile("w", encoding="utf-8", dir=".", prefix="clashes-", suffix=".html", delete=False) as file:
        file.write(text)
    return display.FileLink(os.path.relpath(file.name))


def _optional(module: str, caller: str, instead: str) -> Any:
    try:
        return importlib.import_module(module)
    except ImportError as problem:
        package = module.partition(".")[0]
        raise ImportError(f"{caller} needs {package}, which is not installed; {instead}", name=package) from problem


# --- drawings


def draw(
    a: MeshLike,
    b: MeshLike,
    pose_a: ArrayLike | None = None,
    pose_b: ArrayLike | None = None,
    *,
    tolerance: float = 0.0,
    ax: Any = None,
) -> Any:
    """Draws two meshes, translucent, and the lines along which they touch, by matplotlib; returns the axes.

    `tolerance`: as in `contact_regions`. `ax`: 3D axes of matplotlib's to draw into; None: those of a new figure. Made for a look at some
    thousands of triangles; `Clashes.show` shows large assemblies.

    >>> import impinge, os
    >>> os.environ["MPLBACKEND"] = "Agg"  # no window
    >>> sheet = [[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]]
    >>> axes = impinge.draw(sheet, sheet, None, [[1, 0, 0, 0.5], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])
    >>> [type(drawn).__name__ for drawn in axes.collections]
    ['Poly3DCollection', 'Poly3DCollection', 'Line3DCollection']

    Raises
    ------
    As `contact_regions`; ImportError without matplotlib.
    """
    from ._clash import contact_regions

    art = _optional("mpl_toolkits.mplot3d.art3d", "draw", "pip install matplotlib")
    lines = [line for region in contact_regions(a, b, pose_a, pose_b, tolerance=tolerance) for line in region.lines]
    if ax is None:
        ax = importlib.import_module("matplotlib.pyplot").figure().add_subplot(projection="3d")
    corners = []
    for mesh, pose, what, colour in ((a, pose_a, "pose_a", "#3b8be0"), (b, pose_b, "pose_b", "#f09a1a")):
        mesh, matrix = as_mesh(mesh), _arrays.pose(pose, what)
        triangles = mesh.vertices[mesh.faces]
        if matrix is not None:
            triangles = triangles @ matrix[:3, :3].T + matrix[:3, 3]
        ax.add_collection3d(art.Poly3DCollection(triangles, facecolor=colour, edgecolor="#00000030", linewidth=0.3, alpha=0.25))
        corners.append(triangles.reshape(-1, 3))
    ax.add_collection3d(art.Line3DCollection(lines, colors="#c4005f", linewidth=2))
    low, high = np.concatenate(corners).min(axis=0), np.concatenate(corners).max(axis=0)
    middle, half = (low + high) / 2, max(float((high - low).max()) / 2, 1e-300)
    for axis, centre in zip("xyz", middle):
        getattr(ax, f"set_{axis}lim")(centre - half, centre + half)
    ax.set_box_aspect((1, 1, 1))
    return ax
