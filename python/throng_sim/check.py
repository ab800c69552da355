"""Checks of functions that you write, before you make a film of them.

A film shows that something is wrong; a check shows what. Each check calls your function with some hundreds of inputs,
compares the answers with the exact ones, and names the likely mistake: it also knows the answers of the classic ones.

>>> from throng_sim import check
>>> def mine(offset, radius_sum, relative_velocity):
...     x, y = offset
...     u, v = relative_velocity
...     return abs(x * v - y * u) <= radius_sum * (u * u + v * v) ** 0.5
>>> check.cone(mine)
cone: 45 of 1008 answers are wrong. The first:
    offset = [3. 0.]
    radius_sum = 1.0
    relative_velocity = [-1.  0.]
  expected: False
  returned: True
  hint: neighbours behind the agent count too. The cone opens to the neighbour: offset · relative_velocity > 0.
>>> bool(check.cone(mine))
False
"""

from __future__ import annotations

import traceback
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import numpy.typing as npt

from . import reference

Array = npt.NDArray[np.float64]
Function = Callable[..., Any]


@dataclass(frozen=True, repr=False)
class Verdict:
    """What a check found. It is true if all answers are right."""

    name: str
    """The name of the check."""
    cases: int
    """The number of inputs."""
    wrong: int = 0
    """The number of wrong answers."""
    given: dict[str, Any] = field(default_factory=dict)
    """The first input with a wrong answer."""
    expected: Any = None
    returned: Any = None
    hint: str = ""
    """The likely mistake, if the check knows one."""

    def __bool__(self) -> bool:
        return self.wrong == 0

    def __repr__(self) -> str:
        if self:
            return f"{self.name}: all {self.cases} answers are right."
        lines = [f"{self.name}: {self.wrong} of {self.cases} answers are wrong. The first:"]
        lines += [f"    {name} = {_text(value)}" for name, value in self.given.items()]
        lines += [f"  expected: {_text(self.expected)}", f"  returned: {_text(self.returned)}"]
        if self.hint:
            lines.append(f"  hint: {self.hint}")
        return "\n".join(lines)

    def require(self) -> None:
        """Raises `AssertionError` with the text of the verdict unless all answers are right."""
        if not self:
            raise AssertionError(repr(self))


@dataclass(frozen=True)
class Mistake:
    """A classic mistake: a function that makes it, and what to tell its author."""

    hint: str
    answer: Function


@dataclass(frozen=True)
class Case:
    """An input, and what is special about it."""

    given: dict[str, Any]
    special: str = ""


class Raised:
    """An exception instead of an answer."""

    def __init__(self, error: Exception) -> None:
        self.error = error
        frames = traceback.extract_tb(error.__traceback__)
        yours = [frame for frame in frames if frame.filename != __file__ and "site-packages" not in frame.filename]
        where = f" (line {yours[-1].lineno} of `{yours[-1].name}`)" if yours else ""
        self.text = f"{type(error).__name__}: {error}{where}"

    def __repr__(self) -> str:
        return self.text


def cone(mine: Function) -> Verdict:
    """Checks `mine(offset, radius_sum, relative_velocity) -> bool`: whether the relative velocity is in the cone.

    `offset` leads to the neighbour's centre, (2,), metres; `radius_sum` is the sum of the radii; `relative_velocity` is
    the agent's less the neighbour's, (2,), m/s. True if the bodies touch at any time, or overlap already.

    >>> from throng_sim import check, reference
    >>> check.cone(reference.in_cone)
    cone: all 1008 answers are right.
    """
    cases = [Case(given, special) for given, special in _pairs(np.random.default_rng(1))]
    return _judge("cone", mine, reference.in_cone, cases, CONE)


def truncated_cone(mine: Function) -> Verdict:
    """Checks `mine(offset, radius_sum, relative_velocity, horizon) -> bool`: whether they touch within `horizon` s.

    >>> from throng_sim import check, reference
    >>> check.truncated_cone(reference.in_truncated_cone)
    truncated_cone: all 1008 answers are right.
    """
    rng = np.random.default_rng(2)
    cases = []
    for given, special in _pairs(rng):
        horizon = float(rng.uniform(0.5, 4.0))
        time = float(reference.time_to_collision(*given.values()))
        if abs(time - horizon) > 1e-3 * horizon:
            cases.append(Case({**given, "horizon": horizon}, special))
    return _judge("truncated_cone", mine, reference.in_truncated_cone, cases, TRUNCATED_CONE)


def half_plane(mine: Function) -> Verdict:
    """Checks `mine(offset, radius_sum, velocity, other_velocity, horizon) -> (point, normal)`: the half-plane of ORCA.

    `point` is any point of the line, (2,); `normal` a unit vector to the permitted side, (2,). The agent does half of
    the avoidance. The bodies do not overlap.

    >>> from throng_sim import check, reference
    >>> check.half_plane(reference.half_plane)
    half_plane: all 963 answers are right.
    """
    rng = np.random.default_rng(3)
    cases = []
    for given, special in _pairs(rng):
        offset, radius_sum, relative = given.values()
        if special in ("bodies overlap", "bodies are at the same place"):
            continue
        other = rng.normal(0, 1, 2)
        horizon = float(rng.uniform(0.5, 4.0))
        edge = np.linalg.norm(relative - offset / horizon)
        if edge < 1e-2 or abs(_det(offset, relative - offset / horizon)) < 1e-3:
            continue
        velocity = {"velocity": relative + other, "other_velocity": other, "horizon": horizon}
        cases.append(Case({"offset": offset, "radius_sum": radius_sum, **velocity}, special))
    return _judge("half_plane", mine, _HalfPlane(), cases, HALF_PLANE, _same_half_plane)


