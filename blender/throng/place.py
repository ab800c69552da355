"""The floor plan as meshes: ground with holes, and extruded obstacles and walls."""

import bmesh
import bpy
import numpy as np
from mathutils.geometry import tessellate_polygon

from . import bodies
from .clip import Clip

THICK = 0.1
"""Thickness of thin walls, metres."""
FAR = 20.0
"""Radius of the surroundings, relative to the size of the crowd."""
LOWER = 0.02
"""How much lower than the ground the surroundings are, metres."""
MARGIN = 4.0
"""Ground around the crowd where the walkable area is unbounded, metres."""


def build(clip: Clip, height: float, parent: bpy.types.Object, into: bpy.types.Collection) -> None:
    """Adds the ground, and the obstacles of a height (metres)."""
    crowd, origin = clip.trajectories, clip.origin()[:2]
    areas = [[ring - origin for ring in area] for area in crowd.walkable]
    solids = [(corners - origin, closed) for corners, closed in crowd.obstacles]
    if not areas:
        areas = [[_around(clip) - origin]]
    _object("Ground", _ground(areas), (0.42, 0.41, 0.39), parent, into)
    _object("Surroundings", _ground([[_disc(clip) - origin]]), (0.2, 0.21, 0.2), parent, into).location.z = -LOWER
    edges = [ring for area in areas for ring in area] if crowd.walkable else []
    if solids:
        _object("Obstacles", _solids(solids, height), (0.55, 0.53, 0.5), parent, into)
    if edges:
        _object("Edges", _kerbs(edges), (0.3, 0.3, 0.3), parent, into)


def _object(name: str, mesh: bpy.types.Mesh, color: tuple[float, float, float], parent, into) -> bpy.types.Object:
    """Adds an object with a material of its name."""
    mesh.name = name
    mesh.materials.append(bodies.material(f"Throng {name.lower()}", color))
    made = bpy.data.objects.new(name, mesh)
    made.parent = parent
    into.objects.link(made)
    return made


def _around(clip: Clip) -> np.ndarray:
    """Returns a rectangle around all that the crowd and its obstacles reach."""
    low, high = extent(clip)
    (left, bottom), (right, top) = low[:2] - MARGIN, high[:2] + MARGIN
    return np.array([(left, bottom), (right, bottom), (right, top), (left, top)])


def _disc(clip: Clip) -> np.ndarray:
    """Returns a disc around all, so large that a camera sees no end of it."""
    low, high = extent(clip)
    angles = np.linspace(0, 2 * np.pi, 48, endpoint=False)
    far = FAR * (np.linalg.norm(high - low) + MARGIN)
    return (low + high)[:2] / 2 + far * np.stack([np.cos(angles), np.sin(angles)], axis=1)


def reached(clip: Clip) -> np.ndarray:
    """Returns points of the crowd in the course of the clip, and the corners of obstacles, metres: (n, 3)."""
    frames = clip.frames[:: max(1, len(clip.frames) // 100)]
    positions = clip.trajectories.states(clip.times(frames))[0].reshape(-1, 3)
    corners = [np.c_[corners, np.zeros(len(corners))] for corners, _ in clip.trajectories.obstacles]
    points = np.concatenate([positions[~np.isnan(positions[:, 0])], *corners])
    return points if len(points) else np.zeros((1, 3))


def extent(clip: Clip) -> tuple[np.ndarray, np.ndarray]:
    """Returns the least and the greatest coordinates of what the crowd reaches, metres."""
    points = reached(clip)
    return points.min(axis=0), points.max(axis=0)


def _ground(areas: list[list[np.ndarray]]) -> bpy.types.Mesh:
    """Returns areas with holes as triangles that look up."""
    made = bmesh.new()
    for rings in areas:
        flat = [[(x, y, 0.0) for x, y in ring] for ring in rings]
        corners = [made.verts.new(corner) for ring in flat for corner in ring]
        for triangle in tessellate_polygon(flat):
            face = made.faces.new([corners[k] for k in triangle])
            face.normal_update()
            if face.normal.z < 0:
                face.normal_flip()
    return _mesh(made)


def _solids(solids: list[tuple[np.ndarray, bool]], height: float) -> bpy.types.Mesh:
    """Returns obstacles as solids; thin walls have a thickness."""
    made = bmesh.new()
    for corners, closed in solids:
        if closed:
            _prism(made, corners, height)
            continue
        for a, b in zip(corners[:-1], corners[1:], strict=True):
            _prism(made, _plate(a, b, THICK), height)
    return _mesh(made)


def _kerbs(rings: list[np.ndarray]) -> bpy.types.Mesh:
    """Returns the borders of the ground as low kerbs outside it."""
    made = bmesh.new()
    for ring in rings:
        for a, b in zip(ring, np.roll(ring, -1, axis=0), strict=True):
            _prism(made, _plate(a, b, THICK), THICK)
    return _mesh(made)


def _plate(a: np.ndarray, b: np.ndarray, width: float) -> np.ndarray:
    """Returns a rectangle around a line."""
    along = (b - a) / max(np.linalg.norm(b - a), 1e-9) * width / 2
    left = np.array([-along[1], along[0]])
    return np.array([a - along - left, b + along - left, b + along + left, a - along + left])


def _prism(made: bmesh.types.BMesh, corners: np.ndarray, height: float) -> None:
    """Adds the solid above a polygon."""
    x, y = corners.T
    if (x * np.roll(y, -1) - y * np.roll(x, -1)).sum() < 0:
        corners = corners[::-1]
    low, high = ([made.verts.new((x, y, z)) for x, y in corners] for z in (0.0, height))
    made.faces.new(high)
    made.faces.new(low[::-1])
    for k, (a, b) in enumerate(zip(low, low[1:] + low[:1], strict=True)):
        made.faces.new((a, b, high[(k + 1) % len(high)], high[k]))


def _mesh(made: bmesh.types.BMesh) -> bpy.types.Mesh:
    mesh = bpy.data.meshes.new("Place")
    made.to_mesh(mesh)
    made.free()
    return mesh
