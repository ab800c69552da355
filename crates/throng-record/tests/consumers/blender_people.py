"""Blender imports people: python blender_people.py RUN.usda RUN.glb PICTURE.png [NUMBER.bvh ...] (of the same run; needs bpy).

The joints of the armatures of each file are compared with those of the .glb, which are computed by the specification of glTF.
"""
import os
import pathlib
import sys

import bpy
import numpy as np
from mathutils import Vector

from picture import render
from skins import Skins

usda, glb, picture = (os.path.abspath(name) for name in sys.argv[1:4])
skins = Skins(glb)
times = [*skins.times[:: max(1, len(skins.times) // 5)], skins.times[-1]]


def compare(name, armatures, frame_of):
    """Compares the heads of the bones of armatures (by number) with the joints."""
    compared, worst = 0, 0
    for time in times:
        frame = frame_of(time)
        bpy.context.scene.frame_set(int(frame // 1), subframe=frame % 1)
        depsgraph = bpy.context.evaluated_depsgraph_get()
        for number, armature in armatures.items():
            placed = armature.evaluated_get(depsgraph)
            if not skins.there(number, time):
                assert max(placed.matrix_world.to_scale()) < 1e-4, (name, number, time)
                continue
            for joint, want in skins.joints(number, time).items():
                bone = next(bone for bone in placed.pose.bones if bone.name.split(".")[0] == joint)
                off = np.linalg.norm(np.array(placed.matrix_world @ bone.head) - want)
                worst, compared = max(worst, off), compared + 1
                assert off < 0.015, (name, number, time, joint, placed.matrix_world @ bone.head, want)
    print(f"{name}: {len(armatures)} armatures, {compared} joints within {1e3 * worst:.1f} mm")


def fresh():
    bpy.ops.wm.read_factory_settings(use_empty=True)


def usd():
    bpy.ops.wm.usd_import(filepath=usda)
    codes = float(next(line.split("=")[1] for line in open(usda) if "timeCodesPerSecond" in line))
    armatures = {}
    for thing in bpy.data.objects:
        if thing.type == "ARMATURE":
            above = thing
            while not above.name.startswith("Agent_"):
                above = above.parent
            armatures[int(above.name.removeprefix("Agent_").split(".")[0])] = thing
    assert set(armatures) == set(skins.people), (len(armatures), len(skins.people))
    compare("usd", armatures, lambda time: round(time * codes, 6))
    return codes


def bvh(paths):
    scene = bpy.context.scene
    scene.render.fps, armatures = 100, {}
    for path in paths:
        known = set(bpy.data.objects)
        bpy.ops.import_anim.bvh(filepath=path, global_scale=0.01, axis_forward="-Z", axis_up="Y", use_fps_scale=True)
        (armature,) = set(bpy.data.objects) - known
        armatures[int(pathlib.Path(path).stem)] = armature
    first = {number: next(time for time in skins.times if skins.there(number, time)) for number in armatures}
    # the first frame of a file is the first of its person
    global times
    for number, armature in armatures.items():
        compare(f"bvh of {number}", {number: armature}, lambda time: max(1, 1 + 100 * (time - first[number])))


fresh()
codes = usd()
middle = times[len(times) // 2]
hips = [Vector(skins.joints(number, middle)["Hips"]) for number in skins.people if skins.there(number, middle)]
render(picture, round(middle * codes, 6), hips, 3.0, 1.2)
fresh()
bvh(sys.argv[4:])