def linear_program(mine: Function) -> Verdict:
    """Checks `mine(points, normals, max_speed, preferred) -> velocity`: the nearest velocity that half-planes permit.

    `points` and `normals` are (k, 2): v is permitted if (v - point) . normal >= 0. The answer is no faster than
    `max_speed`. There is always a permitted velocity.

    >>> from throng_sim import check, reference
    >>> check.linear_program(reference.linear_program)
    linear_program: all 200 answers are right.
    """
    rng = np.random.default_rng(4)
    cases = [
        Case(
            {"points": np.empty((0, 2)), "normals": np.empty((0, 2)), "max_speed": 1.0, "preferred": np.array([2.0, 0])}
        ),
        Case(
            {
                "points": np.array([[0.5, 0]]),
                "normals": np.array([[-1.0, 0]]),
                "max_speed": 2.0,
                "preferred": np.ones(2),
            }
        ),
    ]
    while len(cases) < 200:
        count = int(rng.integers(1, 7))
        angle = rng.uniform(0, 2 * np.pi, count)
        normals = np.stack([np.cos(angle), np.sin(angle)], axis=1)
        points = rng.normal(0, 0.2, 2) - normals * rng.uniform(0.0, 0.6, (count, 1))
        preferred = rng.normal(0, 1.0, 2)
        if _program(points, normals, 1.5, preferred) is not None:
            given = {"points": points, "normals": normals, "max_speed": 1.5, "preferred": preferred}
            cases.append(Case(given))
    return _judge("linear_program", mine, _program, cases, LINEAR_PROGRAM)


def seek(mine: Function) -> Verdict:
    """Checks `mine(positions, target, max_speed) -> velocities`: (n, 2), (2,), a number -> (n, 2); 0 at the target.

    >>> from throng_sim import check, reference
    >>> check.seek(reference.seek)
    seek: all 100 answers are right.
    """
    return _judge("seek", mine, reference.seek, _targets(5), SEEK)


def arrive(mine: Function) -> Verdict:
    """Checks `mine(positions, target, max_speed, slowing) -> velocities`: as `seek`, slower within `slowing` metres.

    The speed there is max_speed times distance / slowing.

    >>> from throng_sim import check, reference
    >>> check.arrive(reference.arrive)
    arrive: all 100 answers are right.
    """
    rng = np.random.default_rng(6)
    cases = [Case({**c.given, "slowing": float(rng.uniform(1, 6))}, c.special) for c in _targets(6)]
    return _judge("arrive", mine, reference.arrive, cases, ARRIVE)


def pursue(mine: Function) -> Verdict:
    """Checks `mine(positions, quarry, quarry_velocity, max_speed, most) -> velocities`.

    They lead, at top speed, to where the quarry, (2,), will be after distance / max_speed seconds, at most `most`.

    >>> from throng_sim import check, reference
    >>> check.pursue(reference.pursue)
    pursue: all 100 answers are right.
    """
    rng = np.random.default_rng(7)
    cases = []
    for case in _targets(7):
        positions, target, speed = case.given.values()
        moves = {"quarry": target, "quarry_velocity": rng.normal(0, 1, 2), "max_speed": speed}
        cases.append(Case({"positions": positions, **moves, "most": float(rng.uniform(0.5, 3))}, case.special))
    return _judge("pursue", mine, reference.pursue, cases, PURSUE)


def flock(mine: Function) -> Verdict:
    """Checks `mine(offsets, velocity, velocities, weights) -> acceleration`: the rules of boids for one agent.

    `offsets`, (k, 2), lead to the neighbours; `velocity`, (2,), is the agent's own, `velocities`, (k, 2), are theirs.
    The answer is the sum of three rules times `weights`: separation, minus the sum of offset / distance^2; alignment,
    mean velocity less own; cohesion, mean offset. Zero without neighbours; a neighbour at the same place does not push.

    >>> from throng_sim import check, reference
    >>> check.flock(reference.flocking)
    flock: all 256 answers are right.
    """
    rng = np.random.default_rng(8)
    cases = []
    for weights in ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0), (1.5, 1.0, 0.7)):
        for count in (1, 2, 0, *rng.integers(3, 9, 60)):
            offsets = rng.uniform(-3, 3, (count, 2)).round(1) + 0.05
            velocity, velocities = rng.normal(0, 1, 2).round(2), rng.normal(0, 1, (count, 2)).round(2)
            given = {"offsets": offsets, "velocity": velocity, "velocities": velocities, "weights": weights}
            cases.append(Case(given, "" if count else "there are no neighbours"))
        same = {**given, "offsets": np.concatenate([[[0.0, 0.0]], offsets[1:]])}
        cases.append(Case(same, "a neighbour is at the same place"))
    return _judge("flock", mine, reference.flocking, cases, FLOCK)


def rbf(mine: Function) -> Verdict:
    """Checks `mine(anchors, velocities, places) -> velocities there`: (k, 2), (k, 2), (m, 2) -> (m, 2).

    Thin plates r^2 log r with a linear part: the field has the given velocities at the anchors.

    >>> from throng_sim import check, reference
    >>> check.rbf(lambda anchors, velocities, places: reference.rbf(anchors, velocities)(places))
    rbf: all 99 answers are right.
    """
    rng = np.random.default_rng(9)
    cases = []
    for count in (3, 4, 5, *rng.integers(6, 15, 30)):
        anchors, velocities = rng.uniform(-5, 5, (count, 2)), rng.normal(0, 1, (count, 2))
        for places, special in ((anchors, "places are anchors"), (rng.uniform(-6, 6, (7, 2)), "")):
            cases.append(Case({"anchors": anchors, "velocities": velocities, "places": places}, special))
        slope = rng.normal(0, 1, (2, 2))
        linear = {"anchors": anchors, "velocities": anchors @ slope, "places": rng.uniform(-6, 6, (7, 2))}
        cases.append(Case(linear, "the velocities are linear in the place"))
    return _judge(
        "rbf", mine, lambda anchors, velocities, places: reference.rbf(anchors, velocities)(places), cases, RBF
    )


