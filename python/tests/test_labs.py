"""The labs: solved ones run, those of students begin, and classic mistakes in them are named."""

import functools
import importlib.util
import os
import re
from pathlib import Path
from typing import Any

import matplotlib
import nbformat
import pytest
import throng_sim
from nbclient import NotebookClient

LABS = Path(__file__).parents[2] / "labs"
NAMES = ["1-boids", "2-steering", "3-velocity-obstacles", "4-vector-fields", "5-insect-swarms"]
# where this Python found the package: the kernels use the same one
PACKAGES = str(Path(throng_sim.__file__).parents[1])


def make() -> Any:
    """Returns the module that makes the students' notebooks."""
    spec = importlib.util.spec_from_file_location("make", LABS / "make.py")
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def read(path: Path) -> nbformat.NotebookNode:
    return nbformat.read(path, 4)


def execute(
    notebook: nbformat.NotebookNode, folder: Path, *, allow_errors: bool = False
) -> list[nbformat.NotebookNode]:
    """Runs a notebook and returns its cells with code."""
    variables = {**os.environ, "PYTHONPATH": PACKAGES, "MPLBACKEND": "module://matplotlib_inline.backend_inline"}
    client = NotebookClient(
        notebook,
        timeout=300,
        kernel_name="python3",
        allow_errors=allow_errors,
        resources={"metadata": {"path": str(folder)}},
    )
    client.execute(env=variables)
    return [cell for cell in notebook.cells if cell.cell_type == "code"]


def shown(cell: nbformat.NotebookNode) -> str:
    """Returns the text that a cell shows."""
    return "\n".join(out["data"].get("text/plain", "") for out in cell.outputs if "data" in out)


@pytest.mark.parametrize("name", NAMES)
def test_students_get_the_solved_lab_without_its_solutions(name: str) -> None:
    solved = read(LABS / "solutions" / f"{name}.ipynb")
    given = read(LABS / f"{name}.ipynb")
    for notebook in (solved, given):
        nbformat.validate(notebook)
        assert all(not cell.get("outputs") and cell.get("execution_count") is None for cell in notebook.cells)
    functions = sum(cell.source.count("### BEGIN SOLUTION: ") for cell in solved.cells)
    expected = make().for_students(solved)
    assert [cell.source for cell in given.cells] == [cell.source for cell in expected.cells]
    text = "\n".join(cell.source for cell in given.cells if cell.cell_type == "code")
    assert functions >= 2 and text.count("raise NotImplementedError(") == functions
    assert "SOLUTION" not in text
    assert "check." in text and "tg.compare(" in text and "## Questions" in given.cells[-1].source


@pytest.mark.parametrize("name", NAMES)
def test_solved_labs_run_and_their_checks_pass(name: str, tmp_path: Path) -> None:
    cells = execute(read(LABS / "solutions" / f"{name}.ipynb"), tmp_path)
    checks = [cell for cell in cells if cell.source.startswith("check.")]
    assert checks and all("answers are right" in shown(cell) for cell in checks)
    tables = [shown(cell) for cell in cells if "tg.compare(" in cell.source]
    assert tables and all("overlaps" in table for table in tables)
    # mine and the reference agree in all figures
    for table in tables:
        lines = [line.split() for line in table[table.index("model  ") :].splitlines()[1:]]
        rows = {model: figures for model, *figures in lines if len(figures) == 5 and figures[0].isdigit()}
        theirs = rows.get("reference") or rows.get("theirs")
        mine = rows.get("mine") or rows["orca"]
        assert mine == theirs, table
        assert all(row[3] == "0" for row in rows.values()), "no agents overlap"


@pytest.mark.parametrize("name", NAMES)
def test_a_student_can_begin_before_anything_is_written(name: str, tmp_path: Path) -> None:
    first, *rest = execute(read(LABS / f"{name}.ipynb"), tmp_path, allow_errors=True)
    assert not [out for out in first.outputs if out.output_type == "error"]
    assert any("image/png" in out.get("data", {}) for out in first.outputs)
    for cell in rest:
        errors = [out for out in cell.outputs if out.output_type == "error"]
        if cell.source.startswith("check."):
            assert not errors and "write the function first" in shown(cell)
        for error in errors:
            follows = error.ename == "NameError" and re.search(r"'(run|my_\w+)' is not defined", error.evalue)
            assert error.ename == "NotImplementedError" or follows, error.evalue
            if error.ename == "NotImplementedError":
                assert len(error.evalue.split()) > 3, "a sentence says what to write"


