"""Many worlds as one environment of Gymnasium."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Unpack

import numpy as np
import numpy.typing as npt
from gymnasium.error import ResetNeeded
from gymnasium.utils import seeding
from gymnasium.vector import AutoresetMode, VectorEnv
from gymnasium.vector.utils import batch_space

from .._scene import Scene
from .._world import World
from . import _act, _draw, _seeds
from ._batch import Batch, Options
from ._control import one
from ._state import Bools, Floats, Ints

Observations = npt.NDArray[np.float32]


class CrowdVectorEnv(VectorEnv[Observations, Any, npt.NDArray[Any]]):
    """One agent in each of many worlds of a scene; `vector` makes it.

    It gives the same numbers as `gymnasium.vector.SyncVectorEnv` with environments of `single`. The step after the end
    of an episode resets the world: it ignores the action, and its reward is 0 (`AutoresetMode.NEXT_STEP`).
    """

    def __init__(
        self,
        scene: Scene | str,
        num_envs: int = 64,
        control: int = 0,
        *,
        copy: bool = True,
        render_mode: str | None = None,
        **options: Unpack[Options],
    ) -> None:
        if num_envs < 1:
            raise ValueError(f"num_envs is {num_envs}, but must be at least 1")
        self._batch = Batch(scene, one(control), num_envs, **options)
        self.metadata = {
            "render_modes": ["rgb_array"],
            "render_fps": 1.0 / self._batch.seconds,
            "autoreset_mode": AutoresetMode.NEXT_STEP,
        }
        self.render_mode = _draw.checked_mode(render_mode)
        self.num_envs = num_envs
        self.single_observation_space = self._batch.observation_space()
        self.single_action_space = self._batch.action_space()
        self.observation_space = batch_space(self.single_observation_space, num_envs)
        self.action_space = batch_space(self.single_action_space, num_envs)
        self._copy = copy
        self._observations = np.zeros((num_envs, self._batch.observation.size), dtype=np.float32)
        self._generators: list[np.random.Generator] = []

    @property
    def worlds(self) -> list[World]:
        """The worlds of the episodes."""
        return [self._batch.worlds[index] for index in sorted(self._batch.worlds)]

    def reset(
        self, *, seed: int | Sequence[int | None] | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Observations, dict[str, Any]]:
        """Begins an episode in each world. World number k gets the seed `seed + k`, or the k-th of several seeds."""
        if seed is None and not self._generators:
            seed = self._batch.first_seed
        if not isinstance(seed, Sequence):
            seed = [None if seed is None else seed + index for index in range(self.num_envs)]
        if len(seed) != self.num_envs:
            raise ValueError(f"there are {len(seed)} seeds for {self.num_envs} worlds: give one for each")
        if not self._generators:
            self._generators = [seeding.np_random(given)[0] for given in seed]
        for index, given in enumerate(seed):
            if given is not None:
                self._generators[index] = seeding.np_random(given)[0]
            self._batch.reset(index, _seeds.episode(given, self._generators[index]))
        infos: dict[str, Any] = {}
        self._begin(np.arange(self.num_envs), infos)
        return self._shown(), infos

    def step(self, actions: Any) -> tuple[Observations, Floats, Bools, Bools, dict[str, Any]]:
        """Does an action in each world, a row for each; begins episodes where one has ended in the last step."""
        if not self._batch.worlds:
            raise ResetNeeded("there is no episode yet: call `reset` first")
        actions = _act.checked(self.single_action_space, actions, self.num_envs, "world {}".format)
        rewards, infos = np.zeros(self.num_envs), dict[str, Any]()
        arrived, late = np.zeros(self.num_envs, dtype=bool), np.zeros(self.num_envs, dtype=bool)
        alive = self._batch.live[:, 0].copy()
        if alive.any():
            made = self._batch.step(actions[alive])
            self._observations[alive] = made.observations
            rewards[alive], arrived[alive], late[alive] = made.rewards, made.arrived, made.late
            self._inform(infos, np.flatnonzero(alive), made.infos)
        ended = np.flatnonzero(~alive)
        for index in ended.tolist():
            self._batch.reset(index, _seeds.episode(None, self._generators[index]))
        if len(ended):
            self._begin(ended, infos)
        return self._shown(), rewards, arrived, late, infos

    def render(self) -> tuple[Any, ...] | None:
        """Returns a picture of each world, (480, 640, 3), if the render mode is `rgb_array`."""
        if not self.render_mode:
            return None
        return tuple(_draw.frame(world, self._batch.ids) for world in self.worlds)

    def close_extras(self, **kwargs: Any) -> None:
        """Forgets the worlds."""
        self._batch.close()

    def _begin(self, indices: Ints, infos: dict[str, Any]) -> None:
        """Observes worlds at the start of their episodes."""
        observations, seen = self._batch.observe(np.stack([indices, np.zeros_like(indices)], axis=1))
        self._observations[indices] = observations
        self._inform(infos, indices, seen)

    def _inform(self, infos: dict[str, Any], indices: Ints, seen: dict[str, Floats]) -> None:
        """Adds what is known of some worlds, and a mask that says of which."""
        for name, values in seen.items():
            infos.setdefault(name, np.zeros(self.num_envs))[indices] = values
            infos.setdefault(f"_{name}", np.zeros(self.num_envs, dtype=bool))[indices] = True

    def _shown(self) -> Observations:
        return self._observations.copy() if self._copy else self._observations
