"""Runs: tables, files, measures, comparison; the same bits as the program."""

import json
import os
import subprocess
from pathlib import Path

import duckdb
import numpy as np
import pandas
import polars
import pyarrow
import pyarrow.parquet
import pytest
import shapely
import throng_sim as tg

PROGRAM = os.environ.get("THRONG", "")

SCENES = [
    "circle",
    "headon",
    "corridor",
    "doorway",
    "ring",
    "flocking",
    "pedestrians",
    "swarm-phototaxis",
    "crossing",
    "bottleneck",
]


@pytest.mark.skipif(not PROGRAM, reason="THRONG names no program")
@pytest.mark.parametrize("name", SCENES)
def test_the_program_has_the_same_bits(name: str) -> None:
    options = ["--no-files", "--no-expect", "--json", "--limit", "4"]
    out = subprocess.run([PROGRAM, "run", name, *options], capture_output=True, text=True, check=True).stdout
    expected = json.loads(out)["state_hash"]
    for threads in (1, 2):
        scene = tg.Scene(name)
        scene["time.limit"] = 4
        world = scene.build(threads=threads)
        world.run()
        assert f"{world.hash():016x}" == expected


@pytest.fixture(scope="module")
def run() -> tg.Run:
    scene = tg.Scene(walkable=shapely.box(0, 0, 24, 5))
    scene.group("left", n=30, area=shapely.box(0.3, 0.3, 6, 4.7), exit=shapely.box(23, 0, 24, 5), gap=0.1)
    scene.group("right", n=30, area=shapely.box(18, 0.3, 23.7, 4.7), exit=shapely.box(0, 0, 1, 5), gap=0.1)
    return scene.run(record=12.5, seed=5)


def test_a_run_is_a_table_of_every_library(run: tg.Run) -> None:
    table = run.table()
    assert table.column_names == ["time", "id", "group", "x", "y", "z", "vx", "vy", "vz", "heading", "radius", "status"]
    rows = table.num_rows
    assert rows > 30 * len(run) / 2
    assert polars.DataFrame(run).shape == (rows, 12)
    assert len(pandas.DataFrame(table.to_pandas())) == rows
    rows_of_run = table
    assert duckdb.sql("select count(*) from rows_of_run").fetchall() == [(rows,)]
    arrays = run.arrays()
    assert set(arrays["group"]) == {"left", "right"}
    assert set(arrays["status"]) <= {"walking", "waiting", "arrived", "stranded"}
    times = np.unique(arrays["time"])
    assert times == pytest.approx(run.times[: len(times)])
    assert np.diff(run.times)[:-1] == pytest.approx(0.08)
    assert arrays["x"].min() >= 0 and arrays["x"].max() <= 24


def test_the_files_are_those_of_the_program(run: tg.Run, tmp_path: Path) -> None:
    names = ["run.csv", "run.parquet", "run.sqlite", "run.usda", "run.glb", "run.rec", "run.png", "run.gif"]
    run.save(*[tmp_path / name for name in names], size=(320, 120), rate=5, speed_up=4)
    assert all((tmp_path / name).stat().st_size > 100 for name in names)
    written = pyarrow.parquet.read_table(tmp_path / "run.parquet")
    arrays = run.arrays()
    assert written.num_rows == len(arrays["x"])
    assert written.column("x").to_numpy() == pytest.approx(arrays["x"], abs=1e-4)
    with pytest.raises(tg.FileError, match="cannot write .*run.what"):
        run.save(tmp_path / "run.what")
    with pytest.raises(tg.FileError, match="no/such"):
        run.save(tmp_path / "no/such/run.csv")
    with pytest.raises(ValueError, match="rate is 0"):
        run.save(tmp_path / "a.csv", rate=0)


def test_measures_agree_with_brute_force(run: tg.Run) -> None:
    arrays = run.arrays()
    area = shapely.box(10, 0, 14, 5)
    found = tg.measure.density(run, area)
    inside = (arrays["x"] > 10) & (arrays["x"] < 14)
    for k, time in enumerate(found.time):
        assert found.density[k] == pytest.approx((inside & (arrays["time"] == time)).sum() / 20)
    flow = tg.measure.flow(run, ((12, 0), (12, 5)))
    sides = {number: arrays["x"][arrays["id"] == number] > 12 for number in np.unique(arrays["id"])}
    crossed = [number for number, side in sides.items() if side.any() and not side.all()]
    assert sorted(flow.id.tolist()) == crossed and len(crossed) == 60
    assert flow.mean == pytest.approx(59 / (flow.time[-1] - flow.time[0]))
    one = tg.measure.flow(run, ((12, 0), (12, 5)), group="left")
    assert len(one.time) == 30
    lanes = tg.measure.lanes(run)
    assert 0 <= lanes.steady <= 1 and np.nanmax(lanes.order) <= 1
    diagram = tg.measure.fundamental(run, area, since=3)
    assert (diagram.density > 0).all() and diagram.flow.shape == diagram.speed.shape
    with pytest.raises(ValueError, match="there is no group `middle`; there are: left, right"):
        tg.measure.flow(run, ((12, 0), (12, 5)), group="middle")
    with pytest.raises(ValueError, match="two points"):
        tg.measure.flow(run, ((12, 0), (12, 5), (1, 1)))
    with pytest.raises(ValueError, match="has no size"):
        tg.measure.density(run, [(0, 0), (1, 1), (2, 2)])


def test_a_comparison_has_a_row_for_each_run() -> None:
    @tg.model
    def mine(view: tg.View) -> np.ndarray:
        return view.preferred

    found = tg.compare("headon", ["orca", mine], seeds=[1, 2], until=20)
    assert [(row["model"], row["seed"]) for row in found.rows] == [("orca", 1), ("orca", 2), ("mine", 1), ("mine", 2)]
    frame = found.to_pandas()
    assert frame["overlaps"].sum() == 0 and len(found) == 4
    assert "mine" in repr(found) and "<table" in found._repr_html_()


def test_a_run_can_be_cut_and_goes_on() -> None:
    world = tg.Scene("circle").build()
    first = tg.Run.of(world, until=2, record=25)
    assert first.times[-1] == pytest.approx(2) and len(first) == 51
    second = tg.Run.of(world, until=3, record=25)
    assert second.times[0] == pytest.approx(2) and second.times[-1] == pytest.approx(3)
    for bad in (0, -1, float("nan"), float("inf")):
        with pytest.raises(ValueError, match="more than 0 frames"):
            tg.Run.of(world, record=bad)
