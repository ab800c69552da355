"""Objects of the file, seen from above: ground, solid outlines, areas."""

import math
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field

import bmesh
import bpy
import numpy as np
import throng_sim as tg
from mathutils.geometry import convex_hull_2d

HEADROOM = 2.0
"""What is higher than this above the ground stops no one, metres."""
STEEPEST = math.cos(math.radians(45))
"""Least height of the unit normal of ground."""
THIN = 0.02
"""Thickness of lines and of faces on edge, metres."""
LEAST = 1e-6
"""Least area of a triangle, m²."""
MOST = 300_000
"""The largest number of triangles of an object."""
SIDES = 32

Outline = list[tuple[float, float]]


@dataclass
class Shapes:
    """What the objects of a scene are to the crowd."""

    ground: list[Outline] = field(default_factory=list)
    solids: list[Outline] = field(default_factory=list)
    starts: list[tuple[bpy.types.Object, Outline]] = field(default_factory=list)
    goals: dict[bpy.types.Object, Outline] = field(default_factory=dict)
    level: float = 0.0
    """Height of the ground, metres."""


def of(context: bpy.types.Context) -> Shapes:
    """Returns the shapes of all visible objects with a role."""
    graph, shapes, weights = context.evaluated_depsgraph_get(), Shapes(), []
    by_role = roles(context)
    for thing in by_role["GROUND"]:
        with _mesh(thing, graph) as made:
            outlines, heights = _floor(made)
        if not outlines:
            raise ValueError(
                f"{thing.name} is ground, but none of its faces look up: turn its normals, or choose another role"
            )
        shapes.ground += outlines
        weights += heights
    if weights:
        areas, heights = np.array(weights).T
        shapes.level = float((areas * heights).sum() / areas.sum())
    for thing in by_role["OBSTACLE"]:
        with _mesh(thing, graph) as made:
            shapes.solids += _footprint(made, shapes.level + HEADROOM)
    for thing in by_role["START"]:
        shapes.starts.append((thing, area(thing, graph)))
    shapes.goals = {thing: area(thing, graph) for thing in by_role["GOAL"]}
    return shapes


def roles(context: bpy.types.Context) -> dict[str, list[bpy.types.Object]]:
    """Returns the visible objects of each role, by name."""
    context.view_layer.update()
    found = {role: [] for role in ("INHERIT", "NONE", "GROUND", "OBSTACLE", "START", "GOAL")}
    inherited = dict(_inherited(context.scene.collection, "NONE"))
    for thing in sorted(context.view_layer.objects, key=lambda thing: thing.name):
        if thing.visible_get():
            own = thing.throng.role
            found[inherited.get(thing, "NONE") if own == "INHERIT" else own].append(thing)
    return found


def _inherited(collection: bpy.types.Collection, role: str) -> Iterator[tuple[bpy.types.Object, str]]:
    """Yields the objects of a collection with the role that they inherit; inner collections last."""
    own = collection.throng.role
    role = role if own == "INHERIT" else own
    yield from ((thing, role) for thing in collection.objects)
    for child in collection.children:
        yield from _inherited(child, role)


def area(thing: bpy.types.Object, graph: bpy.types.Depsgraph) -> Outline:
    """Returns the outline of an object: the hull of it if it has parts or holes. An empty is a disc of its size."""
    if thing.type == "EMPTY":
        radius = thing.empty_display_size * max(thing.matrix_world.to_scale().xy)
        middle = thing.matrix_world.translation
        angles = np.linspace(0, math.tau, SIDES, endpoint=False)
        return [(middle.x + radius * math.cos(angle), middle.y + radius * math.sin(angle)) for angle in angles]
    with _mesh(thing, graph) as made:
        parts = tg.ground(_flat(made))["coordinates"]
        if len(parts) == 1 and len(parts[0]) == 1:
            return [tuple(corner) for corner in parts[0][0]]
        ring = _ring(made)
        if ring:
            return ring
        points = [tuple(vertex.co.xy) for vertex in made.verts]
    hull = [points[k] for k in convex_hull_2d(points)] if len(points) > 2 else []
    if len(hull) < 3:
        raise ValueError(f"{thing.name} has no area, seen from above: people need an area to start from or to go to")
    return hull


