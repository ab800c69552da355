"""A crowd in Blender: a vertex for each agent, which moves with the frames.

In Blender's text editor, or without a window: `blender --background --python blender.py`. The package must be installed in
Blender's own Python: `.../python/bin/python3.11 -m pip install throng_sim-*.whl`. Instances on the vertices (geometry nodes) are the
bodies.
"""

import bpy
import numpy as np

import throng_sim as tg

scene = tg.Scene("circle")
scene["time.step"] = 1 / bpy.context.scene.render.fps
world = scene.build()
states = {0: world.save()}

mesh = bpy.data.meshes.new("crowd")
mesh.from_pydata([(x, y, 0.0) for x, y in world.positions], [], [])
bpy.context.collection.objects.link(bpy.data.objects.new("crowd", mesh))


def show(scene: bpy.types.Scene, *_: object) -> None:
    """Moves the vertices to where the agents are in a frame, which may also be an earlier one."""
    frame = max(scene.frame_current - scene.frame_start, 0)
    last = max(known for known in states if known <= frame)
    world.load(states[last])
    world.step(frame - last)
    if frame % 25 == 0:
        states[frame] = world.save()
    places = np.zeros((len(world), 3), np.float32)
    places[:, :2] = world.positions
    mesh.vertices.foreach_set("co", places.ravel())
    mesh.update()


bpy.app.handlers.frame_change_pre.append(show)

if bpy.app.background:
    shown = np.empty((len(world), 3), np.float32)
    for frame in (101, 26, 51):
        bpy.context.scene.frame_set(frame)
        mesh.vertices.foreach_get("co", shown.ravel())
        alone = scene.build()
        alone.step(frame - 1)
        assert alone.hash() == world.hash(), f"frame {frame} is not the state after {frame - 1} steps"
        assert np.array_equal(shown[:, :2], alone.positions.astype(np.float32))
    print(f"Blender {bpy.app.version_string}: {len(world)} agents, frames in any order")
