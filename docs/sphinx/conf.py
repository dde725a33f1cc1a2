# SPDX-FileCopyrightText: The impinge authors
# SPDX-License-Identifier: MIT
"""Pages of docs/, with a reference of the Python package made of its docstrings and a gallery of notebooks: ./dev docs, or

    python -m sphinx -W -c docs/sphinx docs build/docs

with the package installed, and Debian's python3-sphinx, python3-numpydoc, python3-myst-parser and furo; for the gallery
jupyter-nbconvert and python3-ipykernel too. Nothing is fetched."""

import os
from base64 import b64decode
from pathlib import Path

import impinge

source = Path(__file__).parents[1]
project = "impinge"
author = copyright = "The impinge authors"
version = release = impinge.__version__

extensions = ["sphinx.ext.autodoc", "numpydoc", "myst_parser"]
root_doc = "sphinx/index"
default_role = "py:obj"  # `name` in a docstring
autodoc_member_order = "bysource"
autodoc_typehints = "none"  # the signatures' own are long, and shapes are in the text
numpydoc_show_class_members = False
myst_heading_anchors = 4
exclude_patterns = ["README.md"]  # the list of pages for whoever reads them as files
# Links to folders, to files that no page is made of and to anchors in HTML; tests/house looks whether each leads somewhere.
suppress_warnings = ["ref.myst"]
html_theme = "furo"
html_title = "impinge"
html_show_sphinx = False


def run_notebooks(app) -> None:
    """Each with its outputs as a page, beside the last picture in it."""
    import nbformat
    from nbconvert import HTMLExporter
    from nbconvert.preprocessors import ExecutePreprocessor

    os.environ["PYTHONPATH"] = str(Path(impinge.__file__).parents[1])  # Debian's kernel does not know of environments
    os.environ["PYDEVD_DISABLE_FILE_VALIDATION"] = "1"
    folder = Path(app.outdir) / "gallery"
    folder.mkdir(parents=True, exist_ok=True)
    exporter = HTMLExporter(mathjax_url="", require_js_url="")
    for file in sorted((source.parent / "examples").glob("*.ipynb")):
        notebook = nbformat.read(file, as_version=4)
        ExecutePreprocessor(timeout=120).preprocess(notebook, {"metadata": {"path": str(folder)}})
        (folder / f"{file.stem}.html").write_text(exporter.from_notebook_node(notebook)[0])
        outputs = [output for cell in notebook.cells for output in cell.get("outputs", [])]
        for picture in (output.data["image/png"] for output in outputs if "image/png" in output.get("data", {})):
            (folder / f"{file.stem}.png").write_bytes(b64decode(picture))


def drop_what_python_says(app, what, name, found, options, lines) -> None:
    if lines and lines[0].startswith("Alias for field number"):
        lines.clear()


def setup(app) -> None:
    app.connect("autodoc-process-docstring", drop_what_python_says)
    app.connect("builder-inited", run_notebooks)
