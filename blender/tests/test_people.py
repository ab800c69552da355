"""People in Blender stand where Blender's own importer of glTF puts the people of the same run."""

import math
from pathlib import Path

import bpy
import numpy as np
import pytest
from throng_sim import Trajectories, figure

FRAMES = (1, 2, 30, 77, 150, 228, 260)


def joints(armature: bpy.types.Object) -> np.ndarray:
    """Returns where the joints of a person are in the world: (19, 3)."""
    at = armature.matrix_world
    return np.array([at @ armature.pose.bones[joint].head for joint in figure.JOINTS])


def vertices(thing: bpy.types.Object) -> np.ndarray:
    """Returns where the vertices of an object are in the world."""
    evaluated = thing.evaluated_get(bpy.context.evaluated_depsgraph_get())
    mesh = evaluated.to_mesh()
    mesh.transform(evaluated.matrix_world)
    places = np.empty(len(mesh.vertices) * 3, np.float32)
    mesh.vertices.foreach_get("co", places)
    evaluated.to_mesh_clear()
    return places.reshape(-1, 3)


def people() -> dict[int, bpy.types.Object]:
    """Returns the armatures of the scene that have a size at the current frame, by number."""
    armatures = [thing for thing in bpy.context.scene.objects if thing.type == "ARMATURE"]
    return {thing["number"]: thing for thing in armatures if max(thing.matrix_world.to_scale()) > 1e-6}


def by_frame(read) -> dict[int, dict]:
    """Returns what `read` returns at each frame."""
    found = {}
    for frame in FRAMES:
        bpy.context.scene.frame_set(frame)
        found[frame] = read()
    return found


def all_joints() -> dict[int, np.ndarray]:
    return {number: joints(armature) for number, armature in people().items()}


def all_vertices() -> dict[int, np.ndarray]:
    return {number: vertices(bpy.data.objects[f"Body_{number}"]) for number in people()}


def worn_vertices() -> dict[int, np.ndarray]:
    """Returns the vertices of what people wear: the others have no faces, and the importer of .glb leaves them out."""

    def of(number: int, places: np.ndarray) -> np.ndarray:
        loops = bpy.data.objects[f"Body_{number}"].data.loops
        used = np.empty(len(loops), np.int32)
        loops.foreach_get("vertex_index", used)
        return places[np.unique(used)]

    return {number: of(number, places) for number, places in all_vertices().items()}


