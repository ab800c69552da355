"""Worlds of one scene side by side, with agents under control in each: the common part of all environments."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, TypedDict

import gymnasium
import numpy as np
import numpy.typing as npt
from gymnasium.error import ResetNeeded

from .._model import Model
from .._scene import Scene
from .._world import Stepper, World
from . import _act, _reward
from ._control import Control, chosen
from ._observe import Observation
from ._reward import Reward, RewardFunction, Transition
from ._state import Bools, Floats, Ints, State

MARGIN = 1.5
"""The bound of observed velocities, as a multiple of the greatest top speed."""


class Options(TypedDict, total=False):
    """Options of all environments."""

    observe: str
    """`nearest-K`, `walls-R`, or both with a plus; see `Observation`. `nearest-10` if not given."""
    action: str
    """`velocity`, `speed-turn` or `discrete`; see `Velocity`, `SpeedTurn` and `Discrete`. `velocity` if not given."""
    reward: RewardFunction
    """Returns rewards; see `Reward`, which is used if not given, and `Transition`."""
    model: str | Model | Callable[..., Any] | None
    """The local model of all agents in place of those of the scene, also of the agents under control: it turns the
    velocities that they prefer into safe ones. With `none` only the guard comes after the actions."""
    repeat: int
    """Steps of the engine for each action. 5 if not given."""
    limit: float | None
    """Seconds until the episode is truncated; that of the scene if not given."""
    sight: float
    """How far agents see, metres. 20 if not given."""
    seed: int | None
    """Seed of a first `reset` without one, and of the draw of a fraction; that of the scene if not given."""
    threads: int
    """Threads of a step; 0: one for each core. 1 if not given. They do not change the results."""


@dataclass(frozen=True)
class Outcome:
    """What a step led to: a row for each slot under control before it."""

    slots: Ints
    """World and place in `Batch.ids`: (a, 2)."""
    observations: npt.NDArray[np.float32]
    rewards: Floats
    arrived: Bools
    late: Bools
    """Whether the time is up, for agents that have not arrived."""
    infos: dict[str, Floats]


class Batch:
    """Worlds of one scene side by side, with the same agents under control in each.

    A slot is an agent under control in one of the worlds. It is live until the agent arrives or the time is up.
    """

    def __init__(
        self,
        scene: Scene | str,
        control: Control,
        count: int,
        *,
        observe: str = "nearest-10",
        action: str = "velocity",
        reward: RewardFunction | None = None,
        model: str | Model | Callable[..., Any] | None = None,
        repeat: int = 5,
        limit: float | None = None,
        sight: float = 20.0,
        seed: int | None = None,
        threads: int = 1,
    ) -> None:
        if repeat < 1:
            raise ValueError(f"repeat is {repeat}, but must be at least 1 step")
        if threads < 0:
            raise ValueError(f"threads is {threads}, but must be at least 0")
        self.scene = scene if isinstance(scene, Scene) else Scene(scene)
        self.limit = self.scene.limit if limit is None else float(limit)
        if not self.limit > 0:
            raise ValueError(f"limit is {limit}, but must be more than 0 s")
        self.first_seed = self.scene.seed if seed is None else int(seed)
        self._model, self._repeat, self._stepper = model, repeat, Stepper(threads)
        self._reward = Reward() if reward is None else reward
        self.seconds = repeat * self.scene.dt
        """Seconds of an action."""
        world = self._build(self.first_seed)
        self.ids = chosen(world, control, self.first_seed)
        """The numbers of the agents under control: (c,)."""
        self.names = [f"{world.group_names[world.groups[world.ids == number][0]]}_{number}" for number in self.ids]
        """Their names: group and number."""
        fastest = MARGIN * float(world.max_speeds.max())
        self.observation = Observation.parse(observe, sight=sight, fastest=fastest)
        self._kind = _act.action_kind(action)
        self._space = self._kind.space()
        self.worlds: dict[int, World] = {}
        """The worlds that have been reset, by their indices."""
        self.live = np.zeros((count, len(self.ids)), dtype=bool)
        """Which slots are live: (count, c)."""
        self._distance = np.zeros(self.live.shape)

    def world(self, index: int) -> World:
        """Returns a world that has been reset."""
        if index not in self.worlds:
            raise ResetNeeded("there is no world yet: call `reset` first")
        return self.worlds[index]

    def close(self) -> None:
        """Forgets all worlds."""
        self.worlds.clear()
        self.live[:] = False

    def observation_space(self) -> gymnasium.spaces.Box:
        """Returns a new space for the observations of an agent."""
        return self.observation.space()

    def action_space(self) -> gymnasium.Space[Any]:
        """Returns a new space for the actions of an agent."""
        return self._kind.space()

    def reset(self, index: int, seed: int) -> None:
        """Begins an episode of a world."""
        world = self._build(seed)
        _, there = State([world]).rows(np.zeros(len(self.ids), dtype=np.int64), self.ids)
        if not there.any():
            raise ValueError(f"with the seed {seed} no agent under control is present at the start")
        self.worlds[index] = world
        self.live[index] = there

    def observe(self, slots: Ints) -> tuple[npt.NDArray[np.float32], dict[str, Floats]]:
        """Returns the observations, (a, size), and infos of slots at the start of their episodes."""
        look = self._look(slots)
        self._distance[tuple(slots.T)] = look.distance
        return look.observations, self._infos(slots, look.distance)

    def step(self, actions: Any) -> Outcome:
        """Makes a step of all worlds with live slots. Actions are a row for each live slot, in the order of `live`."""
        slots = np.argwhere(self.live)

        def name(row: int) -> str:
            return f"`{self.names[slots[row, 1]]}`"

        self._command(slots, _act.checked(self._space, actions, len(slots), name))
        self._stepper.step([self.worlds[index] for index in _worlds(slots)], self._repeat)
        arrived = self._arrivals(slots)
        look = self._look(slots)
        arrived |= ~look.there
        distance = np.where(arrived, 0.0, look.distance)
        transition = Transition(
            progress=np.nan_to_num(self._distance[tuple(slots.T)] - distance),
            distance=distance,
            gap=look.gap,
            velocity=look.velocity,
            arrived=arrived,
            seconds=self.seconds,
        )
        rewards = _reward.checked(self._reward, transition)
        infos = self._infos(slots, distance)
        late = (infos["time"] > self.limit - 0.5 * self.scene.dt) & ~arrived
        self._distance[tuple(slots.T)] = distance
        self._release(slots[arrived])
        self.live[tuple(slots.T)] = ~(arrived | late)
        return Outcome(slots, look.observations, rewards, arrived, late, infos)

    def _build(self, seed: int) -> World:
        return self.scene.build(seed=seed, model=self._model)  # type: ignore[arg-type]

    def _command(self, slots: Ints, actions: npt.NDArray[Any]) -> None:
        """Gives the agents the velocities that they prefer."""
        state, rows, there = self._rows(slots)
        rows, actions = rows[there], actions[there]
        velocities = _act.preferred(self._kind, actions, state.headings[rows], state.max_speeds[rows])
        owners = state.owners(rows)
        for index, world in enumerate(state.worlds):
            here = owners == index
            world.preferred[rows[here] - state.first[index]] = velocities[here]

    def _release(self, slots: Ints) -> None:
        """Lets agents decide themselves again."""
        for index in _worlds(slots):
            world = self.worlds[index]
            world.preferred[np.isin(world.ids, self.ids[slots[slots[:, 0] == index, 1]])] = np.nan

    def _arrivals(self, slots: Ints) -> Bools:
        """Returns which agents have arrived or left during the step."""
        arrived = np.zeros(len(slots), dtype=bool)
        for index in _worlds(slots):
            ended = [event.id for event in self.worlds[index].events if event.kind in ("arrived", "left")]
            here = slots[:, 0] == index
            arrived[here] = np.isin(self.ids[slots[here, 1]], ended)
        return arrived

    def _rows(self, slots: Ints) -> tuple[State, Ints, Bools]:
        """Returns the state of the worlds of slots, the rows of the agents in it, and which of them are present."""
        indices = _worlds(slots)
        state = State([self.worlds[index] for index in indices])
        rows, there = state.rows(np.searchsorted(indices, slots[:, 0]), self.ids[slots[:, 1]])
        return state, rows, there

    def _look(self, slots: Ints) -> _Look:
        state, rows, there = self._rows(slots)
        here = rows[there]
        k = self.observation.neighbours
        others, exist = state.near(here, max(k, 1), self.observation.sight)
        look = _Look.empty(len(slots), self.observation.size, there)
        seen = np.empty((len(here), self.observation.size), dtype=np.float32)
        self.observation.write(state, here, (others[:, :k], exist[:, :k]), seen)
        look.observations[there] = seen
        at = state.positions[here]
        look.distance[there] = np.linalg.norm(state.targets[here] - at, axis=1)
        look.velocity[there] = state.velocities[here]
        centres = np.linalg.norm(state.positions[others] - at[:, None], axis=2)
        gaps = centres - state.radii[others] - state.radii[here][:, None]
        look.gap[there] = np.where(exist, gaps, np.inf).min(axis=1)
        return look

    def _infos(self, slots: Ints, distance: Floats) -> dict[str, Floats]:
        return {"time": np.array([self.worlds[index].time for index in slots[:, 0]]), "distance": distance}


@dataclass(frozen=True)
class _Look:
    """What agents under control see: a row for each; zeros for those that are not present."""

    there: Bools
    observations: npt.NDArray[np.float32]
    distance: Floats
    gap: Floats
    velocity: Floats

    @classmethod
    def empty(cls, count: int, size: int, there: Bools) -> _Look:
        observations = np.zeros((count, size), dtype=np.float32)
        return cls(there, observations, np.zeros(count), np.full(count, np.inf), np.zeros((count, 2)))


def _worlds(slots: Ints) -> Ints:
    return np.unique(slots[:, 0])
