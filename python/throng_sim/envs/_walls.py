"""Distances to walls along rays."""

from __future__ import annotations

import numpy as np

from ._state import Floats, Ints

AT_ONCE = 1 << 20
"""Pairs of a ray and a wall in memory at once."""


def distances(at: Floats, rays: Floats, walls: Floats, owners: Ints, sight: float) -> Floats:
    """Returns the distances from points, (n, 2), along rays of length 1, (n, r, 2), to the first wall, metres: (n, r).

    Walls are those of several worlds, (w, m, 4): x and y of both ends. `owners` are the worlds of the points, (n,).
    Walls without length do not count. Distances are at most `sight`.

    >>> at, rays = np.zeros((1, 2)), np.array([[[1.0, 0.0], [0.0, 1.0]]])
    >>> distances(at, rays, np.array([[[2.0, -1.0, 2.0, 1.0]]]), np.array([0]), sight=9.0).tolist()
    [[2.0, 9.0]]
    """
    found = np.full(rays.shape[:2], sight)
    chunk = max(AT_ONCE // max(rays.shape[1] * walls.shape[1], 1), 1)
    for begin in range(0, len(at), chunk):
        part = slice(begin, begin + chunk)
        found[part] = _first(at[part], rays[part], walls[owners[part]], sight)
    return found


def _first(at: Floats, rays: Floats, walls: Floats, sight: float) -> Floats:
    # at + t ray = start + s edge
    x, y = (walls[..., :2] - at[:, None]).transpose(2, 0, 1)[:, :, None]
    edge_x, edge_y = (walls[..., 2:] - walls[..., :2]).transpose(2, 0, 1)[:, :, None]
    ray_x, ray_y = rays.transpose(2, 0, 1)[..., None]
    across = ray_x * edge_y - ray_y * edge_x
    with np.errstate(divide="ignore", invalid="ignore"):
        t = (x * edge_y - y * edge_x) / across
        s = (x * ray_y - y * ray_x) / across
        hits = (t >= 0) & (s >= 0) & (s <= 1)
    first: Floats = np.where(hits, t, sight).min(axis=2, initial=sight)
    return first