@pytest.fixture(scope="module")
def imported(recorded: dict[str, Path]) -> tuple[dict, dict]:
    """Joints and vertices of the people of the .glb, as Blender's own importer has them."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.context.scene.render.fps = 25
    bpy.ops.import_scene.gltf(filepath=str(recorded["glb"]))
    # the animation of a glTF begins at frame 0
    for curve in _curves():
        for key in curve.keyframe_points:
            key.co.x += 1
    return by_frame(all_joints), by_frame(all_vertices)


def _curves():
    for action in bpy.data.actions:
        yield from () if hasattr(action, "layers") else action.fcurves
        for layer in getattr(action, "layers", ()):
            for strip in layer.strips:
                for bag in strip.channelbags:
                    yield from bag.fcurves


def compare(found: dict[int, dict], expected: dict[int, dict], most: float) -> None:
    """Compares places at all frames, metres.

    The two plan their steps from motions that are rounded differently. Steps begin at moments that are 20 ms apart, so one of the people
    may take a step a moment earlier, and a foot moves by up to 4 m/s.
    """
    earlier = set()
    for frame in FRAMES:
        assert found[frame].keys() == expected[frame].keys(), frame
        for number, places in found[frame].items():
            off = np.linalg.norm(places - expected[frame][number], axis=1).max()
            assert off < most + 0.02 * 4, (frame, number, off)
            if off >= most:
                earlier.add(number)
    assert len(earlier) <= 1, earlier


def test_armatures_follow_gltf(scene: bpy.types.Scene, recorded: dict[str, Path], imported: tuple[dict, dict]) -> None:
    bpy.ops.throng.open_trajectory(filepath=str(recorded["rec"]))
    last = Trajectories.read(recorded["rec"]).times[-1]
    assert (scene.frame_start, scene.frame_end) == (1, 1 + math.floor(last * 25 + 1e-6))
    found = by_frame(all_joints)
    assert len({len(people) for people in found.values()}) > 2, "people enter and leave"
    # Files store the rotations of the upper body within 0.2 degrees about each axis. Over the five joints from the hips to
    # a hand this is up to 5 mm for a child of 1.2 m, and as much more as an adult of 1.75 m is taller.
    compare(found, imported[0], 5e-3 * 1.75 / 1.2)
    compare(by_frame(worn_vertices), imported[1], 5e-3 * 1.75 / 1.2)


def test_armatures_hold_their_poses(scene: bpy.types.Scene, recorded: dict[str, Path]) -> None:
    """Between the keys that are left out, joints are where the package computes them."""
    bpy.ops.throng.open_trajectory(filepath=str(recorded["rec"]))
    trajectories = Trajectories.read(recorded["rec"])
    for frame in range(1, scene.frame_end, 7):
        scene.frame_set(frame)
        expected, _ = trajectories.poses([(frame - 1) / 25], world=True)
        rows = dict(zip(trajectories.people, expected[:, 0], strict=True))
        present = {number for number, places in rows.items() if not np.isnan(places).any()}
        found = people()
        assert found.keys() == present
        for number, armature in found.items():
            off = np.linalg.norm(joints(armature) - rows[number], axis=1)
            assert off.max() < 4e-3, (frame, number, off)
            feet = [figure.JOINTS.index(joint) for joint in ("LeftFoot", "RightFoot", "LeftToeBase", "RightToeBase")]
            assert off[feet].max() < 2e-3, (frame, number, off)


@pytest.mark.parametrize(("rate", "most"), [(25, 4e-3), (12.5, 8e-2)])
def test_one_mesh_is_as_armatures(scene: bpy.types.Scene, recorded: dict[str, Path], rate: float, most: float) -> None:
    bpy.ops.throng.open_trajectory(filepath=str(recorded["rec"]))
    expected = by_frame(all_vertices)
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.render.fps = 25
    scene.throng.armatures, scene.throng.crowd_level, scene.throng.pose_rate = 0, "fine", rate
    bpy.ops.throng.open_trajectory(filepath=str(recorded["rec"]))
    assert not [thing for thing in scene.objects if thing.type == "ARMATURE"]
    found = by_frame(lambda: vertices(bpy.data.objects["Crowd"]))
    for frame in FRAMES:
        whole = np.concatenate([expected[frame][number] for number in sorted(expected[frame])])
        assert whole.shape == found[frame].shape
        off = np.linalg.norm(whole - found[frame], axis=1).max()
        assert off < most, (frame, off)


def test_some_have_armatures(scene: bpy.types.Scene, recorded: dict[str, Path]) -> None:
    scene.throng.armatures, scene.throng.crowd_level = 5, "blocks"
    bpy.ops.throng.open_trajectory(filepath=str(recorded["rec"]))
    scene.frame_set(10)
    assert len(people()) == 5
    trajectories = Trajectories.read(recorded["rec"])
    builds = dict(zip(trajectories.ids, trajectories.builds, strict=True))
    armatures = {thing["number"] for thing in scene.objects if thing.type == "ARMATURE"}
    poses, _ = trajectories.poses([9 / 25], world=True)
    present = [number for number, rows in zip(trajectories.people, poses[:, 0], strict=True) if not np.isnan(rows).any()]
    others = [builds[number] for number in present if number not in armatures]
    assert len(others) == 7
    expected = sum(len(figure.mesh(build, "blocks").positions) for build in others)
    assert len(vertices(bpy.data.objects["Crowd"])) == expected


def test_looks_are_shared(scene: bpy.types.Scene, recorded: dict[str, Path]) -> None:
    bpy.ops.throng.open_trajectory(filepath=str(recorded["rec"]))
    trajectories = Trajectories.read(recorded["rec"])
    bodies = [thing for thing in scene.objects if thing.name.startswith("Body_")]
    assert len({body.data for body in bodies}) == len(set(zip(trajectories.builds, trajectories.looks, strict=True)))
    assert {body.data.materials[0].name for body in bodies} == {"People"}
    assert len(bpy.data.armatures) == len(set(trajectories.builds))
    body = bodies[0]
    look = trajectories.looks[trajectories.ids == int(body.name.removeprefix("Body_"))][0]
    colors = np.empty(len(body.data.vertices) * 4, np.float32)
    body.data.color_attributes["Color"].data.foreach_get("color_srgb", colors)
    mesh = figure.mesh(trajectories.builds[0], "fine")
    assert np.abs(colors.reshape(-1, 4)[:, :3] * 255 - figure.colors(int(look))[mesh.regions]).max() < 1


def test_other_frame_rates(scene: bpy.types.Scene, recorded: dict[str, Path]) -> None:
    """The frames of the scene are used, whatever the rate of the file."""
    scene.render.fps, scene.throng.start = 24, 101
    bpy.ops.throng.open_trajectory(filepath=str(recorded["csv"]))
    scene.frame_set(101 + 48)
    expected, _ = Trajectories.read(recorded["csv"]).poses([2.0], ids=[3], world=True)
    assert np.linalg.norm(joints(people()[3]) - expected[0, 0], axis=1).max() < 4e-3
