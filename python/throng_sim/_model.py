"""Local models in Python."""

from __future__ import annotations

import functools
import inspect
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, overload

import numpy as np
import numpy.typing as npt

from . import _throng


class View:
    """What a model sees: its agents as they are at the start of a sub-step, a row for each, in the order of `ids`."""

    def __init__(self, native: _throng.View) -> None:
        self._native = native

    @property
    def time(self) -> float:
        """Time at the start of the step, seconds."""
        return self._native.time

    @property
    def dt(self) -> float:
        """Duration of the sub-step, seconds."""
        return self._native.dt

    @property
    def ids(self) -> npt.NDArray[np.uint32]:
        """Numbers of the agents: (n,)."""
        return self._native.ids

    @property
    def positions(self) -> npt.NDArray[np.float64]:
        """Centres, world coordinates in metres: (n, 2)."""
        return self._native.positions

    @property
    def velocities(self) -> npt.NDArray[np.float32]:
        """Velocities, m/s: (n, 2)."""
        return self._native.velocities

    @property
    def preferred(self) -> npt.NDArray[np.float32]:
        """Velocities that the agents prefer, m/s: (n, 2)."""
        return self._native.preferred

    @property
    def radii(self) -> npt.NDArray[np.float32]:
        """Radii of the bodies, metres: (n,)."""
        return self._native.radii

    @property
    def max_speeds(self) -> npt.NDArray[np.float32]:
        """Top speeds, m/s: (n,)."""
        return self._native.max_speeds

    @property
    def headings(self) -> npt.NDArray[np.float32]:
        """Headings, radians counter-clockwise from +x: (n,)."""
        return self._native.headings

    @functools.cached_property
    def near(self) -> Near:
        """The neighbours of all agents."""
        return Near(
            start=self._native.near_start,
            ids=self._native.near_ids,
            offsets=self._native.near_offsets,
            velocities=self._native.near_velocities,
            radii=self._native.near_radii,
            shares=self._native.near_shares,
        )

    @functools.cached_property
    def walls(self) -> Walls:
        """The walls near all agents."""
        ends = self._native.walls
        return Walls(start=self._native.wall_start, a=ends[:, :2], b=ends[:, 2:])

    def __len__(self) -> int:
        return len(self.ids)

    def sum(self, values: npt.ArrayLike) -> npt.NDArray[Any]:
        """Returns, for each agent, the sum of values that are given for each neighbour of `near`."""
        values, start = np.asarray(values), self.near.start
        if len(values) != len(self.near.ids):
            raise ValueError(f"there are {len(values)} values, but must be one for each of {len(self.near.ids)} neighbours")
        total = np.zeros((len(self), *values.shape[1:]), dtype=np.result_type(values, np.float32))
        some = start[:-1] < start[1:]
        if some.any():
            total[some] = np.add.reduceat(values, start[:-1][some], axis=0, dtype=total.dtype)
        return total


@dataclass(frozen=True)
class Near:
    """The neighbours of all agents: a row for each pair of an agent and a neighbour, nearest first."""

    start: npt.NDArray[np.int64]
    """Where the neighbours of each agent begin, and the end: (n + 1,)."""
    ids: npt.NDArray[np.uint32]
    """Numbers of the neighbours: (m,)."""
    offsets: npt.NDArray[np.float32]
    """Their centres, from that of the agent, metres: (m, 2)."""
    velocities: npt.NDArray[np.float32]
    """Their velocities, m/s: (m, 2)."""
    radii: npt.NDArray[np.float32]
    """Sums of both radii, metres: (m,)."""
    shares: npt.NDArray[np.float32]
    """The agent's share of the avoidance, 0 to 1: (m,)."""

    @functools.cached_property
    def row(self) -> npt.NDArray[np.int64]:
        """The row of the agent in the view: (m,)."""
        return _owners(self.start)

    @functools.cached_property
    def distances(self) -> npt.NDArray[np.float32]:
        """The distances between both centres, metres: (m,)."""
        return np.hypot(self.offsets[:, 0], self.offsets[:, 1])


