"""Optimal reciprocal collision avoidance: van den Berg, Guy, Lin, Manocha, Reciprocal n-body collision avoidance, ISRR
2009 (STAR 70, 2011).

A half-plane is a point of its line and a normal, which points to the permitted side: v is permitted if
(v - point) . normal >= 0.
"""

from __future__ import annotations

import numpy as np

from .._model import View
from ._cones import legs
from ._vectors import Array, Floats, det, dot, length, turned_left, unit

RECOVERY = 0.25
"""Seconds in which an overlap ends."""
PARALLEL = 1e-5
"""Two lines closer to parallel than this (sine of the angle) count as parallel."""


def half_plane(
    offset: Floats,
    radius_sum: Floats,
    velocity: Floats,
    other_velocity: Floats,
    horizon: float,
    share: Floats = 0.5,
    recovery: float = RECOVERY,
) -> tuple[Array, Array]:
    """Returns point and normal of the half-plane that a neighbour permits for `horizon` seconds (section 4.1).

    u is the smallest change of the relative velocity to the boundary of the truncated velocity obstacle, n the outward
    normal there. The agent does its `share` of u: the line goes through v_A + share u (equation 5). If the neighbour
    does no avoidance, the share is 1. Bodies that overlap part within `recovery` seconds.

    >>> point, normal = half_plane([4.0, 0.0], 1.0, [1.5, 0.0], [-1.5, 0.0], horizon=2.0)
    >>> point.round(3), normal.round(3)
    (array([ 1.406, -0.363]), array([-0.25 , -0.968]))
    """
    x, v, w_b = np.asarray(offset, float), np.asarray(velocity, float), np.asarray(other_velocity, float)
    radius, share = np.asarray(radius_sum, float)[..., None], np.asarray(share, float)[..., None]
    apart = dot(x, x)[..., None] > radius**2
    time = np.where(apart, horizon, recovery)
    relative = v - w_b
    # from the centre of the disc that rounds the tip
    w = relative - x / time
    outward = np.where(length(w) > 0, unit(w), (1.0, 0.0))
    onto_disc = outward * (radius / time - length(w))
    left, right = legs(np.where(apart, x, (1.0, 0.0)), np.where(apart, radius, 0.5)[..., 0])
    leg = np.where(det(x, w)[..., None] > 0, left, -right)
    onto_leg = leg * dot(relative, leg)[..., None] - relative
    behind = dot(w, x)[..., None]
    on_disc = ~apart | ((behind < 0) & (behind**2 > radius**2 * dot(w, w)[..., None]))
    change, normal = np.where(on_disc, onto_disc, onto_leg), np.where(on_disc, outward, turned_left(leg))
    # where nothing needs to be avoided, the agent may use its part of the room
    room = np.where(share == 1, 1.0, 1 - share)
    part = np.where(dot(change, normal)[..., None] > 0, share, room)
    return v + part * change, normal


def linear_program(points: Floats, normals: Floats, max_speed: float, preferred: Floats, hard: int = 0) -> Array:
    """Returns the permitted velocity nearest to the preferred one (section 5.1).

    Lines are added one after the other (de Berg et al., Computational Geometry, chapter 4). If no velocity is
    permitted, the greatest violation is minimised (section 5.3); the first `hard` lines are still satisfied.

    >>> linear_program([[0.5, 0.0]], [[-1.0, 0.0]], 2.0, [1.0, 1.0])
    array([0.5, 1. ])
    """
    points, normals = np.asarray(points, float).reshape(-1, 2), np.asarray(normals, float).reshape(-1, 2)
    velocity, failed = _closest(points, normals, max_speed, np.asarray(preferred, float), to_point=True)
    if failed is None:
        return velocity
    return _least_violation(points, normals, max_speed, hard, failed, velocity)


def orca(view: View, *, time_horizon: float = 1.0, time_horizon_obstacles: float = 0.7) -> Array:
    """Optimal reciprocal collision avoidance: the nearest velocity that all neighbours and walls permit.

    The half-plane of a wall keeps the agent from the wall's nearest point for `time_horizon_obstacles` seconds. (The
    engine and RVO2 use the whole velocity obstacle of the wall, which permits more along it.)

    >>> import throng_sim as tg
    >>> tg.Scene("headon").build(model=orca).step()
    """
    near, walls = view.near, view.walls
    recovery = max(view.dt, RECOVERY)
    points, normals = half_plane(
        near.offsets,
        near.radii,
        view.velocities[near.row],
        near.velocities,
        time_horizon,
        near.shares,
        recovery,
    )
    wall_points, wall_normals = wall_half_plane(walls.a, walls.b, view.radii[walls.row], time_horizon_obstacles)
    chosen = np.empty((len(view), 2))
    for k in range(len(view)):
        of_walls = slice(walls.start[k], walls.start[k + 1])
        pairs = slice(near.start[k], near.start[k + 1])
        chosen[k] = linear_program(
            np.concatenate([wall_points[of_walls], points[pairs]]),
            np.concatenate([wall_normals[of_walls], normals[pairs]]),
            float(view.max_speeds[k]),
            view.preferred[k],
            hard=len(wall_points[of_walls]),
        )
    return chosen


