"""Worlds: agents that move."""

from __future__ import annotations

import enum
import json
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
import numpy.typing as npt

from . import _throng, _toml
from ._model import Model
from ._summary import Summary

if TYPE_CHECKING:
    from ._scene import Scene

Floats = npt.NDArray[np.floating[Any]]


class Status(enum.IntEnum):
    """Where an agent is on its trip."""

    WALKING = 0
    WAITING = 1
    ARRIVED = 2
    STRANDED = 3


class Event(NamedTuple):
    """Something that happened to an agent."""

    time: float
    """Seconds since the start."""
    id: int
    """The number of the agent."""
    kind: str
    """`entered`, `replanned`, `stuck`, `stranded`, `arrived` or `left`."""


@dataclass(frozen=True)
class Neighbors:
    """Neighbours of all agents, nearest first, as a sparse matrix in rows (CSR)."""

    indptr: npt.NDArray[np.int64]
    """Where the neighbours of each agent begin, and the end: n + 1 numbers."""
    indices: npt.NDArray[np.int64]
    """Rows of the neighbours in the arrays of the world."""
    distance: npt.NDArray[np.float64]
    """Distances between centres, metres."""

    def of(self, row: int) -> npt.NDArray[np.int64]:
        """Returns the rows of the neighbours of one agent."""
        return self.indices[self.indptr[row] : self.indptr[row + 1]]