@dataclass(frozen=True)
class Walls:
    """The walls near all agents: a row for each pair of an agent and a wall."""

    start: npt.NDArray[np.int64]
    """Where the walls of each agent begin, and the end: (n + 1,)."""
    a: npt.NDArray[np.float32]
    """One end, from the centre of the agent, metres: (m, 2)."""
    b: npt.NDArray[np.float32]
    """The other end: (m, 2)."""

    @functools.cached_property
    def row(self) -> npt.NDArray[np.int64]:
        """The row of the agent in the view: (m,)."""
        return _owners(self.start)


@dataclass(frozen=True)
class Me:
    """The agent that chooses a velocity."""

    id: int
    position: npt.NDArray[np.float64]
    velocity: npt.NDArray[np.float32]
    preferred: npt.NDArray[np.float32]
    radius: float
    max_speed: float
    heading: float


@dataclass(frozen=True)
class Other:
    """A neighbour of the agent that chooses a velocity."""

    id: int
    offset: npt.NDArray[np.float32]
    """From the centre of the agent to that of the neighbour, metres."""
    position: npt.NDArray[np.float64]
    velocity: npt.NDArray[np.float32]
    radius: float
    share: float
    """The agent's share of the avoidance, 0 to 1."""


@dataclass(frozen=True)
class Each:
    """What a model for one agent at a time sees."""

    me: Me
    others: list[Other]
    """The neighbours, nearest first."""
    walls: list[tuple[npt.NDArray[np.float32], npt.NDArray[np.float32]]]
    """The walls near the agent: both ends, from its centre, metres."""
    offsets: npt.NDArray[np.float32]
    """The centres of the neighbours, from that of the agent, metres: (k, 2)."""
    velocities: npt.NDArray[np.float32]
    """The velocities of the neighbours, m/s: (k, 2)."""
    time: float
    dt: float


class Model:
    """A local model in Python. It is also the function that it was made from."""

    def __init__(
        self,
        function: Callable[..., Any],
        *,
        each: bool,
        sees: float,
        reach: float | None,
        neighbors: int | None,
        name: str | None,
    ) -> None:
        functools.update_wrapper(self, function)
        self.function = function
        self.each, self.sees, self.reach, self.neighbors = each, sees, reach, neighbors
        self.name: str = name or str(getattr(function, "__name__", type(function).__name__))

    def __call__(self, view: Any) -> Any:
        return self.function(view)

    def called(self, native: Any) -> npt.NDArray[np.float64]:
        """Returns the velocities for a view of the engine."""
        view = View(native)
        try:
            return self._one_by_one(view) if self.each else _checked(self.function(view), len(view))
        except Exception as error:
            error.add_note(f"in the model `{self.name}`{_where(self.function)}, at {view.time:.2f} s")
            raise

    def _one_by_one(self, view: View) -> npt.NDArray[np.float64]:
        chosen = np.empty((len(view), 2))
        for k, seen in enumerate(each_of(view)):
            velocity = self.function(seen)
            try:
                x, y = velocity
                chosen[k] = x, y
            except (TypeError, ValueError):
                raise TypeError(
                    f"the model returned {velocity!r} for agent {seen.me.id}; return a velocity: two numbers, m/s"
                ) from None
            if not np.isfinite(chosen[k]).all():
                raise ValueError(
                    f"the model returned {velocity!r} for agent {seen.me.id}; the numbers of a velocity must be finite"
                )
        return chosen

    def __repr__(self) -> str:
        return f"<Model {self.name}{_where(self.function)}>"

    def __reduce__(self) -> Any:
        raise TypeError(f"the model `{self.name}` cannot be pickled: define it in a module, and give its name to workers")


