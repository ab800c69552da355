"""Camera, sun and sky."""

import math

import bpy
import numpy as np
from mathutils import Vector
from mathutils.geometry import convex_hull_2d

from . import bodies

LOOK = (0.45, 1.0, -0.38)
"""Direction in which the camera looks at the crowd."""
TALL = 1.9
"""Height up to which people are seen, metres."""
FREE = 0.06
"""Free space around what the camera sees, relative to its size."""
SUN = (math.radians(50), 0.0, math.radians(-50))
"""Rotation of the sun: it shines from the left, past the camera."""
SUNLIGHT, SUN_COLOR = 4.5, (1.0, 0.94, 0.86)
"""Strength of the sun, W/m², and its colour."""
AIR, AIR_COLOR = 0.7, (0.44, 0.6, 0.85, 1)
"""Strength and colour of the sky."""


def build(scene: bpy.types.Scene, seen: np.ndarray, into: bpy.types.Collection) -> None:
    """Adds what the scene lacks of a camera that sees some points, (n, 3), a light and a sky."""
    if scene.camera is None:
        camera = bpy.data.objects.new("Throng camera", bpy.data.cameras.new("Throng camera"))
        into.objects.link(camera)
        scene.camera = camera
        frame(camera, seen)
    if not any(thing.type == "LIGHT" for thing in scene.objects):
        sun = bpy.data.objects.new("Throng sun", bpy.data.lights.new("Throng sun", "SUN"))
        sun.data.energy, sun.data.color, sun.data.angle, sun.rotation_euler = (
            SUNLIGHT,
            SUN_COLOR,
            math.radians(1.5),
            SUN,
        )
        into.objects.link(sun)
    if scene.world is None or scene.world.name == "World":
        scene.world = _sky()


def outline(points: np.ndarray) -> np.ndarray:
    """Returns the corners of the hull of points, seen from above, at their lowest height and above the heads: (n, 3)."""
    hull = points[convex_hull_2d(points[:, :2].tolist()), :2]
    heights = points[:, 2].min(), points[:, 2].max() + TALL
    return np.concatenate([np.c_[hull, np.full(len(hull), height)] for height in heights])


def frame(camera: bpy.types.Object, seen: np.ndarray) -> None:
    """Moves a perspective camera so that some points, (n, 3), fill its picture."""
    turn = Vector(LOOK).to_track_quat("-Z", "Y").to_matrix()
    # the points in the axes of the camera: right, up, back
    points = seen @ np.array(turn)
    corners = np.array(camera.data.view_frame(scene=bpy.context.scene))
    slopes = corners[:, :2] / -corners[:, 2:] / (1 + FREE)
    # in front of the planes through the camera and the sides of the picture: right and upper, then left and lower
    high, low = slopes.max(axis=0), -slopes.min(axis=0)
    before = (points[:, :2] + high * points[:, 2:]).max(axis=0)
    behind = (-points[:, :2] + low * points[:, 2:]).max(axis=0)
    back = ((before + behind) / (high + low)).max()
    depths = back - points[:, 2]
    beside = [
        _middle(points[:, axis], depths, (before[axis] - high[axis] * back, low[axis] * back - behind[axis]))
        for axis in (0, 1)
    ]
    camera.location = turn @ Vector((*beside, back))
    camera.rotation_euler = turn.to_euler()
    camera.data.clip_end = max(camera.data.clip_end, 100 * (back - points[:, 2].mean()))


def _middle(points: np.ndarray, depths: np.ndarray, within: tuple[float, float]) -> float:
    """Returns where a camera has points in the middle of its picture, along one of its axes; by bisection."""
    least, most = within
    for _ in range(40):
        middle = (least + most) / 2
        places = (points - middle) / depths
        least, most = (middle, most) if places.max() > -places.min() else (least, middle)
    return middle


def _sky() -> bpy.types.World:
    """Returns a clear sky without a sun of its own."""
    world = bpy.data.worlds.new("Throng sky")
    background = next(node for node in bodies.with_nodes(world).nodes if node.type == "BACKGROUND")
    background.inputs["Color"].default_value = AIR_COLOR
    background.inputs["Strength"].default_value = AIR
    return world
