"""Checks: right functions pass, and classic mistakes are named."""

import subprocess
import sys
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
import pytest

from throng_sim import check, reference

Array = np.ndarray

RIGHT = [
    (check.cone, reference.in_cone),
    (check.truncated_cone, reference.in_truncated_cone),
    (check.half_plane, reference.half_plane),
    (check.linear_program, reference.linear_program),
    (check.seek, reference.seek),
    (check.arrive, reference.arrive),
    (check.pursue, reference.pursue),
    (check.flock, reference.flocking),
    (check.rbf, lambda anchors, velocities, places: reference.rbf(anchors, velocities)(places)),
    (check.divergence, reference.curl_noise),
]
LISTED = [
    (check.cone, check.CONE),
    (check.truncated_cone, check.TRUNCATED_CONE),
    (check.half_plane, check.HALF_PLANE),
    (check.linear_program, check.LINEAR_PROGRAM),
    (check.seek, check.SEEK),
    (check.arrive, check.ARRIVE),
    (check.pursue, check.PURSUE),
    (check.flock, check.FLOCK),
    (check.rbf, check.RBF),
]
CHECKS = [examine for examine, _ in RIGHT]


@pytest.mark.parametrize(("examine", "mine"), RIGHT)
def test_right_functions_pass(examine: Callable[..., check.Verdict], mine: Callable[..., Any]) -> None:
    verdict = examine(mine)
    assert verdict, verdict
    assert verdict.cases >= 90 and verdict.hint == ""
    assert repr(verdict) == f"{verdict.name}: all {verdict.cases} answers are right."
    verdict.require()


@pytest.mark.parametrize(("examine", "mistakes"), LISTED)
def test_each_known_mistake_is_named(examine: Callable[..., check.Verdict], mistakes: Sequence[check.Mistake]) -> None:
    for mistake in mistakes:
        verdict = examine(mistake.answer)
        assert not verdict and verdict.hint == mistake.hint, (mistake.hint, verdict)


def angle_of(v: Array) -> float:
    return float(np.arctan2(v[1], v[0]))


def cone_without_wrap(offset: Array, radius_sum: float, v: Array) -> bool:
    distance = np.hypot(*offset)
    if distance < radius_sum:
        return True
    half = np.arcsin(radius_sum / distance)
    return bool(angle_of(offset) - half <= angle_of(v) <= angle_of(offset) + half)


def cone_by_degrees(offset: Array, radius_sum: float, v: Array) -> bool:
    distance = np.hypot(*offset)
    if distance < radius_sum:
        return True
    turn = np.degrees(angle_of(v) - angle_of(offset))
    turn = (turn + 180) % 360 - 180
    return bool(abs(turn) <= np.arcsin(radius_sum / distance))


def cone_that_forgets_overlaps(offset: Array, radius_sum: float, v: Array) -> bool:
    cosine = offset @ v / np.hypot(*offset) / np.hypot(*v)
    return bool(np.arccos(np.clip(cosine, -1, 1)) <= np.arcsin(radius_sum / np.hypot(*offset)))


def cone_by_simulation(offset: Array, radius_sum: float, v: Array) -> bool:
    """Right, and slow: it looks where the point is at many times."""
    times = np.linspace(0, 60, 20_001)
    if offset @ v > 0:
        times = np.append(times, offset @ v / (v @ v))
    return bool((np.linalg.norm(offset - v * times[:, None], axis=1) < radius_sum).any())


def test_cones() -> None:
    """Wrong functions as students write them, in another way than the check's own."""
    assert check.cone(cone_by_simulation)
    assert "do not wrap" in check.cone(cone_without_wrap).hint
    assert "degrees" in check.cone(cone_by_degrees).hint
    assert "bodies that overlap already touch" in check.cone(cone_that_forgets_overlaps).hint
    verdict = check.cone(lambda offset, radius_sum, v: False)
    assert not verdict and 100 < verdict.wrong < 900
    with pytest.raises(AssertionError, match="expected: True"):
        verdict.require()

    def whole(offset: Array, radius_sum: float, v: Array, horizon: float) -> bool:
        return cone_by_simulation(offset, radius_sum, v)

    assert "not truncated" in check.truncated_cone(whole).hint