def divergence(mine: Function, *, size: float = 4.0, scale: float = 1.0) -> Verdict:
    """Checks that the field `mine(places) -> velocities`, (m, 2) -> (m, 2), has no sources and no sinks.

    It measures du/dx + dv/dy at 400 places within `size` metres of the origin. `scale` is the size of the field's
    features, metres.

    >>> from throng_sim import check, reference
    >>> check.divergence(reference.curl_noise)
    divergence: all 400 answers are right.
    """
    places = np.random.default_rng(10).uniform(-size, size, (400, 2))
    try:
        slope = _slope(mine, places, scale)
    except NotImplementedError as error:
        return _not_written("divergence", len(places), {"places": places}, error)
    except Exception as error:
        raised = Raised(error)
        return Verdict(
            "divergence", len(places), len(places), {"places": places}, "velocities", raised, _on_error(error)
        )
    size_of_slope = np.abs(slope).max(axis=(1, 2))
    found = slope[:, 0, 0] + slope[:, 1, 1]
    wrong = ~(np.abs(found) <= 1e-3 * np.nanmax(size_of_slope, initial=0.0))
    hint = ""
    if not np.isfinite(slope).all():
        hint = "some velocities are not finite. Does a division by zero, or a logarithm of zero, occur?"
    elif size_of_slope.max() < 1e-9:
        hint, wrong = "the field is the same everywhere.", np.ones(len(places), bool)
    elif wrong.any():
        hint = _divergence_hint(slope)
    if not wrong.any():
        return Verdict("divergence", len(places))
    first = int(np.argmax(wrong))
    return Verdict(
        "divergence", len(places), int(wrong.sum()), {"place": places[first]}, "divergence 0", float(found[first]), hint
    )


def _slope(mine: Function, places: Array, scale: float) -> Array:
    """Returns the derivatives of a field by central differences: [place, of the component, by the coordinate]."""
    step = 1e-4 * scale
    columns = []
    for axis in np.eye(2) * step:
        ahead, behind = (np.asarray(mine(places + sign * axis), float) for sign in (1, -1))
        if ahead.shape != places.shape:
            raise ValueError(f"the field returned the shape {ahead.shape} for places of the shape {places.shape}")
        columns.append((ahead - behind) / (2 * step))
    return np.stack(columns, axis=-1)


def _divergence_hint(slope: Array) -> str:
    (ux, uy), (vx, vy) = slope[:, 0].T, slope[:, 1].T
    least = 1e-3 * np.abs(slope).max()
    if np.abs(vx - uy).max() < least:
        return (
            "this is the gradient of the potential. Its curl is the gradient turned by a right angle: (psi_y, -psi_x)."
        )
    if np.abs(ux - vy).max() < least:
        return "one of the two signs is wrong: (psi_y, -psi_x), with a minus in one component."
    if np.abs(uy + vx).max() < least:
        return "the components are exchanged: (psi_y, -psi_x)."
    return "the velocity is no curl. Multiply the potential, not its curl, by factors that depend on the place."


# ---- the classic mistakes ----


def _det(a: Array, b: Array) -> float:
    return float(a[0] * b[1] - a[1] * b[0])


def _angle(offset: Array, v: Array) -> float:
    return float(np.arctan2(abs(_det(offset, v)), offset @ v))


def _size(offset: Array) -> float:
    return float(np.hypot(*offset))


def _cut(offset: Array, radius: float, v: Array, far: float) -> bool:
    return bool(reference.in_cone(offset, radius, v)) and bool(offset @ v >= far * _size(offset))


CONE = [
    Mistake(
        "neighbours behind the agent count too. The cone opens to the neighbour: offset · relative_velocity > 0.",
        lambda x, r, v: abs(_det(x, v)) <= r * _size(v),
    ),
    Mistake(
        "relative velocity or offset has the wrong sign. The relative velocity is v_A - v_B, the offset x_B - x_A.",
        lambda x, r, v: reference.in_cone(x, r, -v),
    ),
    Mistake(
        "the answer is the opposite: return True inside of the cone.", lambda x, r, v: not reference.in_cone(x, r, v)
    ),
    Mistake(
        "the radii are not summed: half of radius_sum is used. The agent shrinks to a point, the neighbour grows to a "
        "disc with the sum of both radii.",
        lambda x, r, v: reference.in_cone(x, r / 2, v),
    ),
    Mistake("radius_sum counts twice: it is the sum of both radii.", lambda x, r, v: reference.in_cone(x, 2 * r, v)),
    Mistake(
        "half of the opening angle is arcsin(radius_sum / distance), not arctan: the legs are tangents of the disc.",
        lambda x, r, v: _size(x) < r or _angle(x, v) <= np.arctan(r / _size(x)),
    ),
    Mistake(
        "angles do not wrap: the difference of 179 and -179 degrees is 2, not 358. Use offset · velocity and the "
        "determinant, or wrap the difference to -pi .. pi.",
        lambda x, r, v: _size(x) < r or abs(np.arctan2(*v[::-1]) - np.arctan2(*x[::-1])) <= np.arcsin(r / _size(x)),
    ),
    Mistake(
        "the opening angle is compared, not half of it: the cone reaches arcsin(radius_sum / distance) to each side.",
        lambda x, r, v: _size(x) < r or _angle(x, v) <= 2 * np.arcsin(r / _size(x)),
    ),
    Mistake(
        "degrees are compared with radians.",
        lambda x, r, v: _size(x) < r or np.degrees(_angle(x, v)) <= np.arcsin(r / _size(x)),
    ),
    Mistake(
        "the square of the distance is used where the distance belongs: take the root.",
        lambda x, r, v: x @ x < r or _angle(x, v) <= np.arcsin(r / (x @ x)),
    ),
    Mistake(
        "bodies that overlap already touch: return True for a distance less than radius_sum, before arcsin fails.",
        lambda x, r, v: _size(x) >= r and reference.in_cone(x, r, v),
    ),
    Mistake(
        "bodies that overlap already touch, also if they part: return True for a distance less than radius_sum.",
        lambda x, r, v: x @ v > 0 and reference.in_cone(x, r, v),
    ),
]

