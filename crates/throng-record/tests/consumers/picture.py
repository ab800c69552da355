"""A picture of a crowd by Blender's Cycles."""

import bpy
from mathutils import Matrix, Vector


def render(path, frame, places, least, share):
    """Renders a frame. The camera is as far away as half of the places are from their middle, times `share`, and at least
    `least` metres."""
    scene = bpy.context.scene
    scene.frame_set(int(frame // 1), subframe=frame % 1)
    middle = sum(places, Vector()) / len(places)
    wide = max(least, share * sorted((place - middle).length for place in places)[len(places) // 2])
    camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    camera.location = middle + Vector((-0.4, -1.3, 0.9)) * wide
    camera.rotation_euler = (middle - camera.location).to_track_quat("-Z", "Y").to_euler()
    sun = bpy.data.objects.new("Sun", bpy.data.lights.new("Sun", "SUN"))
    sun.data.energy, sun.matrix_world = 3, Matrix.Rotation(0.7, 4, Vector((1, 0.4, 0)))
    scene.world = bpy.data.worlds.new("Sky")
    for thing in (camera, sun):
        scene.collection.objects.link(thing)
    scene.camera = camera
    render = scene.render
    # the one engine that needs no display
    render.engine, scene.cycles.samples, scene.cycles.device = "CYCLES", 16, "CPU"
    scene.cycles.use_denoising = False
    render.resolution_x, render.resolution_y, render.filepath = 800, 450, path
    bpy.ops.render.render(write_still=True)