@contextmanager
def _mesh(thing: bpy.types.Object, graph: bpy.types.Depsgraph) -> Iterator[bmesh.types.BMesh]:
    """Makes the mesh of an object with its modifiers, in the world."""
    made, evaluated = bmesh.new(), thing.evaluated_get(graph)
    try:
        try:
            mesh = evaluated.to_mesh()
        except RuntimeError:
            raise ValueError(
                f"{thing.name} has no shape: only meshes, curves, texts and empties can have this role"
            ) from None
        made.from_mesh(mesh)
        evaluated.to_mesh_clear()
        made.transform(thing.matrix_world)
        count = sum(len(face.verts) - 2 for face in made.faces)
        if count > MOST:
            raise ValueError(
                f"{thing.name} has {count} triangles, more than {MOST}: give the role to a simpler mesh of it"
            )
        made.normal_update()
        yield made
    finally:
        made.free()


def _triangles(made: bmesh.types.BMesh) -> Iterator[tuple[bmesh.types.BMFace, np.ndarray, float]]:
    """Yields the triangles of a mesh: the face, the corners from above, and the area from above."""
    for loops in made.calc_loop_triangles():
        (a, b, c) = corners = np.array([loop.vert.co.xy for loop in loops])
        yield loops[0].face, corners, abs(float(np.cross(b - a, c - a))) / 2


def _floor(made: bmesh.types.BMesh) -> tuple[list[Outline], list[tuple[float, float]]]:
    """Returns the triangles that look up, and area and height of each."""
    outlines, weights = [], []
    for face, corners, size in _triangles(made):
        if face.normal.z >= STEEPEST and size > LEAST:
            outlines.append(corners.tolist())
            weights.append((size, face.calc_center_median().z))
    return outlines, weights


def _flat(made: bmesh.types.BMesh) -> list[Outline]:
    """Returns the triangles of a mesh that have an area from above."""
    return [corners.tolist() for _, corners, size in _triangles(made) if size > LEAST]


def _footprint(made: bmesh.types.BMesh, top: float) -> list[Outline]:
    """Returns what a mesh covers below a height: where it is cut, its inside; edges and faces on edge are thin."""
    everything = [*made.verts, *made.edges, *made.faces]
    cut = bmesh.ops.bisect_plane(made, geom=everything, plane_co=(0, 0, top), plane_no=(0, 0, 1), clear_outer=True)
    edges = [part for part in cut["geom_cut"] if isinstance(part, bmesh.types.BMEdge)]
    if edges:
        bmesh.ops.triangle_fill(made, edges=edges, use_beauty=False, normal=(0, 0, 1))
    outlines = _flat(made)
    lines = set()
    for _, corners, size in _triangles(made):
        if size <= LEAST:
            lines.add(_line(corners))
    for edge in made.edges:
        if not edge.link_faces:
            lines.add(_line(np.array([vertex.co.xy for vertex in edge.verts])))
    return outlines + [_plate(a, b) for a, b in sorted(lines) if a != b]


def _line(points: np.ndarray) -> tuple[tuple[float, float], tuple[float, float]]:
    """Returns the two points that are farthest apart, in order."""
    pairs = [(a, b) for k, a in enumerate(points) for b in points[k + 1 :]]
    a, b = max(pairs, key=lambda pair: float(np.linalg.norm(pair[0] - pair[1])))
    return tuple(sorted((tuple(np.round(a, 6).tolist()), tuple(np.round(b, 6).tolist()))))


def _plate(a: tuple[float, float], b: tuple[float, float]) -> Outline:
    """Returns a thin rectangle around a line."""
    start, end = np.array(a), np.array(b)
    along = (end - start) / np.linalg.norm(end - start) * THIN / 2
    left = np.array([-along[1], along[0]])
    return [
        tuple(corner) for corner in (start - along - left, end + along - left, end + along + left, start - along + left)
    ]


def _ring(made: bmesh.types.BMesh) -> Outline | None:
    """Returns the corners of a mesh that is one closed line."""
    if made.faces or len(made.verts) < 3 or any(len(vertex.link_edges) != 2 for vertex in made.verts):
        return None
    made.verts.ensure_lookup_table()
    first = made.verts[0]
    ring, edge = [first], first.link_edges[0]
    while (vertex := edge.other_vert(ring[-1])) is not first:
        ring.append(vertex)
        edge = next(other for other in vertex.link_edges if other is not edge)
    return [tuple(vertex.co.xy) for vertex in ring] if len(ring) == len(made.verts) else None
