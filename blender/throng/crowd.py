"""People beyond the number of armatures: one mesh, which geometry nodes bend by stored poses."""

from collections.abc import Iterator

import bpy
import numpy as np
from throng_sim import figure

from . import bodies, table
from .clip import Clip
from .nodes import Tree

TOGETHER = 50
"""People whose poses are computed together."""


def people(clip: Clip, rows: list[int], parent: bpy.types.Object, into: bpy.types.Collection) -> Iterator[float]:
    """Adds the mesh of the people of some rows, and their stored poses. Yields the share that is done."""
    settings = bpy.context.scene.throng
    frames, interval = table.moments(clip, settings.pose_rate)
    joints = len(figure.JOINTS)
    table.check(len(rows), len(frames), joints)
    crowd, origin = clip.trajectories, clip.origin()
    places = np.empty((len(frames), len(rows), joints, 3), np.float32)
    turns = np.empty((len(frames), len(rows), joints, 4), np.float32)
    for first in range(0, len(rows), TOGETHER):
        part = rows[first : first + TOGETHER]
        for column, row in enumerate(part, first):
            times = clip.times_within(row, frames)
            place, turn = crowd.poses(times, ids=crowd.ids[[row]], world=True)
            places[:, column] = place[0] - origin
            turns[:, column] = turn[0]
        yield min(first + TOGETHER, len(rows)) / len(rows) * 0.9
    poses = table.build("Poses", clip, interval, places, turns)
    mesh = _mesh(clip, rows, settings.crowd_level)
    made = bpy.data.objects.new("Crowd", mesh)
    for thing in (poses.points, made):
        into.objects.link(thing)
        thing.parent = parent
    made.modifiers.new("Poses", "NODES").node_group = _nodes(poses)
    yield 1.0


def _mesh(clip: Clip, rows: list[int], level: str) -> bpy.types.Mesh:
    """Returns the bodies of people in one mesh, with the attributes that the nodes read."""
    crowd, spans = clip.trajectories, clip.spans()
    shapes = {build: (figure.mesh(build, level), bodies.rest(build)) for build in figure.BUILDS}
    points, triangles, colors, vertices = [], [], [], 0
    columns = {name: [] for name in ("person", "first", "second", "share", "from_first", "from_second", "from", "to")}
    for column, row in enumerate(rows):
        body, rest = shapes[crowd.builds[row]]
        height, count = crowd.heights[row], len(body.positions)
        # a vertex has at most two joints: the heaviest ones
        order = np.argsort(-body.weights, axis=1, kind="stable")[:, :2]
        first, second = np.take_along_axis(body.joints, order, axis=1).T.astype(np.int64)
        points.append(body.positions * height)
        triangles.append(body.triangles_of(int(crowd.looks[row])) + np.uint32(vertices))
        colors.append(bodies.colors(body, int(crowd.looks[row])))
        for name, values in (
            ("person", np.full(count, column)),
            ("first", first),
            ("second", second),
            ("share", np.take_along_axis(body.weights, order, axis=1)[:, 0]),
            ("from_first", (body.positions - rest[first]) * height),
            ("from_second", (body.positions - rest[second]) * height),
            ("from", np.full(count, spans[row, 0])),
            ("to", np.full(count, spans[row, 1])),
        ):
            columns[name].append(values)
        vertices += count
    mesh = bodies.shape("Crowd", np.concatenate(points), np.concatenate(triangles))
    mesh.materials.append(bodies.material("People"))
    bodies.paint(mesh, np.concatenate(colors))
    for name, values in columns.items():
        table.number(mesh, name, np.concatenate(values))
    return mesh


def _nodes(poses: table.Table) -> bpy.types.NodeTree:
    """Returns the nodes that bend the bodies: each vertex follows its two joints."""
    tree = Tree("Throng crowd")
    current, person = poses.current(tree), tree.attribute("person", "INT")
    ends = []
    for name in ("first", "second"):
        place, turn = poses.read(tree, current, person, tree.attribute(name, "INT"))
        beside = tree.node(
            "FunctionNodeRotateVector", Vector=tree.attribute(f"from_{name}", "FLOAT_VECTOR"), Rotation=turn
        )
        end = tree.node("ShaderNodeVectorMath", {"operation": "ADD"})
        tree.put(end.inputs[0], place)
        tree.put(end.inputs[1], beside.outputs[0])
        ends.append(end.outputs[0])
    second_share = tree.math("SUBTRACT", 1.0, tree.attribute("share", "FLOAT"))
    place = tree.mix("VECTOR", *ends, second_share)
    here = tree.node(
        "GeometryNodeDeleteGeometry", {"domain": "POINT"}, Geometry=tree.geometry, Selection=table.absent(tree)
    )
    moved = tree.node("GeometryNodeSetPosition", Geometry=here.outputs[0], Position=place)
    return tree.end(moved.outputs[0])