class World:
    """Agents that move, made by `Scene.build`.

    Arrays have a row for each agent that is present, in the order of `ids`. They are live: a step writes them anew, and
    they stay the same objects while the same agents are present. When agents enter, leave, are added or removed, the
    world has new arrays, and those that you hold keep their last values. They cannot be written; `.copy()` is yours.

    `preferred` and `goals` are for you to write: the world obeys at its next step.
    """

    _world: _throng.World
    _scene: Scene
    behavior: Callable[[World], npt.ArrayLike] | None
    """A behaviour in Python for all agents: before each step it gets the world and returns the velocities that the agents
    prefer, m/s, (n, 2); NaN: the agent decides itself. None: all agents decide themselves."""

    def __init__(self) -> None:
        raise TypeError("a world is made by `Scene.build()`")

    @classmethod
    def _of(cls, world: _throng.World, scene: Scene) -> World:
        made = cls.__new__(cls)
        made._world, made._scene, made.behavior = world, scene, None
        return made

    @property
    def positions(self) -> npt.NDArray[np.float64]:
        """Centres, world coordinates in metres: (n, 2)."""
        return self._world.positions

    @property
    def velocities(self) -> npt.NDArray[np.float32]:
        """Velocities along the ground, m/s: (n, 2)."""
        return self._world.velocities

    @property
    def altitudes(self) -> npt.NDArray[np.float32]:
        """Heights of the centres above the ground, metres: (n,)."""
        return self._world.altitudes

    @property
    def vertical_velocities(self) -> npt.NDArray[np.float32]:
        """Velocities upwards, m/s: (n,)."""
        return self._world.vertical_velocities

    @property
    def headings(self) -> npt.NDArray[np.float32]:
        """Directions of the bodies, radians counter-clockwise from +x: (n,)."""
        return self._world.headings

    @property
    def radii(self) -> npt.NDArray[np.float32]:
        """Radii of the bodies, metres: (n,)."""
        return self._world.radii

    @property
    def preferred_speeds(self) -> npt.NDArray[np.float32]:
        """Speeds of agents that nothing hinders, m/s: (n,)."""
        return self._world.preferred_speeds

    @property
    def max_speeds(self) -> npt.NDArray[np.float32]:
        """Top speeds, m/s: (n,)."""
        return self._world.max_speeds

    @property
    def status(self) -> npt.NDArray[np.uint8]:
        """Where the agents are on their trips, as numbers of `Status`: (n,)."""
        return self._world.status

    @property
    def groups(self) -> npt.NDArray[np.uint32]:
        """Indices into `group_names`: (n,)."""
        return self._world.groups

    @property
    def ids(self) -> npt.NDArray[np.uint32]:
        """The numbers of the agents that are present, rising: (n,)."""
        return self._world.ids

    @property
    def preferred(self) -> npt.NDArray[np.float64]:
        """Velocities that agents prefer, m/s, for you to write: (n, 2). NaN: the agent decides itself."""
        return self._world.preferred

    @preferred.setter
    def preferred(self, given: npt.ArrayLike) -> None:
        self._world.preferred[...] = given

    @property
    def goals(self) -> npt.NDArray[np.float64]:
        """The points to which agents go, for you to write: (n, 2). NaN: no goal that is a point."""
        return self._world.goals

    @goals.setter
    def goals(self, given: npt.ArrayLike) -> None:
        self._world.goals[...] = given

    def targets(self) -> npt.NDArray[np.float64]:
        """Returns the nearest point of the goal to which each agent goes now, also of areas: (n, 2). NaN: no goal."""
        return self._world.targets()

    def walls(self) -> npt.NDArray[np.float64]:
        """Returns both ends of all walls, x, y, x, y in metres: (m, 4). A disc is a polygon of 32 walls."""
        return self._world.walls()

    @property
    def group_names(self) -> list[str]:
        """The names of the groups."""
        return self._world.group_names

    @property
    def time(self) -> float:
        """Seconds since the start."""
        return self._world.time

    @property
    def dt(self) -> float:
        """Seconds of a step."""
        return self._world.dt

    @property
    def bounds(self) -> npt.NDArray[np.float64]:
        """Lower left and upper right corner of the scene, metres: (2, 2)."""
        return np.array(self._world.bounds)

    @property
    def notes(self) -> list[str]:
        """Notes about the scene, a sentence each."""
        return self._world.notes

    @property
    def finished(self) -> bool:
        """Whether the scene is over."""
        return self._world.is_at_end()

    @property
    def threads(self) -> int:
        """The number of threads of a step; 0: one for each core."""
        return self._world.threads

    @property
    def summary(self) -> Summary:
        """Statistics of the run so far: those of `throng run`. NaN stands for what is unknown."""
        known = json.loads(self._world.summary_json())
        return Summary({name: np.nan if value is None else value for name, value in known.items()})

    @property
    def expectations(self) -> Summary:
        """Whether the run meets the scene's `[expect]`: `passed`, and the `checks`."""
        return Summary(json.loads(self._world.expectations_json()))

    @property
    def events(self) -> list[Event]:
        """What happened in the last call of `step` or `run`; with a `behavior`, in the last step."""
        return [Event(*row) for row in self._world.event_rows()]

    def __len__(self) -> int:
        return len(self._world)

    def __repr__(self) -> str:
        return f"<World: {len(self)} agents, {self.time:.2f} s>"

    def step(self, n: int = 1) -> None:
        """Makes `n` steps. Other Python threads run meanwhile. Ctrl-C ends it after a whole step."""
        if n < 0:
            raise ValueError(f"n is {n}, but must be at least 0 steps")
        if self.behavior is None:
            self._world.step(n)
            return
        for _ in range(n):
            self._obey()
            self._world.step(1)

    def run(self, until: float | None = None) -> Summary:
        """Makes steps until the scene is over, or until `until` seconds. Returns the summary."""
        if self.behavior is None:
            self._world.advance(until)
        while self.behavior is not None and not self._world.is_at_end(until):
            self.step()
        return self.summary

    def _obey(self) -> None:
        """Sets the preferred velocities of the behaviour."""
        assert self.behavior is not None
        wanted = np.asarray(self.behavior(self), dtype=np.float64)
        if wanted.shape != (len(self), 2):
            name = getattr(self.behavior, "__name__", "of this world")
            raise ValueError(
                f"the behaviour `{name}` returned an array of shape {wanted.shape}; return one of shape ({len(self)}, 2),"
                " a velocity in m/s for each agent"
            )
        self.preferred[:] = wanted

    def add(
        self,
        group: str,
        at: npt.ArrayLike,
        *,
        goal: npt.ArrayLike | None = None,
        heading: npt.ArrayLike | None = None,
        velocity: npt.ArrayLike | None = None,
    ) -> npt.NDArray[np.uint32]:
        """Adds agents like the first of a group at places, (2,) or (k, 2). Returns their numbers.

        They have the group's goal, or `goal`, (2,) or (k, 2). Raises `WorldError` for a place without room; the agents
        before it are then added.
        """
        places = _rows(at, "at")
        count = len(places)
        numbers = self._world.add_agents(
            group,
            places,
            None if goal is None else np.ascontiguousarray(np.broadcast_to(_rows(goal, "goal"), (count, 2))),
            None if heading is None else np.ascontiguousarray(np.broadcast_to(np.asarray(heading, float), (count,))),
            None if velocity is None else np.ascontiguousarray(np.broadcast_to(_rows(velocity, "velocity"), (count, 2))),
        )
        return np.array(numbers, dtype=np.uint32)

    def remove(self, ids: int | Iterable[int]) -> None:
        """Removes agents by their numbers."""
        self._world.remove_agents([ids] if isinstance(ids, (int, np.integer)) else [int(k) for k in ids])

    def move(self, id: int, at: Sequence[float]) -> None:
        """Moves an agent to another place, as your own physics does."""
        x, y = at
        self._world.set_position(id, x, y)

    def push(self, id: int, velocity: Sequence[float]) -> None:
        """Sets the velocity of an agent, m/s."""
        x, y = velocity
        self._world.set_velocity(id, x, y)

    def __setitem__(self, path: str, value: Any) -> None:
        """Changes a value of the groups while the world runs: `world["avoid.orca.time_horizon"] = 2.5`."""
        if not self._world.tune(path, _toml.value(value)):
            raise ValueError(f"`{path}` cannot change while a world runs: set it in the scene, and build that")

    def set_model(self, model: Model) -> None:
        """Gives all agents a local model in Python."""
        self._world.set_model(model.called, model.sees, model.reach, model.neighbors)

    def neighbors(self, k: int = 10, distance: float = np.inf) -> Neighbors:
        """Returns the `k` nearest agents of each agent within `distance` metres between centres."""
        if k < 0:
            raise ValueError(f"k is {k}, but must be at least 0")
        return Neighbors(*self._world.neighbor_lists(k, distance))

    def explain(self, id: int, *, width: int = 900, height: int = 700, dark: bool = False) -> Figure:
        """Draws the velocity space of an agent: what its neighbours and walls forbid, and what it chooses."""
        return Figure(self._world.explain_svg(id, width, height, dark))

    def hash(self) -> int:
        """Returns a hash of the whole state: equal for equal runs on every machine."""
        return self._world.hash()

    def save(self) -> bytes:
        """Returns the whole state, for `load`."""
        return self._world.save()

    def load(self, state: bytes) -> None:
        """Goes back to a state that `save` returned, of a world of the same scene."""
        self._world.load(state)

    def clone(self) -> World:
        """Returns an equal world, which goes its own way."""
        twin = self._of(self._world.clone(), self._scene)
        twin.behavior = self.behavior
        return twin

    __copy__ = clone

    def __deepcopy__(self, memo: dict[int, Any]) -> World:
        return self.clone()

    def __reduce__(self) -> tuple[Any, ...]:
        return _unpickle, (self._scene, self._world.scene_toml(), self.threads, self.save())


