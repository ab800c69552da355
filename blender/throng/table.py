"""Stored motion: a mesh with a point for each stored frame, row and joint, which geometry nodes read."""

from dataclasses import dataclass

import bpy
import numpy as np

from .clip import Clip
from .nodes import Socket, Tree

MOST = 2 * 1024**3
"""The largest table, bytes."""
POINT = 28
"""Size of a point, bytes: three numbers of its position, four of its rotation."""
TURN = "turn"
HAS_WHOLE = hasattr(bpy.types, "FunctionNodeIntegerMath")
"""Whether this Blender computes with whole numbers, from 4.3 on."""
EXACT = 2**24
"""The most points that numbers with a fraction count exactly."""
SLACK = 1e-3
"""Frames nearer than this are equal."""


@dataclass(frozen=True)
class Table:
    """A table of positions and rotations."""

    points: bpy.types.Object
    start: int
    """The frame of the first stored moment."""
    interval: float
    """Frames from one stored moment to the next."""
    moments: int
    rows: int
    joints: int

    def current(self, tree: Tree) -> tuple[Socket, Socket, Socket]:
        """Returns the stored moments before and after the current frame, and the share of the way between them."""
        frame = tree.out(tree.node("GeometryNodeInputSceneTime"), "Frame")
        moment = tree.math("DIVIDE", tree.math("SUBTRACT", frame, self.start), self.interval)
        moment = tree.math("MINIMUM", tree.math("MAXIMUM", moment, 0.0), self.moments - 1)
        before = tree.math("FLOOR", moment)
        after = tree.math("MINIMUM", tree.math("ADD", before, 1.0), self.moments - 1)
        return before, after, tree.math("SUBTRACT", moment, before)

    def read(
        self, tree: Tree, current: tuple[Socket, Socket, Socket], row: Socket, joint: Socket | int
    ) -> tuple[Socket, Socket]:
        """Returns position and rotation of a joint of a row at the current frame."""
        before, after, share = current
        info = tree.node("GeometryNodeObjectInfo", {"transform_space": "ORIGINAL"}, Object=self.points)
        stored = tree.out(info, "Geometry")
        place = tree.out(tree.node("GeometryNodeInputPosition"), "Position")
        turn = tree.attribute(TURN, "QUATERNION")
        found = {"FLOAT_VECTOR": [], "QUATERNION": []}
        for moment in (before, after):
            index = whole(tree, "ADD", whole(tree, "MULTIPLY", moment, self.rows), row)
            index = whole(tree, "ADD", whole(tree, "MULTIPLY", index, self.joints), joint)
            found["FLOAT_VECTOR"].append(tree.sample(stored, "FLOAT_VECTOR", place, index))
            found["QUATERNION"].append(tree.sample(stored, "QUATERNION", turn, index))
        places, turns = found["FLOAT_VECTOR"], found["QUATERNION"]
        return tree.mix("VECTOR", *places, share), tree.mix("ROTATION", *turns, share)


def whole(tree: Tree, operation: str, *given: Socket | int) -> Socket:
    """Returns the result of an operation on whole numbers."""
    if not HAS_WHOLE:
        return tree.math(operation, *given)
    node = tree.node("FunctionNodeIntegerMath", {"operation": operation})
    for socket, value in zip(node.inputs, given, strict=False):
        tree.put(socket, value)
    return node.outputs[0]


def moments(clip: Clip, rate: float) -> tuple[np.ndarray, float]:
    """Returns the frames to store, with fractions, and their interval: at least `rate` a second, no more than frames."""
    interval = max(1.0, clip.fps / rate)
    count = int(np.ceil((clip.end - clip.start) / interval - SLACK)) + 1
    return clip.start + np.arange(count) * interval, interval


def check(rows: int, count: int, joints: int) -> None:
    """Refuses a table that is too large."""
    points = rows * count * joints
    if points > EXACT and not HAS_WHOLE:
        raise ValueError(
            f"{rows} agents at {count} stored moments are {points} points, more than {EXACT} in Blender before 4.3: "
            "choose fewer poses a second, or a shorter recording"
        )
    if points * POINT > MOST:
        raise ValueError(
            f"{rows} agents at {count} stored moments take {points * POINT / 1024**3:.1f} GB, more than "
            f"{MOST / 1024**3:.0f} GB: choose fewer poses a second, or a shorter recording"
        )


def build(name: str, clip: Clip, interval: float, places: np.ndarray, turns: np.ndarray) -> Table:
    """Returns a table of positions, (moments, rows, joints, 3), and rotations, (moments, rows, joints, 4)."""
    count, rows, joints, _ = places.shape
    mesh = bpy.data.meshes.new(name)
    mesh.vertices.add(count * rows * joints)
    mesh.vertices.foreach_set("co", places.astype(np.float32).ravel())
    mesh.attributes.new(TURN, "QUATERNION", "POINT").data.foreach_set("value", turns.astype(np.float32).ravel())
    points = bpy.data.objects.new(name, mesh)
    points.hide_render = points.hide_viewport = True
    return Table(points, clip.start, interval, count, rows, joints)


def hold(values: np.ndarray) -> np.ndarray:
    """Replaces what is not a number by the nearest row of the first axis that is: before, then after."""
    there = ~np.isnan(values).any(axis=tuple(range(1, values.ndim)))
    if not there.any():
        return np.zeros_like(values)
    known = np.flatnonzero(there)
    nearest = known[np.abs(np.arange(len(values))[:, None] - known).argmin(axis=1)]
    return values[nearest]


def absent(tree: Tree) -> Socket:
    """Whether the agent of a point is not there at the current frame: attributes `from` and `to`, frames."""
    frame = tree.out(tree.node("GeometryNodeInputSceneTime"), "Frame")
    early = tree.math("LESS_THAN", frame, tree.math("SUBTRACT", tree.attribute("from", "FLOAT"), SLACK))
    late = tree.math("GREATER_THAN", frame, tree.math("ADD", tree.attribute("to", "FLOAT"), SLACK))
    return tree.math("MAXIMUM", early, late)


def number(mesh: bpy.types.Mesh, name: str, values: np.ndarray) -> None:
    """Adds an attribute of the points of a mesh."""
    kind, key = {
        (1, "i"): ("INT", "value"),
        (1, "f"): ("FLOAT", "value"),
        (2, "f"): ("FLOAT_VECTOR", "vector"),
    }[values.ndim, values.dtype.kind]
    size = np.int32 if kind == "INT" else np.float32
    mesh.attributes.new(name, kind, "POINT").data.foreach_set(key, values.astype(size).ravel())