def orca_with_all_of_the_change(
    offset: Array, radius_sum: float, v_a: Array, v_b: Array, horizon: float
) -> tuple[Array, Array]:
    point, normal = reference.half_plane(offset, radius_sum, v_a, v_b, horizon)
    return v_a + 2 * (np.array(point) - v_a), normal


def orca_in_the_other_order(*given: Any) -> tuple[Array, Array]:
    point, normal = reference.half_plane(*given)
    return normal, point


def orca_with_a_long_normal(*given: Any) -> tuple[Array, Array]:
    point, normal = reference.half_plane(*given)
    return point, 3 * normal


def test_half_planes() -> None:
    assert "The neighbour does the other half" in check.half_plane(orca_with_all_of_the_change).hint
    assert "unit vector" in check.half_plane(orca_with_a_long_normal).hint
    assert "unit vector" in check.half_plane(orca_in_the_other_order).hint
    assert "point, normal" in check.half_plane(lambda *given: 3.0).hint
    moved = check.half_plane(lambda *given: elsewhere_on_the_line(*reference.half_plane(*given)))
    assert moved, "any point of the line will do"


def elsewhere_on_the_line(point: Array, normal: Array) -> tuple[Array, Array]:
    return point + 2.0 * np.array([normal[1], -normal[0]]), normal


def program_by_grid(points: Array, normals: Array, max_speed: float, preferred: Array) -> Array:
    """Nearly right: the best of a fine grid."""
    across = np.linspace(-max_speed, max_speed, 61)
    grid = np.stack(np.meshgrid(across, across), axis=-1).reshape(-1, 2)
    allowed = np.hypot(*grid.T) <= max_speed
    for point, normal in zip(points, normals, strict=True):
        allowed &= (grid - point) @ normal >= 0
    best = grid[allowed]
    return best[np.argmin(np.hypot(*(best - preferred).T))] if len(best) else np.zeros(2)


def test_linear_programs() -> None:
    """The exact answers are never worse than a grid, and permitted."""
    verdict = check.linear_program(program_by_grid)
    assert not verdict and verdict.hint == ""
    rng = np.random.default_rng(1)
    for _ in range(60):
        angle = rng.uniform(-np.pi, np.pi, 4)
        normals = np.stack([np.cos(angle), np.sin(angle)], axis=1)
        points, preferred = -normals * rng.uniform(0, 0.8, (4, 1)), rng.normal(0, 1.5, 2)
        exact = reference.linear_program(points, normals, 1.5, preferred)
        assert (((exact - points) * normals).sum(axis=1) > -1e-9).all() and np.hypot(*exact) <= 1.5 + 1e-9
        coarse = program_by_grid(points, normals, 1.5, preferred)
        assert np.hypot(*(exact - preferred)) <= np.hypot(*(coarse - preferred)) + 1e-9


def seek_that_divides(positions: Array, target: Array, max_speed: float) -> Array:
    way = target - positions
    return way / np.linalg.norm(way, axis=1, keepdims=True) * max_speed


def seek_of_the_whole(positions: Array, target: Array, max_speed: float) -> Array:
    way = target - positions
    return way / np.linalg.norm(way) * max_speed


def arrive_without_a_limit(positions: Array, target: Array, max_speed: float, slowing: float) -> Array:
    return max_speed * (target - positions) / slowing


def test_steering() -> None:
    assert "zero by" not in check.seek(seek_that_divides).hint
    assert "divides by zero at the target" in check.seek(seek_that_divides).hint
    assert "axis=1, keepdims=True" in check.seek(seek_of_the_whole).hint
    assert "far agents are faster" in check.arrive(arrive_without_a_limit).hint
    now = check.pursue(lambda at, quarry, velocity, speed, most: reference.seek(at, quarry, speed))
    assert "where the quarry is now" in now.hint


def flock_that_pulls(offsets: Array, velocity: Array, velocities: Array, weights: Sequence[float]) -> Array:
    total = np.zeros(2)
    for x in offsets:
        total += weights[0] * x / max(x @ x, 1e-12)
    return total + reference.flocking(offsets, velocity, velocities, (0, weights[1], weights[2]))