TRUNCATED_CONE = [
    Mistake(
        "the cone is not truncated: a collision after the horizon does not count.",
        lambda x, r, v, h: reference.in_cone(x, r, v),
    ),
    Mistake(
        "the cone is cut straight at offset / horizon. Its tip is a disc round that point, of radius_sum / horizon.",
        lambda x, r, v, h: _size(x) < r or _cut(x, r, v, _size(x) / h),
    ),
    Mistake(
        "the cone is cut straight in front of the disc. Its tip is round: the disc of radius_sum / horizon.",
        lambda x, r, v, h: _size(x) < r or _cut(x, r, v, (_size(x) - r) / h),
    ),
    Mistake(
        "only the disc at the tip counts. The cone goes on behind it: faster velocities collide sooner.",
        lambda x, r, v, h: _size(x) < r or np.hypot(*(v - x / h)) <= r / h,
    ),
    Mistake(
        "the horizon is used upside down: divide offset and radius_sum by it.",
        lambda x, r, v, h: reference.in_truncated_cone(x, r, v, 1 / h),
    ),
    Mistake(
        "relative velocity or offset has the wrong sign. The relative velocity is v_A - v_B, the offset x_B - x_A.",
        lambda x, r, v, h: reference.in_truncated_cone(x, r, -v, h),
    ),
    Mistake(
        "the answer is the opposite: return True inside of the cone.",
        lambda x, r, v, h: not reference.in_truncated_cone(x, r, v, h),
    ),
    Mistake(
        "the radii are not summed: half of radius_sum is used.",
        lambda x, r, v, h: reference.in_truncated_cone(x, r / 2, v, h),
    ),
    Mistake(
        "bodies that overlap already touch: return True for a distance less than radius_sum.",
        lambda x, r, v, h: _size(x) >= r and reference.in_truncated_cone(x, r, v, h),
    ),
    Mistake(
        "bodies that overlap already touch, also if they part: return True for a distance less than radius_sum.",
        lambda x, r, v, h: (_size(x) >= r or x @ v > 0) and reference.in_truncated_cone(x, r, v, h),
    ),
]


@dataclass(frozen=True)
class _HalfPlane:
    """The half-plane of ORCA, with switches for mistakes."""

    share: float = 0.5
    part: str = "both"
    start: str = "velocity"
    normal: str = "outward"
    swaps_legs: bool = False
    reverses: bool = False
    disc: str = "divided"

    def __call__(
        self, offset: Array, radius_sum: float, velocity: Array, other_velocity: Array, horizon: float
    ) -> tuple[Array, Array]:
        relative = (velocity - other_velocity) * (-1 if self.reverses else 1)
        w = relative - offset / horizon
        far = float(np.hypot(*w))
        left, right = reference.legs(offset, radius_sum)
        leg = left if (_det(offset, w) > 0) != self.swaps_legs else -right
        behind = float(w @ offset)
        nearest_on_disc = behind < 0 and behind**2 > radius_sum**2 * far**2
        if {"both": nearest_on_disc, "disc": True, "legs": False}[self.part]:
            outward = w / far
            change = outward * ((radius_sum / horizon if self.disc == "divided" else radius_sum) - far)
        else:
            outward = np.array([-leg[1], leg[0]])
            change = leg * (relative @ leg) - relative
        normal = {"outward": outward, "inward": -outward, "along u": change / max(np.hypot(*change), 1e-12)}[
            self.normal
        ]
        start = {"velocity": velocity, "zero": 0 * velocity, "other": other_velocity, "relative": relative}[self.start]
        return start + self.share * change, normal


HALF_PLANE = [
    Mistake(
        "the whole change u is taken. The neighbour does the other half: the line goes through velocity + u / 2.",
        _HalfPlane(share=1.0),
    ),
    Mistake("u is not added: the line goes through velocity + u / 2.", _HalfPlane(share=0.0)),
    Mistake("u has the wrong sign: it leads out of the cone.", _HalfPlane(share=-0.5)),
    Mistake(
        "the normal points to the forbidden side: it is the outward normal of the cone.", _HalfPlane(normal="inward")
    ),
    Mistake(
        "the normal is the direction of u. That is right only inside of the cone; outside, u leads to it, and the "
        "outward normal is -u / |u|.",
        _HalfPlane(normal="along u"),
    ),
    Mistake("the agent's own velocity is missing: the line goes through velocity + u / 2.", _HalfPlane(start="zero")),
    Mistake(
        "the line starts at the neighbour's velocity: it goes through velocity + u / 2.", _HalfPlane(start="other")
    ),
    Mistake(
        "the line starts at the relative velocity: it goes through the agent's own velocity + u / 2.",
        _HalfPlane(start="relative"),
    ),
    Mistake("only the disc at the tip is used: the legs of the cone are missing.", _HalfPlane(part="disc")),
    Mistake("only the legs are used: the cone is not truncated by the disc at its tip.", _HalfPlane(part="legs")),
    Mistake(
        "the left and the right leg are exchanged: det(offset, w) > 0 is the left one.", _HalfPlane(swaps_legs=True)
    ),
    Mistake("the relative velocity has the wrong sign: it is velocity - other_velocity.", _HalfPlane(reverses=True)),
    Mistake("the radius of the disc at the tip is radius_sum / horizon, not radius_sum.", _HalfPlane(disc="whole")),
    Mistake(
        "the horizon is used upside down: divide offset and radius_sum by it.",
        lambda x, r, v, o, h: _HalfPlane()(x, r, v, o, 1 / h),
    ),
    Mistake(
        "the radii are not summed: half of radius_sum is used.", lambda x, r, v, o, h: _HalfPlane()(x, r / 2, v, o, h)
    ),
]