def _checked(returned: Any, count: int) -> npt.NDArray[np.float64]:
    """Returns what a model returned for `count` agents as an array."""
    wanted = f"an array of {count} by 2 numbers, a velocity in m/s for each agent of the view"
    if returned is None:
        raise TypeError(f"the model returned None; return {wanted}")
    try:
        chosen = np.asarray(returned, np.float64)
    except (TypeError, ValueError) as error:
        raise TypeError(f"the model returned an object of type {type(returned).__name__}; return {wanted}") from error
    if chosen.shape != (count, 2):
        raise ValueError(f"the model returned an array of shape {chosen.shape}; return {wanted}")
    if not np.isfinite(chosen).all():
        row = int(np.argmin(np.isfinite(chosen).all(axis=1)))
        x, y = chosen[row]
        raise ValueError(f"the model returned [{x}, {y}] for row {row} of the view; velocities must be finite")
    return chosen


def each_of(view: View) -> list[Each]:
    """Returns what each agent of a view sees."""
    near, walls = view.near, view.walls
    seen = []
    for k in range(len(view)):
        position = view.positions[k]
        radius = float(view.radii[k])
        pairs = slice(near.start[k], near.start[k + 1])
        others = [
            Other(int(number), offset, position + offset, velocity, max(float(both) - radius, 0.0), float(share))
            for number, offset, velocity, both, share in zip(
                near.ids[pairs],
                near.offsets[pairs],
                near.velocities[pairs],
                near.radii[pairs],
                near.shares[pairs],
                strict=True,
            )
        ]
        edges = slice(walls.start[k], walls.start[k + 1])
        me = Me(
            int(view.ids[k]),
            position,
            view.velocities[k],
            view.preferred[k],
            radius,
            float(view.max_speeds[k]),
            float(view.headings[k]),
        )
        sides = list(zip(walls.a[edges], walls.b[edges], strict=True))
        seen.append(Each(me, others, sides, near.offsets[pairs], near.velocities[pairs], view.time, view.dt))
    return seen


def _owners(start: npt.NDArray[np.int64]) -> npt.NDArray[np.int64]:
    return np.repeat(np.arange(len(start) - 1), np.diff(start))


def _where(function: Callable[..., Any]) -> str:
    try:
        code = inspect.unwrap(function).__code__
    except (AttributeError, ValueError):
        return ""
    return f" ({code.co_filename}, line {code.co_firstlineno})"


@overload
def model(function: Callable[..., Any], /) -> Model: ...
@overload
def model(
    *,
    each: bool = False,
    sees: float = 2.0,
    reach: float | None = None,
    neighbors: int | None = None,
    name: str | None = None,
) -> Callable[[Callable[..., Any]], Model]: ...
def model(
    function: Callable[..., Any] | None = None,
    /,
    *,
    each: bool = False,
    sees: float = 2.0,
    reach: float | None = None,
    neighbors: int | None = None,
    name: str | None = None,
) -> Any:
    """Makes a local model of a function, which turns preferred velocities into velocities.

    The function gets a `View` of all agents and returns an array of velocities, (n, 2), once a sub-step. With
    `each=True` it gets an `Each` for one agent at a time, and returns two numbers: slow, and easy to write. The limits
    of the bodies and the guard apply afterwards, so that agents never overlap.

    `sees` is how far an agent sees walls, metres from its body; `reach` how far it sees neighbours, metres between
    centres, and `neighbors` how many: by default as the scene says.

    >>> import throng_sim as tg
    >>> @tg.model
    ... def timid(view):
    ...     return 0.5 * view.preferred
    >>> tg.Scene("circle").build(model=timid).step()
    """
    if sees < 0 or not np.isfinite(sees):
        raise ValueError(f"sees is {sees}, but must be at least 0 m")

    def make(function: Callable[..., Any]) -> Model:
        if not callable(function):
            raise TypeError(f"a model is made of a function, not of {function!r}")
        return Model(function, each=each, sees=sees, reach=reach, neighbors=neighbors, name=name)

    return make if function is None else make(function)


def named_or_python(given: str | Model | Callable[..., Any] | None) -> tuple[str | None, Model | None]:
    """Returns the name of a model of the engine, or a model in Python."""
    match given:
        case None:
            return None, None
        case str():
            return given, None
        case Model():
            return None, given
        case _ if callable(given):
            return None, model(given)
    raise TypeError(f"{given!r} is not a model: give a name, or a function made with `throng_sim.model`")
