"""Camera, light and sky; the rendered frame."""

from pathlib import Path

import bpy
import numpy as np
import pytest
from bpy_extras.object_utils import world_to_camera_view
from mathutils import Vector
from throng import crowds


def seen(scene: bpy.types.Scene) -> np.ndarray:
    """Returns where heads and feet are in the picture: 0 to 1 from left to right and from the bottom up, and the depth."""
    bpy.context.view_layer.update()
    found = []
    for thing in scene.objects:
        if thing.type == "ARMATURE" and thing.scale.x > 1e-6:
            x, y, z = thing.matrix_world.translation
            found += [world_to_camera_view(scene, scene.camera, Vector((x, y, z + up))) for up in (0, 1.8)]
    return np.array(found)


@pytest.mark.parametrize(("width", "height"), [(640, 360), (300, 900)])
def test_the_camera_sees_all(scene: bpy.types.Scene, recorded: dict[str, Path], width: int, height: int) -> None:
    scene.render.resolution_x, scene.render.resolution_y = width, height
    bpy.ops.throng.open_trajectory(filepath=str(recorded["rec"]))
    reach = []
    for frame in range(1, scene.frame_end, 20):
        scene.frame_set(frame)
        reach.append(seen(scene))
        assert (reach[-1][:, :2] > 0).all() and (reach[-1][:, :2] < 1).all() and (reach[-1][:, 2] > 0).all()
    whole = np.concatenate(reach)[:, :2]
    margins = np.array([whole.min(axis=0), 1 - whole.max(axis=0)])
    assert np.abs(margins[0] - margins[1]).max() < 0.1, "it is in the middle"
    assert np.ptp(whole, axis=0).max() > 0.85, "the crowd fills the picture"


@pytest.mark.parametrize("rows", ["0,1,2,3\n", "0,1,2,3\n0.5,1,2,3\n1,1,2,3\n", "0,1,2,3\n0,2,2,3\n0,3,2,5\n"])
def test_few_people_in_one_place(scene: bpy.types.Scene, tmp_path: Path, rows: str) -> None:
    (tmp_path / "few.csv").write_text("time,number,x,y\n" + rows)
    bpy.ops.throng.open_trajectory(filepath=str(tmp_path / "few.csv"))
    found = seen(scene)[:, :2]
    assert (found > 0).all() and (found < 1).all()


def test_what_is_there_stays(scene: bpy.types.Scene, recorded: dict[str, Path]) -> None:
    camera = bpy.data.objects.new("Mine", bpy.data.cameras.new("Mine"))
    lamp = bpy.data.objects.new("Lamp", bpy.data.lights.new("Lamp", "AREA"))
    for thing in (camera, lamp):
        scene.collection.objects.link(thing)
    scene.camera, scene.world = camera, bpy.data.worlds.new("Studio")
    bpy.ops.throng.open_trajectory(filepath=str(recorded["rec"]))
    assert (scene.camera, scene.world.name) == (camera, "Studio")
    assert [light.name for light in bpy.data.lights] == ["Lamp"]
    assert camera.location.length == 0
    bpy.ops.throng.frame_crowd()
    assert camera.location.length > 5
    camera.data.type = "ORTHO"
    with pytest.raises(RuntimeError, match="Mine is not in perspective"):
        bpy.ops.throng.frame_crowd()


def test_no_stage_and_range(scene: bpy.types.Scene, recorded: dict[str, Path]) -> None:
    scene.throng.has_stage = scene.throng.fit_range = False
    scene.frame_end = 77
    bpy.ops.throng.open_trajectory(filepath=str(recorded["rec"]))
    assert (scene.camera, scene.frame_end) == (None, 77)
    with pytest.raises(RuntimeError, match="no camera"):
        bpy.ops.throng.render_frame()


def test_the_floor_plan(scene: bpy.types.Scene, tmp_path: Path) -> None:
    """Ground with its hole, and solids of the height that is set."""
    import throng_sim as tg

    ring = {"outer": [[0, 0], [10, 0], [10, 8], [0, 8]], "holes": [[[4, 3], [4, 5], [6, 5], [6, 3]]]}
    plan = tg.Scene()
    plan["walkable"] = {"polygons": [ring]}
    plan._append("obstacle", {"shape": {"polygon": [[1, 1], [2, 1], [2, 2]]}})
    plan._append("obstacle", {"shape": {"wall": [[8, 1], [8, 4], [9, 4]]}})
    plan.group(at=[(3, 6)], goal=(9, 6))
    plan.run(record=25, until=2).save(tmp_path / "plan.rec")
    scene.throng.wall_height = 3
    bpy.ops.throng.open_trajectory(filepath=str(tmp_path / "plan.rec"))
    ground = bpy.data.objects["Ground"].data
    assert abs(sum(face.area for face in ground.polygons) - 76) < 1e-3
    assert all(face.normal.z > 0.99 for face in ground.polygons)
    solids = bpy.data.objects["Obstacles"]
    assert abs(solids.dimensions.z - 3) < 1e-5
    import bmesh

    made = bmesh.new()
    made.from_mesh(solids.data)
    # half a square, and two walls with their ends
    assert abs(made.calc_volume(signed=True) - 3 * (0.5 + 0.1 * 3.1 + 0.1 * 1.1)) < 1e-3
    made.free()


def test_a_rendered_frame(scene: bpy.types.Scene, recorded: dict[str, Path], tmp_path: Path) -> None:
    bpy.ops.throng.open_trajectory(filepath=str(recorded["rec"]))
    scene.frame_set(60)
    scene.render.engine, scene.cycles.samples, scene.cycles.device = "CYCLES", 4, "CPU"
    scene.render.resolution_x, scene.render.resolution_y = 320, 180
    scene.render.filepath = str(tmp_path / "frame.png")
    bpy.ops.throng.render_frame()
    picture = bpy.data.images.load(str(tmp_path / "frame.png"))
    assert tuple(picture.size) == (320, 180)
    pixels = np.empty(320 * 180 * 4, np.float32)
    picture.pixels.foreach_get(pixels)
    colors = pixels.reshape(180, 320, 4)[..., :3]
    # people are what is coloured: they are where the camera has them
    vivid = np.ptp(colors, axis=2) > 0.15
    places = seen(scene)
    columns = places[:, 0] * 320
    found = np.flatnonzero(vivid.any(axis=0))
    assert vivid.sum() > 50
    assert columns.min() - 12 < found.min() and found.max() < columns.max() + 12
    assert crowds.SEEN in bpy.data.objects["run"]
