"""Several agents of one world as an environment of PettingZoo."""

from __future__ import annotations

from typing import Any, Unpack

import gymnasium
import numpy as np
import numpy.typing as npt
from gymnasium.error import ResetNeeded
from gymnasium.utils import seeding

from .._scene import Scene
from .._world import World
from . import _draw, _seeds
from ._batch import Batch, Options
from ._control import Control
from ._state import Ints

try:
    from pettingzoo import ParallelEnv
except ImportError:
    raise ImportError("environments with several agents need PettingZoo: pip install 'throng-sim[env]'") from None

Row = npt.NDArray[np.float32]


class CrowdParallelEnv(ParallelEnv[str, Row, Any]):  # type: ignore[misc]
    """Several agents of a scene; `parallel` makes it.

    The name of an agent is that of its group and its number, `left_3`. An agent that arrives is terminated: it then
    decides itself again, or has left the scene. So is an agent that the program removes from `world`. When the time is
    up, all agents are truncated.
    """

    def __init__(
        self, scene: Scene | str, control: Control, *, render_mode: str | None = None, **options: Unpack[Options]
    ) -> None:
        self._batch = Batch(scene, control, 1, **options)
        self.metadata = {
            "name": "throng_crowd_v0",
            "render_modes": ["rgb_array"],
            "render_fps": 1.0 / self._batch.seconds,
            "is_parallelizable": True,
        }
        self.render_mode = _draw.checked_mode(render_mode)
        self.possible_agents: list[str] = list(self._batch.names)
        self.agents: list[str] = []
        self.observation_spaces = {name: self._batch.observation_space() for name in self.possible_agents}
        self.action_spaces = {name: self._batch.action_space() for name in self.possible_agents}
        self._generator: np.random.Generator | None = None

    def observation_space(self, agent: str) -> gymnasium.spaces.Space[Any]:
        """Returns the space of the observations of an agent."""
        return self.observation_spaces[agent]

    def action_space(self, agent: str) -> gymnasium.spaces.Space[Any]:
        """Returns the space of the actions of an agent."""
        return self.action_spaces[agent]

    @property
    def world(self) -> World:
        """The world of the episode."""
        return self._batch.world(0)

    def reset(
        self, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[dict[str, Row], dict[str, dict[str, Any]]]:
        """Begins an episode. With a seed, the world is that of `scene.build(seed=seed)`."""
        if seed is None and self._generator is None:
            seed = self._batch.first_seed
        if seed is not None:
            self._generator = seeding.np_random(seed)[0]
        assert self._generator is not None
        self._batch.reset(0, _seeds.episode(seed, self._generator))
        slots = np.argwhere(self._batch.live)
        self.agents = self._names(slots)
        observations, infos = self._batch.observe(slots)
        return dict(zip(self.agents, observations, strict=True)), _infos(self.agents, infos)

    def step(
        self, actions: dict[str, Any]
    ) -> tuple[dict[str, Row], dict[str, float], dict[str, bool], dict[str, bool], dict[str, dict[str, Any]]]:
        """Does an action of each agent of `agents`."""
        if not self.agents:
            raise ResetNeeded("the episode is over or has not begun: call `reset` first")
        if set(actions) != set(self.agents):
            self._refuse(actions)
        names = self.agents
        for name in names:
            if np.shape(actions[name]) != self.action_spaces[name].shape:
                shape, wanted = np.shape(actions[name]), self.action_spaces[name].shape
                raise ValueError(f"the action of `{name}` has the shape {shape}, but must have {wanted}")
        made = self._batch.step([actions[name] for name in names])
        self.agents = self._names(np.argwhere(self._batch.live))
        return (
            dict(zip(names, made.observations, strict=True)),
            dict(zip(names, made.rewards.tolist(), strict=True)),
            dict(zip(names, made.arrived.tolist(), strict=True)),
            dict(zip(names, made.late.tolist(), strict=True)),
            _infos(names, made.infos),
        )

    def render(self) -> Any:
        """Returns a picture, (480, 640, 3), if the render mode is `rgb_array`."""
        return _draw.frame(self.world, self._batch.ids) if self.render_mode else None

    def close(self) -> None:
        """Forgets the world."""
        self._batch.close()
        self.agents = []

    def _names(self, slots: Ints) -> list[str]:
        return [self.possible_agents[place] for place in slots[:, 1]]

    def _refuse(self, actions: dict[str, Any]) -> None:
        missing = [name for name in self.agents if name not in actions]
        if missing:
            raise ValueError(f"there is no action for `{missing[0]}`: give one for each of `agents`")
        extra = next(name for name in actions if name not in self.agents)
        if extra in self.possible_agents:
            raise ValueError(f"there is an action for `{extra}`, but its episode is over: give none for it")
        raise ValueError(f"there is no agent `{extra}`; `agents` has those under control")


def _infos(names: list[str], infos: dict[str, Any]) -> dict[str, dict[str, Any]]:
    columns = {key: values.tolist() for key, values in infos.items()}
    return {name: {key: column[row] for key, column in columns.items()} for row, name in enumerate(names)}
