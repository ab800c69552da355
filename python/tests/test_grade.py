"""Models in Python in the program: `throng compare --models mine.py`."""

from __future__ import annotations

import json
import math
import os
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path
from typing import Any

import pytest

import throng_sim as tg

PROGRAM = os.environ["THRONG"]

MINE = """
import numpy as np
import throng_sim as tg

print("what a module prints is no answer")

@tg.model(sees=1.0, reach=4.0, neighbors=6)
def timid(view):
    print("nor what a model prints")
    near, walls = view.near, view.walls
    away = near.offsets / np.maximum((near.offsets**2).sum(axis=1, keepdims=True), 1e-6)
    pushed = np.zeros((len(view), 2))
    np.add.at(pushed, walls.row, 0.01 * (walls.a + walls.b))
    return 0.9 * view.preferred - 0.1 * view.sum(away) - pushed
"""


def compare(folder: Path, *arguments: str, python: str = sys.executable) -> subprocess.CompletedProcess[str]:
    """Runs `throng compare` in a folder."""
    command = [PROGRAM, "compare", *arguments]
    environment = {**os.environ, "PYTHON": python}
    return subprocess.run(command, capture_output=True, text=True, cwd=folder, env=environment, timeout=200)


@pytest.mark.parametrize("scene", ["doorway", "circle", "mixed-sizes"])
def test_figures_are_those_of_the_package(tmp_path: Path, scene: str) -> None:
    """A model does the same under the program, in its own process, as in a world of the package."""
    (tmp_path / "mine.py").write_text(MINE)
    arguments = ["--models", "mine.py,orca", "--seeds", "1..2", "--limit", "6", "--json"]
    done = compare(tmp_path, scene, *arguments)
    assert done.returncode == 0, done.stderr
    found = json.loads(done.stdout)["models"]
    assert [model["model"] for model in found] == ["mine.py", "orca"]
    space: dict[str, Any] = {}
    exec(MINE, space)
    rows = tg.compare(scene, [space["timid"], "orca"], seeds=[1, 2], until=6).rows
    runs = [run for model in found for run in model["runs"]]
    for run, row in zip(runs, rows, strict=True):
        same = set(run) & set(row) - {"agent_steps_per_second"}
        assert len(same) >= 15
        known = {key: None if math.isnan(row[key]) else row[key] for key in same - {"model"}}
        assert known == {key: run[key] for key in known}


def test_bounds_grade_it_by_exit_code_json_and_junit(tmp_path: Path) -> None:
    (tmp_path / "mine.py").write_text(MINE)
    (tmp_path / "bounds.toml").write_text("[bounds]\narrived_share = { at_least = 1 }\noverlap_depth = { at_most = 0.0 }\n")
    bounds = ["--bounds", "bounds.toml", "--junit", "grades.xml", "--json"]
    done = compare(tmp_path, "headon", "--models", "mine.py:timid,orca", "--seeds", "3,4", *bounds)
    assert done.returncode == 0, done.stderr
    assert json.loads(done.stdout)["grades"]["passed"]
    suites = ElementTree.parse(tmp_path / "grades.xml").getroot()
    assert suites.get("failures") == "0"
    assert [suite.get("name") for suite in suites] == ["mine.py:timid", "orca"]
    (tmp_path / "still.py").write_text("import throng_sim as tg\nstill = tg.model(lambda view: 0 * view.preferred)\n")
    done = compare(tmp_path, "headon", "--models", "still.py,orca", "--limit", "5", *bounds)
    assert done.returncode == 1
    grades = json.loads(done.stdout)["grades"]["models"]
    assert not grades[0]["passed"] and "arrived_share" in (tmp_path / "grades.xml").read_text()


def test_a_film_shows_it(tmp_path: Path) -> None:
    (tmp_path / "mine.py").write_text(MINE)
    done = compare(tmp_path, "circle", "--models", "mine.py,orca", "--limit", "2", "-o", "both.html", "-o", "both.png")
    assert done.returncode == 0, done.stderr
    assert "mine.py" in (tmp_path / "both.html").read_text()
    assert (tmp_path / "both.png").stat().st_size > 1000


WRONG = {
    "import throng_sim as tg\n\ndef model(view:\n": "line 3",
    "import throng_sim as tg\n": "has no model: write @throng_sim.model",
    "import throng_sim as tg\n\nraise ValueError('not yet')\n": "ValueError: not yet\nin mine.py, line 3: raise",
    MINE + "\n@tg.model\ndef bold(view):\n    return view.preferred\n": "its models are timid, bold",
    "import throng_sim as tg\n\n@tg.model\ndef late(view):\n    return 1 / 0\n": "in mine.py, line 5: return 1 / 0",
    "import throng_sim as tg\n\n@tg.model\ndef wrong(view):\n    return view.preferred[:1]\n": "shape (1, 2); return an array of 2 by 2",
    "import os, throng_sim as tg\n\n@tg.model\ndef gone(view):\n    os._exit(3)\n": "the process of the model ended at 0.00 s",
}


@pytest.mark.parametrize("text", WRONG, ids=range(len(WRONG)))
def test_errors_name_the_file_and_the_line(tmp_path: Path, text: str) -> None:
    (tmp_path / "mine.py").write_text(text)
    done = compare(tmp_path, "headon", "--models", "mine.py,orca", "-o", "film.gif")
    assert done.returncode == 2
    assert "error: mine.py with seed 1: " in done.stderr
    assert WRONG[text] in done.stderr
    assert not (tmp_path / "film.gif").exists()


def test_missing_parts_are_named(tmp_path: Path) -> None:
    (tmp_path / "mine.py").write_text(MINE)
    assert "there is no file yours.py" in compare(tmp_path, "headon", "--models", "yours.py").stderr
    assert "has no model `bold`; its models are timid" in compare(tmp_path, "headon", "--models", "mine.py:bold").stderr
    assert "mine.py is given twice" in compare(tmp_path, "headon", "--models", "mine.py,mine.py").stderr
    done = compare(tmp_path, "headon", "--models", "mine.py", python="/nowhere/python")
    assert "cannot run /nowhere/python" in done.stderr and "environment variable PYTHON" in done.stderr