def wall_half_plane(a: Floats, b: Floats, radius: Floats, horizon: float) -> tuple[Array, Array]:
    """Returns point and normal of the half-plane that a wall from `a` to `b` permits an agent at the origin.

    >>> point, normal = wall_half_plane([2.0, -1.0], [2.0, 1.0], 0.5, horizon=1.0)
    >>> point, normal
    (array([1.5, 0. ]), array([-1.,  0.]))
    """
    a, b = np.asarray(a, float), np.asarray(b, float)
    along = b - a
    part = np.clip(-dot(a, along) / np.maximum(dot(along, along), 1e-12), 0.0, 1.0)
    nearest = a + part[..., None] * along
    normal = -unit(nearest)
    gap = np.maximum(length(nearest) - np.asarray(radius, float)[..., None], 0.0)
    return -normal * gap / horizon + 0.0, normal + 0.0


def _closest(
    points: Array, normals: Array, max_speed: float, aim: Array, *, to_point: bool
) -> tuple[Array, int | None]:
    """Returns the best velocity, and the first line that leaves none, with which it ends.

    Best is nearest to `aim`, or, without `to_point`, farthest in its direction.
    """
    fast = float(np.hypot(*aim))
    velocity = aim * min(1.0, max_speed / fast) if to_point and fast > 0 else aim * (1.0 if to_point else max_speed)
    for i, (point, normal) in enumerate(zip(points, normals, strict=True)):
        if (velocity - point) @ normal < 0:
            found = _on_line(points, normals, i, max_speed, aim, to_point)
            if found is None:
                return velocity, i
            velocity = found
    return velocity, None


def _on_line(points: Array, normals: Array, i: int, max_speed: float, aim: Array, to_point: bool) -> Array | None:
    """Returns the best velocity on line `i` within the top speed and the lines before it, if there is one."""
    point, direction = points[i], np.array([normals[i, 1], -normals[i, 0]])
    along = point @ direction
    discriminant = along**2 + max_speed**2 - point @ point
    if discriminant < 0:
        return None
    low, high = -along - np.sqrt(discriminant), -along + np.sqrt(discriminant)
    for other, normal in zip(points[:i], normals[:i], strict=True):
        slope, room = float(direction @ normal), float((point - other) @ normal)
        if abs(slope) <= PARALLEL:
            if room < 0:
                return None
        elif slope > 0:
            low = max(low, -room / slope)
        else:
            high = min(high, -room / slope)
        if low > high:
            return None
    if to_point:
        t = min(max(direction @ (aim - point), low), high)
    else:
        t = high if aim @ direction > 0 else low
    return np.asarray(point + t * direction)


def _least_violation(points: Array, normals: Array, max_speed: float, hard: int, failed: int, velocity: Array) -> Array:
    """Returns the velocity that minimises the greatest violation, the third unknown of the linear program."""
    violation = 0.0
    for i in range(failed, len(points)):
        point, normal = points[i], normals[i]
        if (point - velocity) @ normal <= violation:
            continue
        # where line i is violated as much as a line before it
        lines = [(points[j], normals[j]) for j in range(min(hard, i))]
        for j in range(min(hard, i), i):
            other, other_normal = points[j], normals[j]
            sine = float(det(normal, other_normal))
            if abs(sine) > PARALLEL:
                direction = np.array([normal[1], -normal[0]])
                equal = point + direction * (((other - point) @ other_normal) / (direction @ other_normal))
            elif normal @ other_normal > 0:
                continue
            else:
                equal = (point + other) / 2
            lines.append((equal, unit(other_normal - normal)))
        kept = (
            np.array([line[0] for line in lines]).reshape(-1, 2),
            np.array([line[1] for line in lines]).reshape(-1, 2),
        )
        better, none = _closest(*kept, max_speed, normal, to_point=False)
        if none is None:
            velocity = better
        violation = float((point - velocity) @ normal)
    return velocity
