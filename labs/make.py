"""Makes the students' notebooks of the solved ones: python labs/make.py

The lines from `### BEGIN SOLUTION: sentence` to `### END SOLUTION` become `raise NotImplementedError("sentence")`.
Outputs are removed, also from the solved notebooks. nbgrader knows the same marks.
"""

from __future__ import annotations

import re
from pathlib import Path

import nbformat

FOLDER = Path(__file__).parent
SOLUTION = re.compile(r"(?ms)^( *)### BEGIN SOLUTION: ([^\n]*)\n.*?^ *### END SOLUTION")


def stripped(notebook: nbformat.NotebookNode) -> nbformat.NotebookNode:
    """Returns a notebook without outputs."""
    for cell in notebook.cells:
        if cell.cell_type == "code":
            cell.outputs, cell.execution_count = [], None
    return notebook


def for_students(notebook: nbformat.NotebookNode) -> nbformat.NotebookNode:
    """Returns a notebook without outputs and solutions."""
    for cell in stripped(notebook).cells:
        cell.source = SOLUTION.sub(r'\1raise NotImplementedError("\2")', cell.source)
    return notebook


def main() -> None:
    """Writes all notebooks."""
    for path in sorted((FOLDER / "solutions").glob("*.ipynb")):
        nbformat.write(stripped(nbformat.read(path, 4)), path)
        nbformat.write(for_students(nbformat.read(path, 4)), FOLDER / path.name)


if __name__ == "__main__":
    main()
