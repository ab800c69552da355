"""Blender imports what throng wrote: python blender.py RUN.usda RUN.glb RUN.csv PICTURE.png (of the same run; needs bpy).

Every frame's positions, directions and who is there are compared with the table, of either file; the picture is of the middle frame of
the USD file, beside that of the glTF file.
"""
import csv
import json
import math
import os
import sys

import bpy
from mathutils import Quaternion, Vector

from picture import render

usda, glb, table = sys.argv[1:4]
# Blender has a folder of its own
picture = os.path.abspath(sys.argv[4])
moments = {}
for row in csv.DictReader(open(table, newline="")):
    moments.setdefault(float(row["time"]), {})[int(row["number"])] = row
times = sorted(moments)
# some, and the last
times = sorted({*times[:: max(1, len(times) // 40)], times[-1]})


def fresh():
    bpy.ops.wm.read_factory_settings(use_empty=True)


def compare(number, row, place, ahead, error, turn):
    want = Vector([float(row["x"]), float(row["y"]), float(row.get("z", 0))])
    assert (place - want).length < error, (number, row, place)
    off = (math.atan2(ahead.y, ahead.x) - float(row["heading"]) + math.pi) % (2 * math.pi) - math.pi
    assert abs(off) * ahead.xy.length < turn, (number, row, ahead)


def usd():
    """Points, and who is seen of them."""
    bpy.ops.wm.usd_import(filepath=usda)
    scene, agents = bpy.context.scene, bpy.data.objects["Agents"]
    nodes = next(modifier for modifier in agents.modifiers if modifier.type == "NODES")
    # time codes are frames; theirs may be 24ths of a second
    codes = float(next(line.split("=")[1] for line in open(usda) if "timeCodesPerSecond" in line))
    written = json.loads(next(line.split("=")[1] for line in open(usda) if "int64[] ids" in line))
    compared = 0
    for time in times:
        frame = round(time * codes, 6)
        scene.frame_set(int(frame // 1), subframe=frame % 1)
        depsgraph = bpy.context.evaluated_depsgraph_get()
        seen = [i for i in depsgraph.object_instances if i.is_instance and i.object.name.split(".")[0] == "Body"]
        # people are drawn by their own skeletons: blender_people.py
        drawn = [number for number in moments[time] if f"Agent_{number}" not in bpy.data.objects]
        assert len(seen) == len(drawn), (time, len(seen), len(drawn))
        nodes.show_viewport = False
        points = agents.evaluated_get(bpy.context.evaluated_depsgraph_get()).data.attributes
        # Blender 5.0 leaves the ids in the file
        ids, masks = [id.value for id in points["id"].data] if "id" in points else written, points["mask"].data
        assert len(ids) == len(masks)
        for at, (number, mask) in enumerate(zip(ids, masks)):
            row = moments[time].get(number)
            assert mask.value == (row is not None), (time, number)
            if row:
                place = agents.matrix_world @ Vector(points["position"].data[at].vector)
                ahead = Quaternion(points["orientation"].data[at].value) @ Vector((1, 0, 0))
                compare(number, row, place, ahead, 2e-4, math.radians(0.15))
                compared += 1
        nodes.show_viewport = True
    print(f"usd: {len(ids)} points, {len(times)} frames, {compared} places equal")


def gltf():
    """An object an agent."""
    fps = 100
    bpy.context.scene.render.fps = fps
    bpy.ops.import_scene.gltf(filepath=glb)
    agents = {o["number"]: o for o in bpy.data.objects if "number" in o}
    compared = 0
    for time in times:
        frame = (time - times[0]) * fps
        bpy.context.scene.frame_set(int(frame // 1), subframe=frame % 1)
        for number, agent in agents.items():
            row = moments[time].get(number)
            place, rotation, scale = agent.matrix_world.decompose()
            assert (max(scale) > 1e-6) == (row is not None), (time, number, scale)
            if row:
                assert agent["group"] == row["group"]
                # Blender turns meshes of glTF so that y is up: what faced +z faces -y
                compare(number, row, place, rotation @ Vector((0, -1, 0)), 2e-3, math.radians(0.6))
                compared += 1
    print(f"gltf: {len(agents)} objects, {len(times)} frames, {compared} places equal")


middle = times[len(times) // 2]
fresh()
usd()
codes = float(next(line.split("=")[1] for line in open(usda) if "timeCodesPerSecond" in line))
places = [Vector([float(row["x"]), float(row["y"]), float(row.get("z", 0))]) for row in moments[middle].values()]
render(picture, middle * codes, places, 6.0, 1.5)
fresh()
gltf()
render(picture.replace(".png", "-glb.png"), (middle - times[0]) * 100, places, 6.0, 1.5)