def _program(points: Array, normals: Array, max_speed: float, preferred: Array) -> Array | None:
    """Returns the nearest permitted velocity by trying all corners: slow and simple. None if nothing is permitted."""
    directions = np.stack([normals[:, 1], -normals[:, 0]], axis=1)
    tried = [preferred, *_crossings(np.zeros((0, 2)), np.zeros((0, 2)), max_speed)]
    speed = float(np.hypot(*preferred))
    if speed > 0:
        tried.append(preferred * max_speed / speed)
    tried += [p + d * ((preferred - p) @ d) for p, d in zip(points, directions, strict=True)]
    tried += _crossings(points, directions, max_speed)
    permitted = [
        v
        for v in tried
        if np.hypot(*v) <= max_speed + 1e-9 and bool((((v - points) * normals).sum(axis=1) >= -1e-9).all())
    ]
    return min(permitted, key=lambda v: float(np.hypot(*(v - preferred)))) if permitted else None


def _crossings(points: Array, directions: Array, max_speed: float) -> list[Array]:
    """Returns the crossings of lines with each other, and with the circle of the top speed."""
    found = []
    for i, (p, d) in enumerate(zip(points, directions, strict=True)):
        under = (p @ d) ** 2 - p @ p + max_speed**2
        if under >= 0:
            found += [p + d * (-(p @ d) + sign * np.sqrt(under)) for sign in (1, -1)]
        for q, e in zip(points[:i], directions[:i], strict=True):
            if abs(_det(d, e)) > 1e-12:
                found.append(p + d * (_det(q - p, e) / _det(d, e)))
    return found


def _one_pass(points: Array, normals: Array, max_speed: float, preferred: Array) -> Array:
    velocity = _limit(preferred, max_speed)
    for point, normal in zip(points, normals, strict=True):
        velocity = velocity - min((velocity - point) @ normal, 0.0) * normal
    return _limit(velocity, max_speed)


def _limit(velocity: Array, most: float) -> Array:
    return velocity * min(1.0, most / max(float(np.hypot(*velocity)), 1e-12))


def _permitted(velocity: Array, points: Array, normals: Array) -> bool:
    return bool((((velocity - points) * normals).sum(axis=1) >= 0).all())


def _slow_only_if_hindered(points: Array, normals: Array, max_speed: float, preferred: Array) -> Array | None:
    return preferred if _permitted(preferred, points, normals) else _program(points, normals, max_speed, preferred)


def _from_uncut(points: Array, normals: Array, max_speed: float, preferred: Array) -> Array | None:
    velocity: Array | None = preferred
    for i, (point, normal) in enumerate(zip(points, normals, strict=True)):
        if velocity is not None and (velocity - point) @ normal < 0:
            # on the line: permitted from both sides
            both = np.concatenate([points[:i], [point, point]]), np.concatenate([normals[:i], [normal, -normal]])
            velocity = _program(*both, max_speed, preferred)
    return velocity


def _stop(points: Array, normals: Array, max_speed: float, preferred: Array) -> Array:
    best = _limit(preferred, max_speed)
    return best if _permitted(best, points, normals) else 0 * best


LINEAR_PROGRAM = [
    Mistake("the half-planes have no effect.", lambda p, n, s, v: _limit(v, s)),
    Mistake("max_speed has no effect.", lambda p, n, s, v: _program(p, n, 1e6, v)),
    Mistake(
        "the result is cut to max_speed afterwards, and may then be forbidden: the circle of max_speed is one more "
        "limit on each line.",
        lambda p, n, s, v: _limit(np.asarray(_program(p, n, 1e6, v), float), s),
    ),
    Mistake(
        "max_speed counts only if a half-plane is violated: cut the preferred velocity first.", _slow_only_if_hindered
    ),
    Mistake("the preferred velocity is not cut to max_speed before the first half-plane.", _from_uncut),
    Mistake(
        "each violated line is handled alone: the nearest point on a line must also satisfy the lines before it.",
        _one_pass,
    ),
    Mistake("the permitted side is the one to which the normal points.", lambda p, n, s, v: _program(p, -n, s, v)),
    Mistake("it stops where the preferred velocity is forbidden: find the nearest permitted one.", _stop),
]


def _nan_at_target(function: Function) -> Function:
    def answer(positions: Array, target: Array, *rest: Any) -> Array:
        found = np.array(function(positions, target, *rest))
        found[(positions == target).all(axis=1)] = np.nan
        return found

    return answer


def _whole_norm(x: Array, t: Array, speed: float) -> Array:
    return (t - x) / max(float(np.linalg.norm(t - x)), 1e-12) * speed


AT_TARGET = "it divides by zero at the target: the velocity there is zero, not NaN."
NORM = "np.linalg.norm takes the whole array for one vector: give it axis=1, keepdims=True."

SEEK = [
    Mistake(AT_TARGET, _nan_at_target(reference.seek)),
    Mistake("the way to the target is not normalised: far agents are faster.", lambda x, t, s: t - x),
    Mistake(
        "the way to the target is not normalised before it is multiplied by max_speed.", lambda x, t, s: (t - x) * s
    ),
    Mistake("the sign is wrong: it flees. The way to the target is target - positions.", reference.flee),
    Mistake(NORM, _whole_norm),
    Mistake("max_speed is missing: the velocities have length 1.", lambda x, t, s: reference.seek(x, t, 1.0)),
    Mistake(
        "the speed is limited, not set: it is less near the target. Normalise, then multiply by max_speed.",
        lambda x, t, s: reference.arrive(x, t, s, s),
    ),
]

