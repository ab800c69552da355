"""Camera, sun and sky."""

import math

import bpy
import numpy as np
from mathutils import Vector

LOOK = (0.45, 1.0, -0.5)
"""Direction in which the camera looks at the crowd."""
TALL = 1.9
"""Height up to which people are seen, metres."""
SUN = (math.radians(48), 0.0, math.radians(-35))
AIR = 0.6


def build(scene: bpy.types.Scene, low: np.ndarray, high: np.ndarray, into: bpy.types.Collection) -> None:
    """Adds what the scene lacks of a camera that sees all between two corners, a light and a sky."""
    if scene.camera is None:
        camera = bpy.data.objects.new("Throng camera", bpy.data.cameras.new("Throng camera"))
        into.objects.link(camera)
        scene.camera = camera
        frame(camera, low, high)
    if not any(thing.type == "LIGHT" for thing in scene.objects):
        sun = bpy.data.objects.new("Throng sun", bpy.data.lights.new("Throng sun", "SUN"))
        sun.data.energy, sun.data.angle, sun.rotation_euler = 3.0, math.radians(1.5), SUN
        into.objects.link(sun)
    if scene.world is None or scene.world.name == "World":
        scene.world = _sky()


def frame(camera: bpy.types.Object, low: np.ndarray, high: np.ndarray) -> None:
    """Moves a camera so that it sees all between two corners, up to the height of people."""
    camera.rotation_euler = Vector(LOOK).to_track_quat("-Z", "Y").to_euler()
    corners = [(x, y, z) for x in (low[0], high[0]) for y in (low[1], high[1]) for z in (low[2], high[2] + TALL)]
    bpy.context.view_layer.update()
    graph = bpy.context.evaluated_depsgraph_get()
    camera.location, _ = camera.camera_fit_coords(graph, [value for corner in corners for value in corner])
    camera.data.clip_end = max(camera.data.clip_end, 4 * (camera.location - Vector(corners[0])).length)


def _sky() -> bpy.types.World:
    """Returns a clear sky without a sun of its own."""
    world = bpy.data.worlds.new("Throng sky")
    world.use_nodes = True
    background = next(node for node in world.node_tree.nodes if node.type == "BACKGROUND")
    background.inputs["Color"].default_value = (0.52, 0.66, 0.85, 1)
    background.inputs["Strength"].default_value = AIR
    return world