MISTAKES = [
    ("1-boids", "return -(offsets", "return (offsets", "wrong sign: it pulls"),
    ("1-boids", "near = squared > 0", "near = squared >= 0", "divides by zero at a neighbour at the same place"),
    ("1-boids", "velocities.mean(axis=0) - velocity", "velocities.mean(axis=0)", "subtract the agent's own"),
    ("1-boids", "return offsets.mean(axis=0)", "return offsets.sum(axis=0)", "cohesion is the sum"),
    ("1-boids", "weight * rule for", "rule for", "the weights have no effect"),
    ("2-steering", "offset / np.where(distance > 0, distance, 1.0)", "offset", "not normalised"),
    ("2-steering", "np.where(distance > 0, distance, 1.0)", "distance", "divides by zero at the target"),
    ("2-steering", "offset = target - positions", "offset = positions - target", "it flees"),
    ("2-steering", "offset, axis=1, keepdims=True", "offset", "axis=1, keepdims=True"),
    ("2-steering", "np.minimum(distance / slowing, 1.0)", "distance / slowing", "far agents are faster"),
    ("2-steering", "* np.minimum(distance / slowing, 1.0)", "", "this is seek"),
    ("2-steering", "quarry + quarry_velocity * time", "quarry", "where the quarry is now"),
    ("2-steering", "np.minimum(distance / max_speed, most)", "distance / max_speed", "not limited by `most`"),
    ("3-velocity-obstacles", "ahead = offset @ relative_velocity > 0", "ahead = True", "behind the agent count too"),
    ("3-velocity-obstacles", "c <= horizon * (b + root)", "b > 0", "not truncated"),
    ("3-velocity-obstacles", "velocity + change / 2", "velocity + change", "The neighbour does the other half"),
    ("3-velocity-obstacles", "velocity - other_velocity", "other_velocity - velocity", "wrong sign"),
    ("3-velocity-obstacles", "det(offset, w) > 0", "det(offset, w) < 0", "exchanged"),
    ("3-velocity-obstacles", "if behind < 0 and", "if False and", "only the legs are used"),
    (
        "3-velocity-obstacles",
        "radius_sum / horizon - length",
        "radius_sum - length",
        "radius_sum / horizon, not radius_sum",
    ),
    ("3-velocity-obstacles", "velocity + change / 2", "change / 2", "own velocity is missing"),
    (
        "3-velocity-obstacles",
        "preferred * min(1, max_speed / max(np.hypot(*preferred), 1e-9))",
        "preferred",
        "not cut to max_speed",
    ),
    ("4-vector-fields", "np.log(np.where(r > 0, r, 1.0))", "np.log(r)", "log 0"),
    ("4-vector-fields", "return r**2 * np", "return r * np", "the kernel is r log r"),
    ("4-vector-fields", "return np.hstack(columns(places)) @ weights", "columns(places)", "end it with `return`"),
    (
        "5-insect-swarms",
        "[gradient[:, 1], -gradient[:, 0]]",
        "[gradient[:, 0], gradient[:, 1]]",
        "this is the gradient",
    ),
    ("5-insect-swarms", "[gradient[:, 1], -gradient[:, 0]]", "[gradient[:, 1], gradient[:, 0]]", "signs is wrong"),
    (
        "5-insect-swarms",
        "curl(fade[:, None] * gradient + potential[:, None] * of_fade)",
        "fade[:, None] * curl(gradient)",
        "Multiply the potential",
    ),
]


@functools.cache
def begun(name: str) -> tuple[dict[str, Any], list[str]]:
    """Returns the names that the first cell of a solved lab defines, and the other cells with code."""
    matplotlib.use("Agg")
    first, *rest = (
        cell.source for cell in read(LABS / "solutions" / f"{name}.ipynb").cells if cell.cell_type == "code"
    )
    names: dict[str, Any] = {}
    exec(first, names)
    matplotlib.pyplot.close("all")
    return names, rest


@pytest.mark.parametrize(("name", "right", "wrong", "hint"), MISTAKES)
def test_classic_mistakes_are_named(name: str, right: str, wrong: str, hint: str) -> None:
    names, cells = begun(name)
    names = dict(names)
    assert sum(cell.count(right) for cell in cells) >= 1, right
    hints = []
    for cell in cells:
        if cell.startswith("check."):
            verdict = eval(cell, names)
            hints.append(verdict.hint)
        elif "### BEGIN SOLUTION" in cell:
            exec(cell.replace(right, wrong), names)
    assert any(hint in found for found in hints), hints


def test_the_scene_of_the_template_in_rust_is_sound() -> None:
    folder = LABS / "rust"
    scene = (folder / "src" / "ring.toml").read_text(encoding="utf-8")
    assert throng_sim.Scene(scene.replace("avoid.my_orca", "avoid.orca")).build().run().arrived == 8
    assert 'include_str!("ring.toml")' in (folder / "src" / "main.rs").read_text(encoding="utf-8")
    assert (folder / "src" / "half_plane.rs").read_text(encoding="utf-8").count("todo!(") == 1
