"""Runs: of scenes, and of the objects of the file."""

import re

import bpy
import numpy as np
import pytest
from conftest import contents
from throng import shapes, simulation


def box(name: str, low: tuple, high: tuple, role: str = "INHERIT") -> bpy.types.Object:
    """Adds a box with a role."""
    (left, front, bottom), (right, back, top) = low, high
    corners = [
        (x, y, z) for z in (bottom, top) for x, y in ((left, front), (right, front), (right, back), (left, back))
    ]
    sides = [(k, (k + 1) % 4, 4 + (k + 1) % 4, 4 + k) for k in range(4)]
    return mesh(name, corners, [(3, 2, 1, 0), (4, 5, 6, 7), *sides], role)


def flat(
    name: str, left: float, front: float, right: float, back: float, role: str, height: float = 0.0
) -> bpy.types.Object:
    """Adds a rectangle that looks up."""
    corners = [(x, y, height) for x, y in ((left, front), (right, front), (right, back), (left, back))]
    return mesh(name, corners, [(0, 1, 2, 3)], role)


def mesh(name: str, corners: list, faces: list, role: str, edges: list = ()) -> bpy.types.Object:
    made = bpy.data.meshes.new(name)
    made.from_pydata(corners, edges, faces)
    return linked(name, made, role)


def curve(name: str, points: list, role: str, closed: bool = False) -> bpy.types.Object:
    """Adds a line."""
    made = bpy.data.curves.new(name, "CURVE")
    made.dimensions = "3D"
    line = made.splines.new("POLY")
    line.points.add(len(points) - 1)
    line.points.foreach_set("co", [part for x, y in points for part in (x, y, 0, 1)])
    line.use_cyclic_u = closed
    return linked(name, made, role)


def linked(name: str, data, role: str) -> bpy.types.Object:
    thing = bpy.data.objects.new(name, data)
    bpy.context.scene.collection.objects.link(thing)
    thing.throng.role = role
    return thing


@pytest.fixture
def room(scene: bpy.types.Scene) -> bpy.types.Scene:
    """A hall with a box and a curved wall in the way, one door, and people on both sides."""
    flat("Floor", -8, -5, 8, 5, "GROUND", 1.5)
    box("Box", (-1.5, -2, 1.5), (1.5, 2, 3.2), "OBSTACLE")
    curve("Bend", [(-1.5, 4.8), (0, 3.6), (1.5, 4.8)], "OBSTACLE")
    box("Beam", (-8, -0.3, 4), (8, 0.3, 4.4), "OBSTACLE")
    west = flat("West", -7.5, -4, -4, 4, "START", 1.5)
    east = flat("East", 4, -4, 7.5, 4, "START", 1.5)
    west.throng.people, east.throng.people = 30, 20
    west.throng.goal = flat("East end", 6, -4, 7.9, 4, "GOAL", 1.5)
    east.throng.goal = flat("West end", -7.9, -4, -6, 4, "GOAL", 1.5)
    scene.throng.seconds = 15
    return scene


def test_no_person_crosses_an_obstacle(room: bpy.types.Scene) -> None:
    bpy.ops.throng.run_scene(source="OBJECTS")
    armatures = [thing for thing in room.objects if thing.type == "ARMATURE"]
    assert len(armatures) == 50
    crossed = 0
    for frame in range(1, room.frame_end + 1, 5):
        room.frame_set(frame)
        for armature in armatures:
            if armature.scale.x > 1e-6:
                x, y, z = armature.matrix_world.translation
                assert abs(z - 1.5) < 1e-5, "people walk on the floor"
                assert abs(x) < 8 and abs(y) < 5
                # the bodies have a radius of 0.2 m
                beside = max(abs(x) - 1.5, 0), max(abs(y) - 2, 0)
                assert np.hypot(*beside) > 0.15, (frame, armature.name, x, y)
                roof = 4.8 - 0.8 * (1.5 - abs(x))
                assert abs(x) > 1.5 or abs(y - roof) > 0.12, (frame, armature.name, x, y)
                crossed += abs(x) < 1
    assert crossed > 50, "people pass the obstacles"
    # the beam is over their heads
    assert not [thing for thing in room.objects if thing.name.startswith(("Ground", "Obstacles"))], (
        "the file has its own"
    )


def test_a_run_is_repeatable(room: bpy.types.Scene) -> None:
    first = simulation.scene_of_objects(bpy.context)[0].toml
    assert simulation.scene_of_objects(bpy.context)[0].toml == first
    run = simulation.scene_of_objects(bpy.context)[0].run(until=3, threads=1)
    assert simulation.scene_of_objects(bpy.context)[0].run(until=3, threads=2).hash == run.hash


