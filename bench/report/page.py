#!/usr/bin/env python3
# SPDX-FileCopyrightText: The impinge authors
# SPDX-License-Identifier: MIT
"""page.py [--quick] TABLES PAGE: draws the charts beside the page, and puts what TABLES holds into it: all that stands
between <!-- table: NAME --> and <!-- end --> is written anew, and nothing else."""
import re
import sys
from pathlib import Path

sys.dont_write_bytecode = True  # the modules beside this one leave nothing in the repository

from charts import draw_all
from data import Tables
from page_tables import page_table

REMARK = "**Rough: made by --quick, with fewer meshes, poses and repeats than the text says.**"


def filled(text, tables):
    def table(match):
        return f"{match[1]}\n\n{page_table(match[2], tables)}\n\n<!-- end -->"

    return re.sub(r"(<!-- table: ([a-z_]+) -->).*?<!-- end -->", table, text, flags=re.DOTALL)


def main(arguments):
    quick = "--quick" in arguments
    folder, page = [Path(argument) for argument in arguments if not argument.startswith("--")]
    tables = Tables(folder)
    text = filled(page.read_text(), tables)
    if quick:
        title, rest = text.split("\n", 1)
        text = f"{title}\n\n{REMARK}\n{rest}"
    draw_all(tables, page.parent / "charts")
    page.write_text(text)


if __name__ == "__main__":
    main(sys.argv[1:])
