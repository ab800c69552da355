"""Boids: Reynolds, Flocks, herds, and schools: a distributed behavioral model, SIGGRAPH 1987, section "Simulated
flocks"; with the weighting by 1 / distance of Reynolds, Steering behaviors for autonomous characters, GDC 1999.

Each rule takes the neighbours of one agent as rows, and returns what it asks for. Without neighbours it asks for
nothing.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from .._model import View
from ._vectors import Array, Floats, dot, length, limited, unit


def separation(offsets: Floats) -> Array:
    """Returns the push away from neighbours, the stronger the nearer they are: minus the sum of offset / distance^2.

    `offsets` are the centres of the neighbours from that of the agent, metres: (k, 2). A neighbour at the same place
    does not push.

    >>> separation([[2.0, 0.0], [0.0, 1.0]])
    array([-0.5, -1. ])
    """
    x = np.asarray(offsets, float).reshape(-1, 2)
    squared = dot(x, x)[:, None]
    pushes: Array = np.divide(x, squared, out=np.zeros_like(x), where=squared > 0)
    return np.asarray(0.0 - pushes.sum(axis=0))


def alignment(velocity: Floats, velocities: Floats) -> Array:
    """Returns the change of velocity to the mean velocity of the neighbours, m/s.

    >>> alignment([1.0, 0.0], [[1.0, 1.0], [1.0, 0.0]])
    array([0. , 0.5])
    """
    theirs = np.asarray(velocities, float).reshape(-1, 2)
    return theirs.mean(axis=0) - np.asarray(velocity, float) if len(theirs) else np.zeros(2)


def cohesion(offsets: Floats) -> Array:
    """Returns the way to the middle of the neighbours, metres.

    >>> cohesion([[2.0, 0.0], [0.0, 1.0]])
    array([1. , 0.5])
    """
    x = np.asarray(offsets, float).reshape(-1, 2)
    return x.mean(axis=0) if len(x) else np.zeros(2)


def flocking(
    offsets: Floats, velocity: Floats, velocities: Floats, weights: Sequence[float] = (1.5, 1.0, 1.0)
) -> Array:
    """Returns the weighted sum of separation, alignment and cohesion for one agent, as an acceleration.

    >>> flocking([[2.0, 0.0]], [0.0, 0.0], [[0.0, 1.0]], weights=(2.0, 1.0, 1.0))
    array([1., 1.])
    """
    separate, align, cohere = weights
    return separate * separation(offsets) + align * alignment(velocity, velocities) + cohere * cohesion(offsets)


def allocated(requests: Sequence[Floats], most: float) -> Array:
    """Returns the sum of accelerations in order of priority, until their lengths add up to `most` (1987, "Arbitrating
    independent behaviors").

    >>> allocated([[0.0, 2.0], [3.0, 0.0]], most=4.0)
    array([2., 2.])
    """
    total, left = np.zeros(2), most
    for request in requests:
        part = limited(np.asarray(request, float), left)
        total = total + part
        left = max(left - float(length(part)[0]), 0.0)
    return total


def boids(
    view: View,
    *,
    weights: Sequence[float] = (1.5, 1.0, 1.0),
    migration: float = 1.0,
    max_acceleration: float = 5.0,
    min_speed: float = 0.3,
) -> Array:
    """A flock as a local model: new velocity = velocity + time x acceleration.

    The preferred velocity is the migratory urge of 1987: that to the goal, or what you write to `world.preferred`.
    `max_acceleration` is in m/s^2, `min_speed` a part of the top speed.

    >>> import throng_sim as tg
    >>> scene = tg.Scene()
    >>> scene.group("birds", n=20, place={"disc": {"radius": 5}})
    'birds'
    >>> scene.build(model=boids).step()
    """
    near = view.near
    chosen = np.empty((len(view), 2))
    for k in range(len(view)):
        pairs = slice(near.start[k], near.start[k + 1])
        velocity = view.velocities[k].astype(float)
        flock = flocking(near.offsets[pairs], velocity, near.velocities[pairs], weights)
        urge = migration * (view.preferred[k] - velocity)
        chosen[k] = velocity + view.dt * limited(flock + urge, max_acceleration)
    top = view.max_speeds[:, None]
    speed = np.clip(length(chosen), min_speed * top, top)
    return unit(chosen) * speed