ARRIVE = [
    Mistake(AT_TARGET, _nan_at_target(reference.arrive)),
    Mistake("it does not slow down within `slowing`: this is seek.", lambda x, t, s, d: reference.seek(x, t, s)),
    Mistake(
        "far agents are faster than max_speed: distance / slowing is at most 1.", lambda x, t, s, d: (t - x) / d * s
    ),
    Mistake(
        "the way to the target is not normalised.",
        lambda x, t, s, d: (t - x) * s * np.minimum(_far(x, t) / d, 1),
    ),
    Mistake("the sign is wrong: it flees.", lambda x, t, s, d: -reference.arrive(x, t, s, d)),
    Mistake(
        "the ramp is upside down: distance / slowing, not 1 - distance / slowing.",
        lambda x, t, s, d: reference.seek(x, t, s) * (1 - np.minimum(_far(x, t) / d, 1)),
    ),
    Mistake(
        "the ramp is quadratic: the speed is max_speed times distance / slowing.",
        lambda x, t, s, d: reference.seek(x, t, s) * np.minimum(_far(x, t) / d, 1) ** 2,
    ),
    Mistake(
        "max_speed is missing in the ramp: the speed is max_speed times distance / slowing.",
        lambda x, t, s, d: reference.seek(x, t, 1.0) * np.minimum(np.where(_far(x, t) < d, _far(x, t) / d, s), s),
    ),
    Mistake(NORM, lambda x, t, s, d: _whole_norm(x, t, s) * min(float(np.linalg.norm(t - x)) / d, 1)),
]


def _far(x: Array, t: Array) -> Array:
    return np.asarray(np.linalg.norm(t - x, axis=1, keepdims=True))


PURSUE = [
    Mistake(AT_TARGET, lambda x, q, v, s, m: _nan_at_target(reference.pursue)(x, q, v, s, m)),
    Mistake(
        "it seeks where the quarry is now: add quarry_velocity times the time.",
        lambda x, q, v, s, m: reference.seek(x, q, s),
    ),
    Mistake("the time is not limited by `most`.", lambda x, q, v, s, m: reference.pursue(x, q, v, s, 1e9)),
    Mistake(
        "the time is always `most`: it is distance / max_speed, at most `most`.",
        lambda x, q, v, s, m: reference.seek(x, q + m * v, s),
    ),
    Mistake("the sign is wrong: it evades.", reference.evade),
    Mistake(
        "the time is the distance: divide it by max_speed.",
        lambda x, q, v, s, m: reference.seek(x, q + v * np.minimum(_far(x, q), m), s),
    ),
    Mistake(
        "the prediction has the wrong sign: it seeks where the quarry was.",
        lambda x, q, v, s, m: reference.pursue(x, q, -v, s, m),
    ),
]

Rule = Callable[[Array, Array, Array], Array]


def _flock(
    separation: Rule = lambda x, v, w: reference.separation(x),
    alignment: Rule = lambda x, v, w: reference.alignment(v, w),
    cohesion: Rule = lambda x, v, w: reference.cohesion(x),
) -> Function:
    def answer(offsets: Array, velocity: Array, velocities: Array, weights: Sequence[float]) -> Array:
        rules = (separation, alignment, cohesion)
        parts = [rule(offsets, velocity, velocities) for rule in rules]
        return np.asarray(sum((weight * part for weight, part in zip(weights, parts, strict=True)), np.zeros(2)))

    return answer


def _nan_if(condition: Callable[[Array], bool]) -> Function:
    def answer(offsets: Array, *rest: Any) -> Array:
        return np.full(2, np.nan) if condition(offsets) else _flock()(offsets, *rest)

    return answer


def _power(x: Array, power: float) -> Array:
    far = np.linalg.norm(x, axis=1, keepdims=True)
    return np.asarray(-(x * np.divide(1.0, far**power, out=np.zeros_like(far), where=far > 0)).sum(axis=0))


FLOCK = [
    Mistake(
        "it divides by zero at a neighbour at the same place: leave that neighbour out of separation.",
        _nan_if(lambda x: bool((x == 0).all(axis=1).any())),
    ),
    Mistake("the mean of no neighbours is NaN: return zero without neighbours.", _nan_if(lambda x: len(x) == 0)),
    Mistake(
        "separation has the wrong sign: it pulls. The push is minus the offset, and then two agents push each other "
        "oppositely.",
        _flock(separation=lambda x, v, w: -reference.separation(x)),
    ),
    Mistake(
        "separation does not depend on the distance: divide offset by distance^2, not by distance.",
        _flock(separation=lambda x, v, w: _power(x, 1)),
    ),
    Mistake("separation grows with the distance: divide offset by distance^2.", _flock(lambda x, v, w: -x.sum(axis=0))),
    Mistake(
        "separation falls with the square of the distance: divide offset by distance^2, not by distance^3.",
        _flock(lambda x, v, w: _power(x, 3)),
    ),
    Mistake(
        "separation is the mean of the pushes: it is their sum.",
        _flock(lambda x, v, w: reference.separation(x) / max(len(x), 1)),
    ),
    Mistake(
        "alignment is the mean velocity: subtract the agent's own.",
        _flock(alignment=lambda x, v, w: w.mean(axis=0) if len(w) else np.zeros(2)),
    ),
    Mistake(
        "alignment has the wrong sign: mean velocity less own.",
        _flock(alignment=lambda x, v, w: -reference.alignment(v, w)),
    ),
    Mistake(
        "alignment is the sum of the differences: it is their mean.",
        _flock(alignment=lambda x, v, w: (w - v).sum(axis=0)),
    ),
    Mistake("cohesion is the sum of the offsets: it is their mean.", _flock(cohesion=lambda x, v, w: x.sum(axis=0))),
    Mistake(
        "cohesion has the wrong sign: offsets lead to the neighbours.",
        _flock(cohesion=lambda x, v, w: -reference.cohesion(x)),
    ),
    Mistake(
        "cohesion is a unit vector: it is the mean offset.",
        _flock(cohesion=lambda x, v, w: _unit(reference.cohesion(x))),
    ),
    Mistake("the weights have no effect.", lambda x, v, w, weights: _flock()(x, v, w, (1, 1, 1))),
    Mistake(
        "the weights are in the wrong order: separation, alignment, cohesion.",
        lambda x, v, w, weights: _flock()(x, v, w, (weights[0], weights[2], weights[1])),
    ),
]


def _unit(v: Array) -> Array:
    return v / max(float(np.hypot(*v)), 1e-12)


