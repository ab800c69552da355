"""Models that try velocities: VO, RVO and HRVO.

Each tries the same velocities, on a polar grid, so that only their ideas differ. The engine's models search better: its
VO and HRVO find the exact optimum (ClearPath; Guy et al., SCA 2009), its RVO refines the grid about the best velocity.
"""

from __future__ import annotations

import numpy as np

from .._model import View
from ._cones import in_cone, legs, time_to_collision, time_to_wall
from ._vectors import Array, Floats, Rows, det, dot, length, limited, turned_left, unit

WALL_HORIZON = 0.7
"""Seconds ahead for which a velocity must be safe from walls."""


def candidates(view: View, angles: int = 36, speeds: int = 6) -> Array:
    """Returns velocities to try, (n, c, 2): the preferred one, zero, the present one, and a polar grid."""
    preferred = limited(view.preferred.astype(float), view.max_speeds)
    angle = np.arange(angles) * (2 * np.pi / angles)
    speed = np.arange(1, speeds + 1) / speeds
    ring = np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    grid = (speed[:, None, None] * ring).reshape(-1, 2)
    ahead = unit(preferred)
    ahead[dot(ahead, ahead) == 0] = (1.0, 0.0)
    turned = grid[:, :1] * ahead[:, None] + grid[:, 1:] * turned_left(ahead)[:, None]
    current = limited(view.velocities.astype(float), view.max_speeds)
    first = np.stack([preferred, np.zeros_like(preferred), current], axis=1)
    return np.concatenate([first, turned * view.max_speeds[:, None, None]], axis=1)


def vo(view: View, *, time_horizon: float = 2.0) -> Array:
    """Velocity obstacles (Fiorini, Shiller 1998): the velocity nearest to the preferred one outside of all cones.

    Each agent assumes that its neighbours keep their velocities, so both of two agents do all of the avoidance.
    `time_horizon` is in seconds. Without a free velocity it takes the one with the latest collision.

    >>> import throng_sim as tg
    >>> tg.Scene("headon").build(model=vo).step()
    """
    tried, near = candidates(view), view.near
    relative = tried[near.row] - near.velocities[:, None]
    time = _first(view, _seconds(near.offsets[:, None], near.radii[:, None], relative), near.row)
    return _nearest_free(view, tried, np.where(time > time_horizon, np.inf, time))


def rvo(view: View, *, weight: float = 1.0, time_horizon: float = 5.0) -> Array:
    """Reciprocal velocity obstacles (van den Berg, Lin, Manocha, ICRA 2008): the velocity of least penalty.

    A velocity v' is in the reciprocal velocity obstacle if 2 v' - v_A is in the velocity obstacle (definition 4): the
    agent does half of the change, the neighbour the other half. With a share s it is (v' - (1 - s) v_A) / s. The
    penalty is weight / time to collision + |preferred - v'| (section V); `weight` is in metres.

    >>> import throng_sim as tg
    >>> tg.Scene("headon").build(model=rvo).step()
    """
    tried = candidates(view)
    return _least(tried, rvo_penalty(view, tried, weight=weight, time_horizon=time_horizon))


def rvo_penalty(view: View, tried: Array, *, weight: float = 1.0, time_horizon: float = 5.0) -> Array:
    """Returns the penalties of RVO, (n, c), for velocities to try, (n, c, 2)."""
    near = view.near
    share = np.clip(near.shares, 0.1, 1.0)[:, None, None].astype(float)
    judged = tried[near.row] / share + (1 - 1 / share) * view.velocities[near.row, None] - near.velocities[:, None]
    time = _first(view, time_to_collision(near.offsets[:, None], near.radii[:, None], judged), near.row)
    walls = _walls(view, tried)
    penalty = np.where(time < time_horizon, weight / np.maximum(time, 1e-3), 0.0)
    penalty = np.maximum(penalty, np.where(walls < WALL_HORIZON, weight / np.maximum(walls, 1e-3), 0.0))
    return np.asarray(penalty + length(tried - view.preferred[:, None])[..., 0])


def hrvo(view: View) -> Array:
    """Hybrid reciprocal velocity obstacles (Snape, van den Berg, Guy, Manocha, T-RO 27(4), 2011, section IV).

    On the side on which the agent passes, the cone is that of RVO; its other leg is that of VO, so that passing on the
    other side costs all of the avoidance.

    >>> import throng_sim as tg
    >>> tg.Scene("headon").build(model=hrvo).step()
    """
    tried, near = candidates(view), view.near
    offset, other = near.offsets.astype(float), near.velocities.astype(float)
    apart = dot(offset, offset) > near.radii.astype(float) ** 2
    left, right = legs(np.where(apart[:, None], offset, (1.0, 0.0)), np.where(apart, near.radii, 0.5))
    relative = view.velocities[near.row] - other
    rest, opening = 1 - near.shares.astype(float), det(right, left)
    passes_left = det(offset, relative) > 0
    along_right = (rest * det(relative, left) / opening)[:, None] * right
    along_left = (-rest * det(relative, right) / opening)[:, None] * left
    apex = other + np.where(passes_left[:, None], along_right, along_left)
    inside = in_cone(offset[:, None], near.radii[:, None], tried[near.row] - apex[:, None])
    seconds = _seconds(offset[:, None], near.radii[:, None], tried[near.row] - other[:, None])
    # in the cone, but on no course to a collision: better than any collision
    time = np.where(apart[:, None], np.where(inside, np.minimum(seconds, 1e6), np.inf), seconds)
    return _nearest_free(view, tried, _first(view, time, near.row))


def _seconds(offset: Floats, radius_sum: Floats, relative: Array) -> Array:
    """Returns the times to a collision, where bodies that overlap may part."""
    time = time_to_collision(offset, radius_sum, relative)
    return np.where((time == 0) & (dot(np.asarray(offset, float), relative) <= 0), np.inf, time)


def _first(view: View, time: Array, row: Rows) -> Array:
    """Returns the least of the times of all neighbours, (n, c), of those of each pair, (m, c)."""
    first = np.full((len(view), time.shape[1]), np.inf)
    np.minimum.at(first, row, time)
    return first


def _walls(view: View, tried: Array) -> Array:
    """Returns the times to a collision with a wall, (n, c)."""
    walls = view.walls
    radii = view.radii[walls.row, None]
    time = time_to_wall(walls.a[:, None], walls.b[:, None], radii, tried[walls.row])
    return _first(view, time, walls.row)


def _nearest_free(view: View, tried: Array, time: Array) -> Array:
    """Returns the velocity without a collision nearest to the preferred one, or that with the latest collision."""
    walls = _walls(view, tried)
    time = np.minimum(time, np.where(walls > WALL_HORIZON, np.inf, walls))
    distance = length(tried - view.preferred[:, None])[..., 0]
    free = np.isinf(time)
    latest = -np.where(free, 0.0, time)
    cost = np.where(free.any(axis=1, keepdims=True), np.where(free, distance, np.inf), latest + 1e-6 * distance)
    return _least(tried, cost)


def _least(tried: Array, cost: Array) -> Array:
    return np.asarray(tried[np.arange(len(tried)), np.argmin(cost, axis=1)])
