"""Arrays of quaternions: w, x, y, z in the last axis."""

import numpy as np


def product(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Returns the rotations `b`, then `a`."""
    (aw, ax, ay, az), (bw, bx, by, bz) = np.moveaxis(a, -1, 0), np.moveaxis(b, -1, 0)
    parts = (
        aw * bw - ax * bx - ay * by - az * bz,
        aw * bx + ax * bw + ay * bz - az * by,
        aw * by - ax * bz + ay * bw + az * bx,
        aw * bz + ax * by - ay * bx + az * bw,
    )
    return np.stack(np.broadcast_arrays(*parts), axis=-1)


def inverse(a: np.ndarray) -> np.ndarray:
    """Returns the opposite rotations."""
    return a * np.array([1, -1, -1, -1], a.dtype)


def rotated(turn: np.ndarray, point: np.ndarray) -> np.ndarray:
    """Returns points after rotations."""
    axis = turn[..., 1:]
    beside = 2 * np.cross(axis, point)
    return point + turn[..., :1] * beside + np.cross(axis, beside)


def about_z(angle: np.ndarray) -> np.ndarray:
    """Returns rotations about the z axis, counter-clockwise, radians."""
    zero = np.zeros_like(angle)
    return np.stack([np.cos(angle / 2), zero, zero, np.sin(angle / 2)], axis=-1)


def continuous(turns: np.ndarray) -> np.ndarray:
    """Returns the same rotations with signs that do not jump along the first axis."""
    dots = (turns[1:] * turns[:-1]).sum(axis=-1)
    signs = np.cumprod(np.where(dots < 0, -1.0, 1.0), axis=0)
    turns = turns.copy()
    turns[1:] *= signs[..., None]
    return turns
