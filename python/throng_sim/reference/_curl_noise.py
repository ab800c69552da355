"""Curl noise: Bridson, Hourihan, Nordenstam, Curl-noise for procedural fluid flow, SIGGRAPH 2007, sections 2.1 and 2.2.

The velocity is the curl (d psi / dy, -d psi / dx) of a potential psi, so it has no sources and no sinks for any psi.
Here psi is a sum of random waves (Kraichnan, Diffusion by a random velocity field, Physics of Fluids 13(1), 1970). Its
gradient is exact. The engine uses simplex noise.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ._vectors import Array, Floats

WAVES = 48


def potential(
    places: Floats, time: float = 0.0, *, length: float = 1.0, period: float = 1.0, speed: float = 1.0, seed: int = 0
) -> tuple[Array, Array]:
    """Returns a smooth random potential, (m,), m^2/s, and its gradient, (m, 2), at places, (m, 2).

    `length` is the size of eddies in metres, `period` the seconds in which they change, `speed` the root mean square
    of the gradient in m/s.

    >>> psi, gradient = potential([[0.0, 0.0], [0.5, 0.0]], length=2.0, seed=3)
    >>> psi.shape, gradient.shape
    ((2,), (2, 2))
    """
    rng = np.random.default_rng(seed)
    angle, phase = rng.uniform(0, 2 * np.pi, (2, WAVES))
    number = 2 * np.pi / length * rng.uniform(0.5, 1.5, WAVES)
    rate = 2 * np.pi / period * rng.normal(0, 0.5, WAVES)
    wave = number[:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    size = speed * np.sqrt(2 / WAVES) / number
    turn = np.asarray(places, float).reshape(-1, 2) @ wave.T + rate * time + phase
    return np.cos(turn) @ size, -np.sin(turn) * size @ wave


def curl(gradient: Floats) -> Array:
    """Returns the curl of a potential with this gradient, (m, 2): the gradient, turned to the right.

    >>> curl([[1.0, 2.0]])
    array([[ 2., -1.]])
    """
    slope = np.asarray(gradient, float)
    return np.stack([slope[..., 1], -slope[..., 0]], axis=-1)


def ramp(r: Floats) -> tuple[Array, Array]:
    """Returns a smooth ramp, 0 at 0 and 1 from 1 on, and its slope (section 2.4).

    >>> ramp([0.0, 1.0, 3.0])[0]
    array([0., 1., 1.])
    """
    x: Array = np.clip(np.asarray(r, float), -1.0, 1.0)
    return (15 * x - 10 * x**3 + 3 * x**5) / 8, 15 / 8 * (1 - x**2) ** 2


def curl_noise(
    places: Floats,
    time: float = 0.0,
    *,
    length: float = 1.0,
    period: float = 1.0,
    speed: float = 1.0,
    seed: int = 0,
    wall: Callable[[Array], tuple[Array, Array]] | None = None,
) -> Array:
    """Returns random velocities without sources and sinks at places, (m, 2), m/s.

    `wall` returns the distance from a wall, (m,), and its gradient, (m, 2): within `length` of it the potential fades,
    and nothing flows through. The other parameters are those of `potential`.

    >>> curl_noise([[0.0, 0.0]], seed=1).shape
    (1, 2)
    """
    at = np.asarray(places, float).reshape(-1, 2)
    psi, gradient = potential(at, time, length=length, period=period, speed=speed, seed=seed)
    if wall is not None:
        distance, away = wall(at)
        fade, slope = ramp(distance / length)
        gradient = fade[:, None] * gradient + (slope / length * psi)[:, None] * away
    return curl(gradient)