def test_scene_of_the_gallery(scene: bpy.types.Scene) -> None:
    scene.throng.scene, scene.throng.seconds = "circle", 2
    bpy.ops.throng.run_scene()
    assert len([thing for thing in scene.objects if thing.type == "ARMATURE"]) == 36
    assert scene.frame_end == 51


@pytest.mark.parametrize("armatures", [0, 200])
def test_undo_removes_all(scene: bpy.types.Scene, armatures: int) -> None:
    scene.throng.scene, scene.throng.seconds, scene.throng.armatures = "circle", 0.4, armatures
    bpy.ops.ed.undo_push(message="before")
    before = contents()
    bpy.ops.throng.run_scene()
    bpy.ops.ed.undo_push(message="after")
    assert contents() != before
    bpy.ops.ed.undo()
    assert contents() == before
    bpy.ops.ed.redo()
    assert contents() != before


@pytest.mark.parametrize("missing", ["START", "GOAL"])
def test_what_is_missing_is_named(room: bpy.types.Scene, missing: str) -> None:
    for thing in room.objects:
        thing.throng.goal = None
        if thing.throng.role == missing:
            thing.throng.role = "NONE"
    before = contents()
    with pytest.raises(RuntimeError, match=f"no object is a {missing.lower()}: select"):
        bpy.ops.throng.run_scene(source="OBJECTS")
    assert contents() == before


def wrong_goal(room: bpy.types.Scene) -> None:
    bpy.data.objects["East end"].throng.role = "NONE"


def no_area(room: bpy.types.Scene) -> None:
    curve("Line", [(0, 0), (1, 1)], "START")


def no_shape(room: bpy.types.Scene) -> None:
    linked("Lamp", bpy.data.lights.new("Lamp", "POINT"), "OBSTACLE")


def upside_down(room: bpy.types.Scene) -> None:
    bpy.data.meshes["Floor"].flip_normals()


def all_covered(room: bpy.types.Scene) -> None:
    box("Block", (-9, -9, 1), (9, 9, 9), "OBSTACLE")


@pytest.mark.parametrize(
    ("change", "what"),
    [
        (wrong_goal, "West sends people to East end, which is no visible goal"),
        (no_area, "Line has no area, seen from above"),
        (no_shape, "Lamp has no shape"),
        (upside_down, "Floor is ground, but none of its faces look up"),
        (all_covered, "obstacles cover all ground"),
    ],
)
def test_errors_name_the_object(room: bpy.types.Scene, change, what: str) -> None:
    change(room)
    before = contents()
    with pytest.raises(RuntimeError, match=re.escape(what)):
        bpy.ops.throng.run_scene(source="OBJECTS")
    assert contents() == before


def test_errors_of_scenes(scene: bpy.types.Scene, tmp_path) -> None:
    wrong = tmp_path / "wrong.toml"
    wrong.write_text("[[group]]\nplace.point = [0, 0]\nspeeed.preferred = 1\n")
    for name, what in ((str(wrong), "speeed"), ("doorwya", "doorway")):
        scene.throng.scene = name
        with pytest.raises(RuntimeError, match=what):
            bpy.ops.throng.run_scene()


def size(outlines: list) -> float:
    """Returns the area that outlines cover together, by counting points of a grid."""
    step = 0.05
    x, y = np.meshgrid(np.arange(-6, 6, step) + step / 2, np.arange(-6, 6, step) + step / 2)
    inside = np.zeros(x.shape, bool)
    for outline in outlines:
        odd = np.zeros(x.shape, bool)
        for (ax, ay), (bx, by) in zip(outline, [*outline[1:], outline[0]], strict=True):
            if ay != by:
                odd ^= ((ay > y) != (by > y)) & (x < ax + (y - ay) * (bx - ax) / (by - ay))
        inside |= odd
    return inside.sum() * step**2