def _radial(kernel: Callable[[Array], Array], terms: int = 3) -> Function:
    """Returns an interpolation with another kernel and the first `terms` of 1, x, y."""

    def answer(anchors: Array, velocities: Array, places: Array) -> Array:
        def columns(at: Array) -> tuple[Array, Array]:
            r = np.linalg.norm(at[:, None] - anchors, axis=2)
            return kernel(r), np.column_stack([np.ones(len(at)), at])[:, :terms]

        phi, p = columns(anchors)
        system = np.block([[phi, p], [p.T, np.zeros((terms, terms))]])
        weights = np.linalg.lstsq(system, np.concatenate([velocities, np.zeros((terms, 2))]))[0]
        return np.asarray(np.column_stack(columns(places)) @ weights)

    return answer


def _exact_rbf(anchors: Array, velocities: Array, places: Array) -> Array:
    return reference.rbf(anchors, velocities)(places)


def _nan_at_anchors(anchors: Array, velocities: Array, places: Array) -> Array:
    found = _exact_rbf(anchors, velocities, places)
    found[(places[:, None] == anchors).all(axis=2).any(axis=1)] = np.nan
    return found


def _all_nan(anchors: Array, velocities: Array, places: Array) -> Array:
    return np.full(places.shape, np.nan)


LOG_OF_ZERO = "log 0 is minus infinity, and 0 times it NaN: the kernel is 0 at 0."

RBF = [
    Mistake(LOG_OF_ZERO, _all_nan),
    Mistake(LOG_OF_ZERO, _nan_at_anchors),
    Mistake(
        "the linear part is missing: add columns 1, x, y, and the rows that make their weights unique.",
        _radial(reference.thin_plate, 0),
    ),
    Mistake("the linear part has only its constant: add columns x and y.", _radial(reference.thin_plate, 1)),
    Mistake("the kernel is r: thin plates in the plane are r^2 log r.", _radial(lambda r: r)),
    Mistake("the kernel is r log r: thin plates are r^2 log r.", _radial(lambda r: r * np.log(np.where(r > 0, r, 1)))),
    Mistake("the kernel is r^3: thin plates in the plane are r^2 log r.", _radial(lambda r: r**3)),
    Mistake("the kernel is a Gaussian: thin plates are r^2 log r.", _radial(lambda r: np.exp(-(r**2)))),
    Mistake("x and y of the velocities are exchanged.", lambda a, v, p: _exact_rbf(a, v, p)[:, ::-1]),
    Mistake("the sign of the velocities is wrong.", lambda a, v, p: -_exact_rbf(a, v, p)),
    Mistake(
        "the field is a weighted mean of the velocities: solve the linear system for the weights.",
        lambda a, v, p: _shepard(a, v, p),
    ),
]


def _shepard(anchors: Array, velocities: Array, places: Array) -> Array:
    weights = 1 / np.maximum(np.linalg.norm(places[:, None] - anchors, axis=2), 1e-12) ** 2
    return np.asarray(weights @ velocities / weights.sum(axis=1, keepdims=True))


# ---- inputs ----


def _pairs(rng: np.random.Generator) -> Iterable[tuple[dict[str, Any], str]]:
    """Yields pairs of discs, half of them on or near a course to a collision, none that just graze."""
    simple: list[tuple[list[float], float, list[float], str]] = [
        ([3, 0], 1, [1, 0], ""),
        ([3, 0], 1, [0, 1], ""),
        ([3, 0], 1, [-1, 0], "the neighbour is behind"),
        ([-3, 0.1], 1, [-1, -0.1], "directions are near 180 degrees"),
        ([-3, 0.1], 1, [-1, 0.2], "directions are near 180 degrees"),
        ([0.5, 0], 1, [1, 0], "bodies overlap"),
        ([0.5, 0], 1, [-1, 0], "bodies overlap"),
        ([0, 0], 1, [1, 0], "bodies are at the same place"),
    ]
    for place, size, moves, special in simple:
        yield _pair(np.array(place, float), float(size), np.array(moves, float)), special
    left = 1000
    while left:
        radius = float(rng.uniform(0.2, 1.0))
        overlaps = left % 25 == 0
        distance = radius * float(rng.uniform(0.2, 0.9) if overlaps else rng.uniform(1.1, 10))
        angle = rng.uniform(-np.pi, np.pi)
        ahead = rng.normal(0, 1.2) * np.arcsin(min(radius / distance, 1.0))
        course = angle + (ahead if left % 2 else rng.uniform(-np.pi, np.pi))
        offset = distance * np.array([np.cos(angle), np.sin(angle)])
        velocity = float(rng.uniform(0.1, 3)) * np.array([np.cos(course), np.sin(course)])
        passes = abs(_det(offset, velocity)) / np.hypot(*velocity)
        if abs(passes - radius) > 0.01 * radius and abs(offset @ velocity) > 0.01:
            left -= 1
            special = "bodies overlap" if overlaps else "the neighbour is behind" if offset @ velocity < 0 else ""
            yield _pair(offset, radius, velocity), special


def _pair(offset: Array, radius: float, velocity: Array) -> dict[str, Any]:
    return {"offset": offset, "radius_sum": radius, "relative_velocity": velocity}


def _targets(seed: int) -> list[Case]:
    """Returns agents and targets; in some cases an agent is at the target."""
    rng = np.random.default_rng(seed)
    cases = []
    for k, count in enumerate((1, 1, 2, *rng.integers(2, 9, 97))):
        positions, target = rng.uniform(-9, 9, (count, 2)).round(1), rng.uniform(-9, 9, 2).round(1)
        near = rng.random(count) < 0.4
        positions[near] = target + rng.uniform(-1, 1, (int(near.sum()), 2)).round(1) + 0.05
        at_target = k % 10 == 1
        if at_target:
            positions[0] = target
        given = {"positions": positions, "target": target, "max_speed": round(float(rng.uniform(1.1, 3)), 1)}
        cases.append(Case(given, "an agent is at the target" if at_target else ""))
    return cases


# ---- judging ----


