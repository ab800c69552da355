"""Steering behaviours: Reynolds, Steering behaviors for autonomous characters, GDC 1999.

Pure functions of arrays with a row for each agent. Each returns the desired velocities, (n, 2), m/s. Write them with
`world.preferred[:] = ...` before `world.step()`. Targets are (2,), or (n, 2); speeds a number, or (n,).
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ._vectors import Array, Floats, dot, length, limited, unit


def seek(positions: Floats, targets: Floats, max_speed: Floats) -> Array:
    """Returns velocities straight to the target, at top speed ("Seek"). At the target: zero.

    >>> seek([[0.0, 0.0], [3.0, 4.0]], [3.0, 4.0], 2.0)
    array([[1.2, 1.6],
           [0. , 0. ]])
    """
    return unit(np.asarray(targets, float) - np.asarray(positions, float)) * _column(max_speed)


def flee(positions: Floats, targets: Floats, max_speed: Floats) -> Array:
    """Returns velocities straight away from the target, at top speed ("Flee").

    >>> flee([[1.0, 0.0]], [0.0, 0.0], 2.0)
    array([[2., 0.]])
    """
    return -seek(positions, targets, max_speed) + 0.0


def arrive(positions: Floats, targets: Floats, max_speed: Floats, slowing: float) -> Array:
    """Returns velocities to the target, slower within `slowing` metres of it ("Arrival").

    The speed is the top speed times distance / slowing, at most the top speed.

    >>> arrive([[0.0, 0.0], [9.0, 0.0]], [10.0, 0.0], 2.0, slowing=4.0)
    array([[2. , 0. ],
           [0.5, 0. ]])
    """
    offset = np.asarray(targets, float) - np.asarray(positions, float)
    return unit(offset) * _column(max_speed) * np.minimum(length(offset) / slowing, 1.0)


def pursue(positions: Floats, quarry: Floats, quarry_velocities: Floats, max_speed: Floats, most: float = 2.0) -> Array:
    """Returns velocities to where the quarry will be ("Pursuit"): at its velocity, after distance / top speed seconds,
    at most `most`.

    >>> pursue([[0.0, 0.0]], [2.0, 0.0], [0.0, 1.0], 1.0).round(3)
    array([[0.707, 0.707]])
    """
    at = np.asarray(positions, float)
    return seek(at, predicted(at, quarry, quarry_velocities, max_speed, most), max_speed)


def evade(positions: Floats, hunter: Floats, hunter_velocities: Floats, max_speed: Floats, most: float = 2.0) -> Array:
    """Returns velocities away from where the hunter will be ("Evasion").

    >>> evade([[0.0, 0.0]], [2.0, 0.0], [0.0, 1.0], 1.0).round(3)
    array([[-0.707, -0.707]])
    """
    at = np.asarray(positions, float)
    return flee(at, predicted(at, hunter, hunter_velocities, max_speed, most), max_speed)


def predicted(positions: Floats, others: Floats, velocities: Floats, max_speed: Floats, most: float) -> Array:
    """Returns the places of others after distance / top speed seconds, at most `most`.

    >>> predicted([[0.0, 0.0]], [4.0, 0.0], [0.0, 1.0], 2.0, most=9.0)
    array([[4., 2.]])
    """
    others, velocities = np.asarray(others, float), np.asarray(velocities, float)
    time = length(others - np.asarray(positions, float)) / _column(max_speed)
    return np.asarray(others + velocities * np.minimum(time, most))


def wander(
    headings: Floats, turns: Floats, max_speed: Floats, rate: float, rng: np.random.Generator
) -> tuple[Array, Array]:
    """Returns velocities, and the new `turns`, (n,), radians ("Wander").

    Each agent steers to a point on a circle of radius 1, with its centre sqrt(2) ahead. `turns` are the places of the
    points on their circles, from straight ahead; each walks at random, by at most `rate` radians a call. So an agent
    turns by at most 45 degrees.

    >>> desired, turns = wander([0.0], [np.pi / 2], 1.0, 0.0, np.random.default_rng(1))
    >>> desired.round(3)
    array([[0.816, 0.577]])
    """
    heading = np.asarray(headings, float)
    turned = np.asarray(turns, float) + rng.uniform(-rate, rate, np.shape(turns))
    aim = np.sqrt(2) * _direction(heading) + _direction(heading + turned)
    return unit(aim) * _column(max_speed), turned


def follow_path(
    positions: Floats, velocities: Floats, path: Floats, radius: float, max_speed: Floats, ahead: float = 1.0
) -> Array:
    """Returns velocities along a path, (k, 2), of this radius in metres ("Path following").

    An agent keeps its direction if its place after `ahead` seconds is on the path. Else it seeks a point of the path as
    far ahead as it walks in that time.

    >>> follow_path([[0.0, 0.0], [0.0, 3.0]], [[1.0, 0.0], [1.0, 0.0]], [[-9.0, 0.0], [9.0, 0.0]], 0.5, 1.0).round(3)
    array([[ 1.   ,  0.   ],
           [ 0.555, -0.832]])
    """
    at, velocity, path = np.asarray(positions, float), np.asarray(velocities, float), np.asarray(path, float)
    future = at + ahead * velocity
    place, distance = nearest_on_path(future, path)
    target = point_on_path(path, place + ahead * np.broadcast_to(np.asarray(max_speed, float), len(at)))
    forwards = point_on_path(path, place + 1e-3) - point_on_path(path, place)
    keeps = (distance <= radius) & (dot(velocity, forwards) > 0)
    return np.where(keeps[:, None], unit(velocity) * _column(max_speed), seek(at, target, max_speed))


def nearest_on_path(positions: Floats, path: Floats) -> tuple[Array, Array]:
    """Returns the nearest places on a path, metres from its start, and the distances: (n,) and (n,).

    >>> nearest_on_path([[3.0, 1.0]], [[0.0, 0.0], [5.0, 0.0], [5.0, 5.0]])
    (array([3.]), array([1.]))
    """
    at, path = np.asarray(positions, float)[:, None], np.asarray(path, float)
    along = np.diff(path, axis=0)
    part = np.clip(dot(at - path[:-1], along) / dot(along, along), 0.0, 1.0)
    gap = length(path[:-1] + part[..., None] * along - at)[..., 0]
    best, rows = np.argmin(gap, axis=1), np.arange(len(at))
    sizes = length(along)[:, 0]
    return np.concatenate([[0.0], np.cumsum(sizes)])[best] + part[rows, best] * sizes[best], gap[rows, best]


def point_on_path(path: Floats, places: Floats) -> Array:
    """Returns the points of a path that are this many metres from its start, at most its end: (n, 2).

    >>> point_on_path([[0.0, 0.0], [5.0, 0.0], [5.0, 5.0]], [6.0])
    array([[5., 1.]])
    """
    path = np.asarray(path, float)
    far = np.concatenate([[0.0], np.cumsum(length(np.diff(path, axis=0))[:, 0])])
    at = np.asarray(places, float)
    return np.stack([np.interp(at, far, path[:, axis]) for axis in (0, 1)], axis=-1)


def follow_flow(
    positions: Floats, velocities: Floats, flow: Callable[[Array], Array], max_speed: Floats, ahead: float = 0.0
) -> Array:
    """Returns the velocities of a flow where the agents will be in `ahead` seconds ("Flow field following").

    >>> follow_flow([[2.0, 0.0]], [[0.0, 0.0]], lambda at: -at, 1.0) + 0.0
    array([[-1.,  0.]])
    """
    future = np.asarray(positions, float) + ahead * np.asarray(velocities, float)
    return limited(flow(future), max_speed)


def steered(velocities: Floats, desired: Floats, max_force: float, seconds: float) -> Array:
    """Returns the velocities after `seconds` of steering = desired - velocity, at most `max_force` m/s^2.

    >>> steered([[1.0, 0.0]], [[0.0, 1.0]], max_force=1.0, seconds=0.5).round(3)
    array([[0.646, 0.354]])
    """
    velocity = np.asarray(velocities, float)
    return velocity + limited(np.asarray(desired, float) - velocity, max_force) * seconds


def _column(speeds: Floats) -> Array:
    return np.asarray(speeds, float)[..., None]


def _direction(angle: Array) -> Array:
    return np.stack([np.cos(angle), np.sin(angle)], axis=-1)
