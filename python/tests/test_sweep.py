"""Sweeps: the table of the program, to the byte; interruption; Ray."""

import importlib.util
import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest
import throng_sim as tg

PROGRAM = os.environ.get("THRONG", "")

PLAN = """
scenes = ["headon", "circle"]
seeds = "1..3"
limit = 2
[[vary]]
avoid.orca.time_horizon = [1, 3]
"""


def plan(folder: Path) -> Path:
    path = folder / "plan.toml"
    path.write_text(PLAN)
    return path


def test_a_sweep_in_threads_has_a_row_for_each_run(tmp_path: Path) -> None:
    seen = []
    found = tg.sweep(plan(tmp_path), workers=2, progress=lambda made, all: seen.append((made, all)))
    assert (found.runs, found.failed) == (12, 0) and found.path == tmp_path / "plan.parquet"
    assert seen[-1] == (12, 12)
    frame = found.to_pandas()
    assert list(frame["index"]) == list(range(12))
    world = tg.Scene("circle")
    world["time.limit"] = 2
    world["avoid.orca.time_horizon"] = 3
    world = world.build(seed=3)
    world.run()
    assert frame["state_hash"].iloc[11] == f"{world.hash():016x}"
    # the second call has nothing to do
    before = found.path.read_bytes()
    seen.clear()
    assert tg.sweep(plan(tmp_path), progress=lambda made, all: seen.append(made)).runs == 12
    assert not seen and found.path.read_bytes() == before


@pytest.mark.skipif(not PROGRAM, reason="THRONG names no program")
def test_the_bytes_are_those_of_the_program_and_each_continues_the_other(tmp_path: Path) -> None:
    for name in ("program", "python", "both"):
        (tmp_path / name).mkdir()
    subprocess.run([PROGRAM, "sweep", plan(tmp_path / "program"), "-q", "-o", tmp_path / "program/plan.parquet"], check=True)
    expected = (tmp_path / "program/plan.parquet").read_bytes()
    assert tg.sweep(plan(tmp_path / "python")).path.read_bytes() == expected
    both = tmp_path / "both"
    command = [PROGRAM, "sweep", plan(both), "-q", "-o", both / "plan.parquet"]
    subprocess.run([*command, "--index", "0..7"], check=True)
    made = []
    assert tg.sweep(plan(both), progress=lambda count, all: made.append(all)).path.read_bytes() == expected
    assert made[-1] == 4


def test_a_killed_sweep_goes_on(tmp_path: Path) -> None:
    undisturbed = tmp_path / "undisturbed"
    undisturbed.mkdir()
    expected = tg.sweep(plan(undisturbed)).path.read_bytes()
    path = plan(tmp_path)
    code = f"import throng_sim as tg; tg.sweep({str(path)!r}, workers=1, progress=lambda made, all: print(made, flush=True))"
    with subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None
        for _ in range(3):
            process.stdout.readline()
        process.send_signal(signal.SIGKILL)
    assert not (tmp_path / "plan.parquet").exists()
    made = []
    found = tg.sweep(path, progress=lambda count, all: made.append(all))
    assert made[-1] <= 9
    assert found.path.read_bytes() == expected


@pytest.mark.skipif(importlib.util.find_spec("ray") is None, reason="Ray is not installed")
@pytest.mark.filterwarnings("ignore")
def test_ray_gives_the_same_bytes(tmp_path: Path) -> None:
    import ray

    (tmp_path / "threads").mkdir()
    expected = tg.sweep(plan(tmp_path / "threads")).path.read_bytes()
    ray.init(num_cpus=2, include_dashboard=False, log_to_driver=False)
    try:
        assert tg.sweep(plan(tmp_path), ray=True).path.read_bytes() == expected
    finally:
        ray.shutdown()


def test_misuse(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="needs an `output`"):
        tg.sweep(PLAN)
    with pytest.raises(ValueError, match="ends in .parquet"):
        tg.sweep(plan(tmp_path), tmp_path / "a.csv")
    with pytest.raises(FileNotFoundError):
        tg.sweep(tmp_path / "none.toml")
    with pytest.raises(tg.SceneError, match="avoid.orca.horizon|horizon"):
        tg.sweep(PLAN.replace("time_horizon", "horizon"), tmp_path / "a.parquet")
