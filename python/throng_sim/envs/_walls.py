"""Distances to walls along rays."""

from __future__ import annotations

import numpy as np

from ._state import Floats

AT_ONCE = 1 << 20
"""Pairs of a ray and a wall in memory at once."""


def distances(at: Floats, rays: Floats, walls: Floats, sight: float) -> Floats:
    """Returns the distances from points, (n, 2), along rays of length 1, (n, r, 2), to the first wall, metres: (n, r).

    Walls are (m, 4): x and y of both ends. Distances are at most `sight`.

    >>> distances(np.array([[0.0, 0.0]]), np.array([[[1.0, 0.0], [0.0, 1.0]]]), np.array([[2.0, -1.0, 2.0, 1.0]]), 9.0).tolist()
    [[2.0, 9.0]]
    """
    found = np.full(rays.shape[:2], sight)
    if not len(walls):
        return found
    chunk = max(AT_ONCE // (rays.shape[1] * len(walls)), 1)
    for begin in range(0, len(at), chunk):
        part = slice(begin, begin + chunk)
        found[part] = np.minimum(_first(at[part], rays[part], walls), sight)
    return found


def _first(at: Floats, rays: Floats, walls: Floats) -> Floats:
    offset = walls[None, :, :2] - at[:, None]  # (n, m, 2)
    edge = walls[:, 2:] - walls[:, :2]  # (m, 2)
    # at + t ray = start + s edge
    across = rays[..., 0, None] * edge[:, 1] - rays[..., 1, None] * edge[:, 0]  # (n, r, m)
    with np.errstate(divide="ignore", invalid="ignore"):
        t = (offset[..., 0] * edge[:, 1] - offset[..., 1] * edge[:, 0])[:, None] / across
        s = (offset[:, None, :, 0] * rays[..., 1, None] - offset[:, None, :, 1] * rays[..., 0, None]) / across
        hits = (t >= 0) & (s >= 0) & (s <= 1)
    first: Floats = np.where(hits, t, np.inf).min(axis=2)
    return first
