"""Curves with fewer keys stay within their tolerance."""

import numpy as np
import pytest
from throng import keys, quaternions


@pytest.mark.parametrize("frames", [1, 2, 8, 9, 10, 16, 17, 100])
def test_left_out_values_are_near(frames: int) -> None:
    rng = np.random.default_rng(frames)
    time = np.arange(frames)
    speeds = rng.uniform(0.001, 0.6, (1, 7, 1))
    values = np.sin(time[:, None, None] * speeds + rng.uniform(0, 6, (1, 7, 3)))
    values[:, 3] = 0.25
    tolerance = rng.uniform(1e-3, 3e-2, 7)
    keep = keys.needed(values, tolerance)
    assert keep[0].all()
    for curve in range(7):
        at = np.flatnonzero(keep[:, curve])
        line = np.stack([np.interp(time, at, values[at, curve, part]) for part in range(3)], axis=1)
        assert np.linalg.norm(line - values[:, curve], axis=1).max() <= tolerance[curve] + 1e-12
    assert keep[:, 3].sum() == 1, "a constant has one key"


def test_slow_curves_have_few_keys() -> None:
    values = np.sin(np.arange(801) / 400)[:, None, None]
    assert keys.needed(values, np.array([1e-4])).sum() == 101


def test_quaternions() -> None:
    from mathutils import Quaternion, Vector

    rng = np.random.default_rng(1)
    a, b = (turn / np.linalg.norm(turn, axis=1, keepdims=True) for turn in rng.normal(size=(2, 20, 4)))
    points = rng.normal(size=(20, 3))
    for k in range(20):
        first, second = Quaternion(a[k]), Quaternion(b[k])
        assert np.allclose(quaternions.product(a, b)[k], first @ second, atol=1e-6)
        assert np.allclose(quaternions.inverse(a)[k], first.conjugated(), atol=1e-6)
        assert np.allclose(quaternions.rotated(a, points)[k], first @ Vector(points[k]), atol=1e-6)
    assert np.allclose(quaternions.about_z(np.array([0.7])), [Quaternion((0, 0, 1), 0.7)], atol=1e-6)
    turning = quaternions.continuous(
        quaternions.about_z(np.linspace(0, 20, 50))[:, None] * rng.choice([-1, 1], (50, 1, 1))
    )
    assert (np.sum(turning[1:] * turning[:-1], axis=2) > 0).all()