class Figure:
    """A picture as SVG, which a notebook shows."""

    def __init__(self, svg: str) -> None:
        self.svg = svg

    def _repr_svg_(self) -> str:
        return self.svg

    def save(self, path: str | Path) -> None:
        """Writes the SVG file."""
        Path(path).write_text(self.svg, encoding="utf-8")


def _unpickle(scene: Scene, text: str, threads: int, state: bytes) -> World:
    now = _throng.Scene.parse(text, "scene", scene._scene.folder)
    world = World._of(now.build(threads), scene)
    world.load(state)
    return world


def _rows(given: npt.ArrayLike, name: str) -> npt.NDArray[np.float64]:
    rows = np.atleast_2d(np.asarray(given, dtype=np.float64))
    if rows.ndim != 2 or rows.shape[1] != 2:
        raise ValueError(f"`{name}` has the shape {np.shape(given)}, but must be (2,) or (k, 2)")
    return np.ascontiguousarray(rows)


class Stepper:
    """Threads that step several worlds side by side; `threads=0`: one for each core.

    >>> import throng_sim as tg
    >>> worlds = [tg.Scene("circle").build(seed=seed) for seed in range(4)]
    >>> tg.Stepper(threads=2).step(worlds, 10)
    >>> [round(world.time, 2) for world in worlds]
    [0.4, 0.4, 0.4, 0.4]
    """

    def __init__(self, threads: int = 0) -> None:
        self._stepper = _throng.Stepper(threads)

    def step(self, worlds: Sequence[World], n: int = 1) -> None:
        """Makes `n` steps of each world. Each gets the same bits as alone."""
        self._stepper.step([world._world for world in worlds], n)


def step_all(worlds: Sequence[World], n: int = 1, *, threads: int = 0) -> None:
    """Makes `n` steps of several worlds, as a `Stepper` does, which keeps its threads for many calls."""
    Stepper(threads).step(worlds, n)
