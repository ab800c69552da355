"""All files that the package reads open; errors name the file and leave nothing behind."""

import re
from pathlib import Path

import bpy
import numpy as np
import pytest
import throng
import throng_sim as tg
from conftest import contents
from throng import operators


@pytest.mark.parametrize("ending", ["rec", "csv", "glb", "parquet", "sqlite", "usda"])
def test_every_kind_of_file(scene: bpy.types.Scene, recorded: dict[str, Path], ending: str) -> None:
    bpy.ops.throng.open_trajectory(filepath=str(recorded[ending]))
    scene.frame_set(20)
    there = [thing for thing in scene.objects if thing.type == "ARMATURE" and thing.scale.x > 1e-6]
    assert len(there) == 12
    assert scene.camera is not None and {"Ground"} <= {thing.name for thing in scene.objects}


def test_endings_are_those_of_the_package(tmp_path: Path) -> None:
    (tmp_path / "crowd.unknown").write_text("")
    with pytest.raises(ValueError, match="supported endings") as error:
        tg.Trajectories.read(tmp_path / "crowd.unknown")
    known = re.findall(r"\.(\w+)", str(error.value).split("supported endings:")[1])
    assert set(known) == set(operators.ENDINGS)


@pytest.mark.parametrize(
    ("name", "content", "what"),
    [
        ("none.csv", None, "cannot read"),
        ("wrong.csv", "time,number,x,y\n0,1,nan,2\n", "wrong.csv"),
        ("empty.csv", "time,number,x,y\n", "no agents"),
        ("crowd.unknown", "", "supported endings"),
        ("wrong.rec", "THRONG", "wrong.rec"),
        ("wrong.glb", "glTF", "wrong.glb"),
    ],
)
def test_errors_leave_nothing(
    scene: bpy.types.Scene, tmp_path: Path, name: str, content: str | None, what: str
) -> None:
    if content is not None:
        (tmp_path / name).write_text(content)
    before = contents()
    with pytest.raises(RuntimeError, match=re.escape(what)):
        bpy.ops.throng.open_trajectory(filepath=str(tmp_path / name))
    assert contents() == before


def test_a_failure_half_way_leaves_nothing(scene: bpy.types.Scene, recorded: dict[str, Path], monkeypatch) -> None:
    from throng import stage

    def fails(*_: object) -> None:
        raise ValueError("no camera today")

    monkeypatch.setattr(stage, "frame", fails)
    before, world = contents(), scene.world
    with pytest.raises(RuntimeError, match="no camera today"):
        bpy.ops.throng.open_trajectory(filepath=str(recorded["rec"]))
    assert contents() == before
    assert (scene.camera, scene.world) == (None, world)


def test_a_cancelled_import_leaves_nothing(scene: bpy.types.Scene, recorded: dict[str, Path]) -> None:
    from throng import crowds

    before = contents()
    steps = crowds.build(bpy.context, tg.Trajectories.read(recorded["rec"]), "run")
    for _ in range(5):
        next(steps)
    assert contents() != before
    steps.close()
    assert contents() == before


def test_too_much_for_memory_is_refused(scene: bpy.types.Scene, tmp_path: Path) -> None:
    path = tmp_path / "long.csv"
    rows = [f"{time},{number},{number},0\n" for time in (0, 20_000) for number in range(20)]
    path.write_text("time,number,x,y\n" + "".join(rows))
    scene.throng.armatures = 0
    before = contents()
    with pytest.raises(RuntimeError, match="choose fewer poses a second"):
        bpy.ops.throng.open_trajectory(filepath=str(path))
    assert contents() == before


def test_one_moment(scene: bpy.types.Scene, tmp_path: Path) -> None:
    """Agents of one sample, between two frames, and far from the origin."""
    path = tmp_path / "one.csv"
    path.write_text("time,number,x,y\n0,1,500000,1\n0.01,2,500003,1\n0.5,1,500000.5,1\n")
    bpy.ops.throng.open_trajectory(filepath=str(path))
    scene.frame_set(13)
    armature = bpy.data.objects["Agent_1"]
    assert abs(armature.matrix_world.translation.x - 500000.48) < 0.05
    assert abs(armature.location.x) < 1000, "relative to the root: accurate in single precision"
    assert "Agent_2" not in bpy.data.objects, "it is there at no frame"


@pytest.mark.parametrize("flies", [False, True])
def test_others_are_instances(scene: bpy.types.Scene, tmp_path: Path, flies: bool) -> None:
    """Agents that are no people: wide ones, and those that fly."""
    path = tmp_path / "wide.csv"
    head, row = "time,number,group,x,y,z,heading,radius\n", "{},{},{},{},{},{},{},{}\n"
    rows = [
        row.format(t, number, "ab"[number % 2], number * 3 + t, t, 2 * flies, 0.5 * t, 0.6 + number / 10)
        for t in (0, 1, 2)
        for number in range(4)
        if t < 2 or number < 3
    ]
    path.write_text(head + "".join(rows))
    scene.throng.pose_rate = 25
    bpy.ops.throng.open_trajectory(filepath=str(path))
    trajectories = tg.Trajectories.read(path)
    assert trajectories.builds == [None] * 4
    for frame in (1, 11, 26, 40, 51):
        scene.frame_set(frame)
        positions, headings = trajectories.states([(frame - 1) / 25])
        there = ~np.isnan(headings[:, 0])
        found = [
            item.matrix_world.copy()
            for item in bpy.context.evaluated_depsgraph_get().object_instances
            if item.is_instance
        ]
        assert len(found) == there.sum()
        for matrix, place, heading, radius in zip(
            found, positions[there, 0], headings[there, 0], trajectories.radii[there], strict=True
        ):
            assert np.linalg.norm(np.array(matrix.translation) - place) < 1e-3
            assert abs(matrix.to_euler().z - heading) < 1e-3
            assert abs(matrix.to_scale().x - radius) < 1e-5


def test_a_file_needs_no_extension(scene: bpy.types.Scene, recorded: dict[str, Path], tmp_path: Path) -> None:
    """What is saved moves on a computer without the extension."""
    from test_people import vertices

    scene.throng.armatures, scene.throng.crowd_level = 5, "blocks"
    bpy.ops.throng.open_trajectory(filepath=str(recorded["rec"]))

    def places() -> list[np.ndarray]:
        bpy.context.scene.frame_set(90)
        return [vertices(bpy.data.objects[name]) for name in ("Crowd", "Body_1", "Body_2")]

    before = places()
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "crowd.blend"))
    throng.unregister()
    try:
        bpy.ops.wm.read_factory_settings(use_empty=True)
        bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "crowd.blend"))
        assert not hasattr(bpy.context.scene, "throng")
        for mine, other in zip(places(), before, strict=True):
            assert np.array_equal(mine, other)
    finally:
        throng.register()
