"""Agents that are not people: instances of a body of their group, by geometry nodes."""

from collections.abc import Iterator

import bmesh
import bpy
import numpy as np
import throng_sim as tg

from . import bodies, quaternions, table
from .clip import Clip
from .nodes import Tree

SIDES = 24
HEIGHT = 0.4
"""Height of an agent on the ground, metres."""


def agents(clip: Clip, rows: list[int], parent: bpy.types.Object, into: bpy.types.Collection) -> Iterator[float]:
    """Adds instances for the agents of some rows. Yields the share that is done."""
    crowd, spans, origin = clip.trajectories, clip.spans()[rows], clip.origin()
    frames, interval = table.moments(clip, bpy.context.scene.throng.pose_rate)
    table.check(len(rows), len(frames), 1)
    places = np.empty((len(frames), len(rows), 1, 3), np.float32)
    turns = np.empty((len(frames), len(rows), 1, 4), np.float32)
    positions, headings = crowd.states(clip.times(frames).clip(crowd.times[0], crowd.times[-1]))
    for column, row in enumerate(rows):
        places[:, column, 0] = table.hold(positions[row] - origin)
        turns[:, column, 0] = quaternions.about_z(table.hold(headings[row]))
    yield 0.5
    tracks = table.build("Tracks", clip, interval, places, turns)
    mesh = bpy.data.meshes.new("Agents")
    mesh.vertices.add(len(rows))
    for name, values in (
        ("agent", np.arange(len(rows))),
        ("number", crowd.ids[rows].astype(np.int64)),
        ("group", crowd.groups[rows].astype(np.int64)),
        ("radius", crowd.radii[rows]),
        ("from", spans[:, 0]),
        ("to", spans[:, 1]),
    ):
        table.number(mesh, name, values)
    made = bpy.data.objects.new("Agents", mesh)
    for thing in (tracks.points, made):
        into.objects.link(thing)
        thing.parent = parent
    made.modifiers.new("Tracks", "NODES").node_group = _nodes(tracks, _prototypes(crowd), crowd.in_space)
    yield 1.0


def _prototypes(crowd: tg.Trajectories) -> bpy.types.Collection:
    """Returns a body of radius 1 m for each group, in the order of their names."""
    into = bpy.data.collections.new("Throng bodies")
    for group, (name, color) in enumerate(zip(crowd.group_names, tg.plot.palette(len(crowd.group_names)), strict=True)):
        mesh = bpy.data.meshes.new(name)
        made = bmesh.new()
        if crowd.in_space:
            bmesh.ops.create_cone(made, cap_ends=True, segments=3, radius1=0.7, radius2=0, depth=2)
            turn = np.array([[0, 0, 1], [0, 1, 0], [-1, 0, 0]])
            for vertex in made.verts:
                vertex.co = turn @ vertex.co
        else:
            bmesh.ops.create_cone(made, cap_ends=True, segments=SIDES, radius1=1, radius2=0.92, depth=HEIGHT)
            bmesh.ops.translate(made, verts=made.verts, vec=(0, 0, HEIGHT / 2))
        made.to_mesh(mesh)
        made.free()
        linear = [(int(color[at : at + 2], 16) / 255) ** 2.2 for at in (1, 3, 5)]
        mesh.materials.append(bodies.material(f"Group {name}", tuple(linear)))
        into.objects.link(bpy.data.objects.new(f"Body {group:04} {name}", mesh))
    return into


def _nodes(tracks: table.Table, prototypes: bpy.types.Collection, flies: bool) -> bpy.types.NodeTree:
    """Returns the nodes that put an instance where each agent is."""
    tree = Tree("Throng agents")
    place, turn = tracks.read(tree, tracks.current(tree), tree.attribute("agent", "INT"), 0)
    here = tree.node(
        "GeometryNodeDeleteGeometry", {"domain": "POINT"}, Geometry=tree.geometry, Selection=table.absent(tree)
    )
    moved = tree.node("GeometryNodeSetPosition", Geometry=here.outputs[0], Position=place)
    bodies_of = tree.node(
        "GeometryNodeCollectionInfo", Collection=prototypes, Separate_Children=True, Reset_Children=True
    )
    radius = tree.attribute("radius", "FLOAT")
    size = tree.node("ShaderNodeCombineXYZ", X=radius, Y=radius, Z=radius if flies else 1.0)
    made = tree.node(
        "GeometryNodeInstanceOnPoints",
        Points=moved.outputs[0],
        Instance=bodies_of.outputs[0],
        Pick_Instance=True,
        Instance_Index=tree.attribute("group", "INT"),
        Rotation=turn,
        Scale=size.outputs[0],
    )
    return tree.end(made.outputs[0])