def _judge(
    name: str,
    mine: Function,
    exact: Function,
    cases: Sequence[Case],
    mistakes: Sequence[Mistake],
    agrees: Callable[[Any, Any], bool] | None = None,
) -> Verdict:
    """Compares the answers of a function with the exact ones, and finds the mistake."""
    same = agrees or _same
    with np.errstate(all="ignore"):
        expected = [exact(*case.given.values()) for case in cases]
        returned = [_call(mine, case) for case in cases]
        wrong = [k for k in range(len(cases)) if not same(returned[k], expected[k])]
        if not wrong:
            return Verdict(name, len(cases))
        first = wrong[0]
        given, answer = cases[first].given, returned[first]
        if isinstance(answer, Raised) and isinstance(answer.error, NotImplementedError):
            return _not_written(name, len(cases), given, answer.error)
        hint = _form_hint(answer, expected[first]) or _mistake_hint(mistakes, cases, returned, wrong, same)
        hint = hint or _nan_hint(answer) or _special_hint(cases, wrong)
    return Verdict(name, len(cases), len(wrong), given, expected[first], answer, hint)


def _not_written(name: str, cases: int, given: dict[str, Any], error: NotImplementedError) -> Verdict:
    return Verdict(name, cases, cases, given, "an answer", Raised(error), "write the function first.")


def _call(function: Function, case: Case) -> Any:
    try:
        return function(*(np.array(v) if isinstance(v, np.ndarray) else v for v in case.given.values()))
    except Exception as error:
        return Raised(error)


def _same(returned: Any, expected: Any) -> bool:
    """Whether two answers are equal up to rounding. NaN equals NaN."""
    if isinstance(returned, Raised) or isinstance(expected, Raised) or returned is None or expected is None:
        return False
    if np.asarray(expected).dtype == bool:
        return bool(np.shape(returned) == () and returned in (True, False) and bool(returned) == bool(expected))
    try:
        found, right = np.asarray(returned, float), np.asarray(expected, float)
    except (TypeError, ValueError):
        return False
    size = float(np.nanmax(np.abs(right), initial=1.0))
    return found.shape == right.shape and bool(np.allclose(found, right, rtol=0, atol=1e-4 * size, equal_nan=True))


def _same_half_plane(returned: Any, expected: Any) -> bool:
    """Whether two half-planes are equal: any point of the line will do."""
    try:
        point, normal = (np.asarray(part, float) for part in returned)
    except (TypeError, ValueError):
        return False
    right_point, right_normal = expected
    if point.shape != (2,) or not _same(normal, right_normal):
        return False
    return bool(abs((point - right_point) @ right_normal) < 1e-4 * max(1.0, float(np.hypot(*right_point))))


def _form_hint(returned: Any, expected: Any) -> str:
    """Returns what is wrong with the form of an answer, whatever its value."""
    if isinstance(returned, Raised):
        return _on_error(returned.error)
    if returned is None:
        return "the function returns nothing: end it with `return`."
    if isinstance(expected, tuple):
        try:
            parts = [np.shape(part) for part in returned]
        except TypeError:
            return "return two things: point, normal."
        if parts != [(2,), (2,)]:
            return f"the shapes are {parts}; return point, (2,), and normal, (2,)."
        size = float(np.hypot(*returned[1]))
        if abs(size - 1) > 1e-3:
            return f"the normal has the length {size:.3g}: it is a unit vector. Divide it by its length."
        return ""
    if np.shape(returned) != np.shape(expected):
        return f"the shape is {np.shape(returned)}, but must be {np.shape(expected)}."
    return ""


def _on_error(error: Exception) -> str:
    match error:
        case ZeroDivisionError():
            return "it divides by zero."
        case TypeError() if "positional argument" in str(error):
            return "it must take the arguments above, in this order."
        case np.linalg.LinAlgError():
            return "the linear system has no unique solution: are rows or columns missing, or the same?"
    return ""


def _mistake_hint(
    mistakes: Sequence[Mistake],
    cases: Sequence[Case],
    returned: Sequence[Any],
    wrong: Sequence[int],
    same: Callable[[Any, Any], bool],
) -> str:
    """Returns the hint of the mistake that gives nearly all of these answers, wrong and right ones."""
    best, most = "", 0
    some = wrong[:: max(1, len(wrong) // 20)]
    for mistake in mistakes:
        # most mistakes differ at once
        answers = {k: _call(mistake.answer, cases[k]) for k in some}
        if sum(answer is None or same(returned[k], answer) for k, answer in answers.items()) < 0.8 * len(some):
            continue
        answers = {k: _call(mistake.answer, case) for k, case in enumerate(cases)}
        # without an answer, the mistake says nothing about the input
        known = {k for k in range(len(cases)) if answers[k] is not None}
        agrees = {k for k in known if same(returned[k], answers[k])}
        tells = known.intersection(wrong)
        explains = len(agrees & tells) >= 0.95 * max(len(tells), 0.2 * len(wrong), 1)
        if explains and len(agrees) >= 0.98 * len(known) and len(agrees) > most:
            best, most = mistake.hint, len(agrees)
    return best


def _nan_hint(returned: Any) -> str:
    """Returns where an answer that is not a number may come from."""
    try:
        finite = np.isfinite(np.asarray(returned, float)).all()
    except (TypeError, ValueError):
        return ""
    return "" if finite else "it is not a number: look for a division by zero, a root of a negative number, or log 0."


def _special_hint(cases: Sequence[Case], wrong: Sequence[int]) -> str:
    """Returns what all inputs with wrong answers have in common."""
    special = {cases[k].special for k in wrong}
    if len(special) == 1 and (only := special.pop()):
        return f"the answer is wrong only where {only}."
    return ""


def _text(value: Any) -> str:
    if isinstance(value, np.ndarray):
        return np.array2string(value, precision=4, suppress_small=True, threshold=24).replace("\n", "\n" + 8 * " ")
    if isinstance(value, tuple):
        return ", ".join(_text(part) for part in value)
    if isinstance(value, float | np.floating):
        return repr(round(float(value), 6))
    return repr(bool(value) if isinstance(value, np.bool_) else value)
