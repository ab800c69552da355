"""Vectors in the plane: arrays with x and y along the last axis."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[np.float64]
"""Numbers, usually (n, 2)."""
Floats = npt.ArrayLike
"""What becomes numbers."""
Rows = npt.NDArray[np.int64]
"""Indices of rows."""


def dot(a: Array, b: Array) -> Array:
    """Returns the dot products: (..., 2) and (..., 2) give (...).

    >>> dot(np.array([1.0, 2.0]), np.array([3.0, 4.0])).item()
    11.0
    """
    return np.asarray(np.sum(a * b, axis=-1))


def det(a: Array, b: Array) -> Array:
    """Returns the determinants: positive where `b` is to the left of `a`.

    >>> det(np.array([1.0, 0.0]), np.array([0.0, 2.0])).item()
    2.0
    """
    return np.asarray(a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0])


def turned_left(v: Array) -> Array:
    """Returns the vectors, turned to the left by a right angle.

    >>> turned_left(np.array([1.0, 0.0])) + 0.0
    array([0., 1.])
    """
    return np.stack([-v[..., 1], v[..., 0]], axis=-1)


def length(v: Array) -> Array:
    """Returns the lengths, with the last axis kept: (..., 2) gives (..., 1).

    >>> length(np.array([[3.0, 4.0]]))
    array([[5.]])
    """
    return np.asarray(np.linalg.norm(v, axis=-1, keepdims=True))


def unit(v: Array) -> Array:
    """Returns unit vectors; zero for zero.

    >>> unit(np.array([[3.0, 4.0], [0.0, 0.0]]))
    array([[0.6, 0.8],
           [0. , 0. ]])
    """
    far = length(v)
    return np.asarray(np.divide(v, far, out=np.zeros_like(v, dtype=float), where=far > 0))


def limited(v: Array, most: Floats) -> Array:
    """Returns the vectors, none longer than `most`: a number, or one for each, (n,).

    >>> limited(np.array([[3.0, 4.0], [0.3, 0.4]]), 1.0)
    array([[0.6, 0.8],
           [0.3, 0.4]])
    """
    limit = np.asarray(most, float)[..., None]
    far = length(v)
    return np.where(far > limit, unit(v) * limit, v)
