"""Velocity obstacles as cones: Fiorini, Shiller, Motion planning in dynamic environments using velocity obstacles, IJRR
17(7), 1998, section 2.

An agent A at the origin sees a neighbour B at `offset`. `radius_sum` is the sum of both radii. The relative velocity is
that of A less that of B. All functions take one pair, or arrays of pairs.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from ._vectors import Array, Floats, dot, turned_left


def time_to_collision(offset: Floats, radius_sum: Floats, relative_velocity: Floats) -> Array:
    """Returns the seconds until two discs touch: 0 if they overlap, infinite if they never touch.

    The distance at the time t is |offset - t v|. It equals `radius_sum` at the roots of a t^2 - 2 b t + c, of which the
    smaller is c / (b + sqrt(b^2 - a c)).

    >>> time_to_collision([3.0, 0.0], 1.0, [[1.0, 0.0], [-1.0, 0.0], [1.0, 1.0]])
    array([ 2., inf, inf])
    """
    x, v = np.asarray(offset, float), np.asarray(relative_velocity, float)
    a, b, c = dot(v, v), dot(x, v), dot(x, x) - np.asarray(radius_sum, float) ** 2
    discriminant = b * b - a * c
    meets = (b > 0) & (discriminant > 0)
    root = np.sqrt(np.where(meets, discriminant, 0.0))
    time = np.divide(c, b + root, out=np.full(np.shape(meets), np.inf), where=meets)
    return np.where(c < 0, 0.0, time)


def in_cone(offset: Floats, radius_sum: Floats, relative_velocity: Floats) -> npt.NDArray[np.bool_]:
    """Whether a relative velocity is in the velocity obstacle: whether it leads to a collision, now or ever.

    >>> bool(in_cone([3.0, 0.0], 1.0, [1.0, 0.2]))
    True
    """
    return np.isfinite(time_to_collision(offset, radius_sum, relative_velocity))


def in_truncated_cone(
    offset: Floats, radius_sum: Floats, relative_velocity: Floats, horizon: Floats
) -> npt.NDArray[np.bool_]:
    """Whether a relative velocity leads to a collision within `horizon` seconds: the cone without its tip.

    >>> in_truncated_cone([3.0, 0.0], 1.0, [[0.9, 0.0], [1.1, 0.0]], 2.0)
    array([False,  True])
    """
    return np.asarray(time_to_collision(offset, radius_sum, relative_velocity) <= np.asarray(horizon))


def legs(offset: Floats, radius_sum: Floats) -> tuple[Array, Array]:
    """Returns unit vectors along the left and the right leg of the cone: the tangents from A to the disc round B.

    The bodies must not touch.

    >>> left, right = legs([2.0, 0.0], 1.0)
    >>> left.round(3), right.round(3)
    (array([0.866, 0.5  ]), array([ 0.866, -0.5  ]))
    """
    x = np.asarray(offset, float)
    radius = np.asarray(radius_sum, float)[..., None]
    squared = dot(x, x)[..., None]
    tangent = np.sqrt(np.maximum(squared - radius**2, 0.0))
    across = turned_left(x) * radius
    return (x * tangent + across) / squared, (x * tangent - across) / squared


def time_to_wall(a: Floats, b: Floats, radius: Floats, velocity: Floats) -> Array:
    """Returns the seconds until a disc at the origin touches the wall from `a` to `b`; infinite if it never does.

    >>> time_to_wall([2.0, -1.0], [2.0, 1.0], 0.5, [[1.0, 0.0], [0.0, 1.0]])
    array([1.5, inf])
    """
    a, b, v = np.asarray(a, float), np.asarray(b, float), np.asarray(velocity, float)
    along = b - a
    size = np.sqrt(dot(along, along))[..., None]
    along = np.divide(along, size, out=np.zeros_like(along), where=size > 0)
    towards = turned_left(along)
    towards = towards * np.where(dot(towards, a) < 0, -1.0, 1.0)[..., None]
    gap, approach = np.maximum(dot(towards, a) - np.asarray(radius), 0.0), dot(towards, v)
    time = np.divide(gap, approach, out=np.full(np.broadcast(gap, approach).shape, np.inf), where=approach > 0)
    with np.errstate(invalid="ignore"):
        touched = np.where(np.isfinite(time), dot(along, v) * time - dot(along, a), -1.0)
    time = np.where((touched >= 0) & (touched <= size[..., 0]), time, np.inf)
    ends = [time_to_collision(end, radius, v) for end in (a, b)]
    return np.minimum(time, np.minimum(*ends))
