"""One agent as an environment of Gymnasium."""

from __future__ import annotations

from typing import Any, Unpack

import gymnasium
import numpy as np
import numpy.typing as npt
from gymnasium.error import ResetNeeded

from .._scene import Scene
from .._world import World
from . import _draw, _seeds
from ._batch import Batch, Options
from ._control import one

SLOT = np.zeros((1, 2), dtype=np.int64)


class CrowdEnv(gymnasium.Env[Any, Any]):
    """One agent of a scene; `single` makes it."""

    def __init__(
        self, scene: Scene | str, control: int = 0, *, render_mode: str | None = None, **options: Unpack[Options]
    ) -> None:
        self._batch = Batch(scene, one(control), 1, **options)
        self.metadata = {"render_modes": ["rgb_array"], "render_fps": 1.0 / self._batch.seconds}
        self.render_mode = _draw.checked_mode(render_mode)
        self.observation_space = self._batch.observation_space()
        self.action_space = self._batch.action_space()

    @property
    def world(self) -> World:
        """The world of the episode."""
        return self._batch.world(0)

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[npt.NDArray[np.float32], dict[str, Any]]:
        """Begins an episode. With a seed, the world is that of `scene.build(seed=seed)`."""
        if seed is None and self._np_random is None:
            seed = self._batch.first_seed
        super().reset(seed=seed)
        self._batch.reset(0, _seeds.episode(seed, self.np_random))
        observations, infos = self._batch.observe(SLOT)
        return observations[0], _first(infos)

    def step(self, action: Any) -> tuple[npt.NDArray[np.float32], float, bool, bool, dict[str, Any]]:
        """Does an action."""
        if not self._batch.live[0, 0]:
            raise ResetNeeded("the episode is over or has not begun: call `reset` first")
        made = self._batch.step([action])
        reward, arrived, late = float(made.rewards[0]), bool(made.arrived[0]), bool(made.late[0])
        return made.observations[0], reward, arrived, late, _first(made.infos)

    def render(self) -> Any:
        """Returns a picture, (480, 640, 3), if the render mode is `rgb_array`."""
        return _draw.frame(self.world, self._batch.ids) if self.render_mode else None

    def close(self) -> None:
        """Forgets the world."""
        self._batch.close()


def _first(infos: dict[str, Any]) -> dict[str, Any]:
    return {name: float(values[0]) for name, values in infos.items()}