def flock_of_the_mean(offsets: Array, velocity: Array, velocities: Array, weights: Sequence[float]) -> Array:
    squared = (offsets**2).sum(axis=1, keepdims=True)
    parts = -(offsets / squared).sum(axis=0), velocities.mean(axis=0) - velocity, offsets.mean(axis=0)
    return np.asarray(sum(weight * part for weight, part in zip(weights, parts, strict=True)))


def flock_with_the_mean_of_nothing(offsets: Array, *rest: Any) -> Array:
    return np.array([np.nan, np.nan]) if len(offsets) == 0 else reference.flocking(offsets, *rest)


def test_flocks() -> None:
    assert "wrong sign: it pulls" in check.flock(flock_that_pulls).hint
    assert "mean of no neighbours" in check.flock(flock_with_the_mean_of_nothing).hint
    both = check.flock(flock_of_the_mean)
    assert not both


def rbf_without_a_linear_part(anchors: Array, velocities: Array, places: Array) -> Array:
    def phi(at: Array) -> Array:
        squared = ((at[:, None] - anchors) ** 2).sum(axis=2)
        return np.where(squared > 0, squared * np.log(np.where(squared > 0, squared, 1)), 0)

    return phi(places) @ np.linalg.solve(phi(anchors), velocities)


def rbf_with_the_logarithm_of_zero(anchors: Array, velocities: Array, places: Array) -> Array:
    r = np.linalg.norm(places[:, None] - anchors, axis=2)
    phi = r**2 * np.log(r)
    return np.where(np.isnan(phi.sum(axis=1, keepdims=True)), np.nan, reference.rbf(anchors, velocities)(places))


def test_fields() -> None:
    assert "linear part is missing" in check.rbf(rbf_without_a_linear_part).hint
    assert "log 0" in check.rbf(rbf_with_the_logarithm_of_zero).hint
    singular = check.rbf(lambda a, v, p: np.linalg.solve(np.zeros((2, 2)), np.ones(2)))
    assert "no unique solution" in singular.hint


def gradient(places: Array) -> Array:
    return np.asarray(reference.potential(places, seed=3)[1])


def test_divergence() -> None:
    for field, hint in [
        (gradient, "this is the gradient"),
        (lambda at: gradient(at)[:, ::-1], "one of the two signs is wrong"),
        (lambda at: reference.curl(gradient(at))[:, ::-1], "components are exchanged"),
        (lambda at: reference.curl(gradient(at)) * np.exp(-at[:, :1]), "Multiply the potential"),
        (lambda at: np.zeros_like(at), "the same everywhere"),
        (lambda at: np.full_like(at, np.nan), "not finite"),
    ]:
        verdict = check.divergence(field)
        assert not verdict and hint in verdict.hint, verdict
    assert "for places of the shape (400, 2)" in repr(check.divergence(lambda at: at[0]))
    assert "wrong sign" not in check.divergence(lambda at: -reference.curl(gradient(at))).hint
    assert check.divergence(lambda at: -reference.curl(gradient(at)))


@pytest.mark.parametrize("examine", CHECKS)
def test_functions_that_fail_are_told_so(examine: Callable[..., check.Verdict]) -> None:
    def empty(*given: Any) -> Any:
        raise NotImplementedError("return the answer")

    verdict = examine(empty)
    assert not verdict and verdict.hint == "write the function first."
    assert "NotImplementedError: return the answer (line" in repr(verdict) and "`empty`" in repr(verdict)
    assert not examine(lambda *given: None)
    assert not examine(lambda *given: "left")
    assert not examine(lambda *given: np.zeros(7))
    assert "divides by zero" in examine(lambda *given: 1 / 0).hint
    if examine is not check.divergence:
        assert "end it with `return`" in examine(lambda *given: None).hint
        assert "must take the arguments" in examine(lambda: 0).hint


def test_a_function_cannot_change_its_inputs() -> None:
    def greedy(positions: Array, target: Array, max_speed: float) -> Array:
        positions -= target
        return reference.seek(positions, [0, 0], max_speed)

    assert check.seek(greedy)


def test_checks_are_the_same_each_time() -> None:
    code = "from throng_sim import check; print(check.cone(lambda x, r, v: x @ v > 0))"
    texts = {subprocess.run([sys.executable, "-c", code], capture_output=True, text=True).stdout for _ in range(2)}
    assert len(texts) == 1 and "answers are wrong" in texts.pop()