def test_footprints(scene: bpy.types.Scene) -> None:
    """What is higher than two metres does not count; what reaches higher counts where it is cut."""

    def solid(thing: bpy.types.Object) -> float:
        found = size(shapes.of(bpy.context).solids)
        thing.throng.role = "NONE"
        return found

    assert abs(solid(box("High", (0, 0, 0), (2, 1, 5), "OBSTACLE")) - 2) < 0.02
    assert abs(solid(box("Low", (0, 0, 0), (2, 1, 0.3), "OBSTACLE")) - 2) < 0.02
    assert abs(solid(box("Sunk", (0, 0, -1), (2, 1, 0.8), "OBSTACLE")) - 2) < 0.02
    assert solid(box("Lamp", (0, 0, 2.5), (2, 1, 3), "OBSTACLE")) == 0
    assert abs(solid(flat("Pond", 0, 0, 3, 1, "OBSTACLE")) - 3) < 0.02
    # a gate: two posts and a lintel, one closed mesh from the side
    profile = [(-2, 0), (-1, 0), (-1, 2.2), (1, 2.2), (1, 0), (2, 0), (2, 3), (-2, 3)]
    corners = [(x, y, z) for y in (0, 1) for x, z in profile]
    sides = [(k, (k + 1) % 8, 8 + (k + 1) % 8, 8 + k) for k in range(8)]
    gate = mesh("Gate", corners, [tuple(range(8)), tuple(range(15, 7, -1)), *sides], "OBSTACLE")
    assert abs(solid(gate) - 2) < 0.02
    # walls without thickness
    wall = mesh("Wall", [(0, 0, 0), (4, 0, 0), (4, 0, 3), (0, 0, 3)], [(0, 1, 2, 3)], "OBSTACLE")
    outlines = shapes.of(bpy.context).solids
    assert {round(abs(y), 3) for outline in outlines for _, y in outline} == {shapes.THIN / 2}
    wall.throng.role = "NONE"
    ring = curve("Fence", [(0, 0), (4, 0), (4, 2)], "OBSTACLE")
    assert len(shapes.of(bpy.context).solids) == 2
    ring.throng.role = "NONE"


def test_areas(scene: bpy.types.Scene) -> None:
    def area(thing: bpy.types.Object) -> float:
        return size([shapes.area(thing, bpy.context.evaluated_depsgraph_get())])

    bend = [(0, 0), (4, 0), (4, 1), (1, 1), (1, 4), (0, 4)]
    assert abs(area(curve("Bend", bend, "START", closed=True)) - 7) < 0.05
    assert abs(area(mesh("Angle", [(x, y, 0) for x, y in bend], [tuple(range(6))], "START")) - 7) < 0.05
    assert abs(area(box("Box", (0, 0, 0), (2, 1, 1), "GOAL")) - 2) < 0.02
    spot = linked("Spot", None, "GOAL")
    spot.empty_display_size, spot.scale = 1.0, (2, 2, 2)
    bpy.context.view_layer.update()
    assert abs(area(spot) - np.pi * 4) < 0.15


def test_roles_come_from_collections(scene: bpy.types.Scene) -> None:
    outer, inner = (bpy.data.collections.new(name) for name in ("Town", "Trees"))
    scene.collection.children.link(outer)
    outer.children.link(inner)
    outer.throng.role, inner.throng.role = "OBSTACLE", "NONE"
    things = {name: box(name, (0, 0, 0), (1, 1, 1)) for name in ("House", "Oak", "Door", "Far")}
    for name, collection in (("House", outer), ("Oak", inner), ("Door", outer)):
        scene.collection.objects.unlink(things[name])
        collection.objects.link(things[name])
    things["Door"].throng.role = "GOAL"
    found = shapes.roles(bpy.context)
    assert [thing.name for thing in found["OBSTACLE"]] == ["House"]
    assert [thing.name for thing in found["GOAL"]] == ["Door"]
    assert {thing.name for thing in found["NONE"]} == {"Far", "Oak"}
    things["House"].hide_set(True)
    assert not shapes.roles(bpy.context)["OBSTACLE"]


def test_too_many_people_for_an_area(room: bpy.types.Scene) -> None:
    bpy.data.objects["West"].throng.people = 2000
    with pytest.raises(RuntimeError, match="West"):
        bpy.ops.throng.run_scene(source="OBJECTS")


def test_two_crowds(scene: bpy.types.Scene) -> None:
    """A second crowd has objects of its own, and the camera can see both."""
    scene.throng.scene, scene.throng.seconds = "headon", 1
    bpy.ops.throng.run_scene()
    bpy.ops.throng.run_scene()
    roots = [thing for thing in scene.objects if "throng_seen" in thing]
    assert len(roots) == 2
    roots[1].location.x += 100
    before = scene.camera.location.copy()
    bpy.ops.throng.frame_crowd()
    assert (scene.camera.location - before).length > 50
    assert len([thing for thing in scene.objects if thing.type == "ARMATURE"]) == 4
    assert len([material for material in bpy.data.materials if material.name.startswith("People")]) == 1
