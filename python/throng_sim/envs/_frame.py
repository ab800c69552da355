"""The agent's own frame: +x ahead, +y to its left."""

from __future__ import annotations

import numpy as np

from ._state import Floats


def inwards(vectors: Floats, headings: Floats) -> Floats:
    """Returns vectors of the world, (n, ..., 2), in the frames of agents with these headings, (n,).

    >>> inwards(np.array([[0.0, 2.0]]), np.array([np.pi / 2])).round(9).tolist()
    [[2.0, 0.0]]
    """
    return outwards(vectors, -headings)


def outwards(vectors: Floats, headings: Floats) -> Floats:
    """Returns vectors in the frames of agents, (n, ..., 2), as vectors of the world.

    >>> outwards(np.array([[2.0, 0.0]]), np.array([np.pi / 2])).round(9).tolist()
    [[0.0, 2.0]]
    """
    shape = (-1, *[1] * (vectors.ndim - 2))
    cos, sin = np.cos(headings).reshape(shape), np.sin(headings).reshape(shape)
    x, y = vectors[..., 0], vectors[..., 1]
    return np.stack([cos * x - sin * y, sin * x + cos * y], axis=-1)
