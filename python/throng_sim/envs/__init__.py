"""Environments for reinforcement learning: some agents of a scene are under control.

`single` and `vector` are for Gymnasium, `parallel` is for PettingZoo. The scene moves all agents that are not under
control. An action is a velocity that the agent prefers. Its local model and the guard come after it, so agents never
overlap, whatever the actions are. With the local model `none` only the guard does, and the policy has to avoid other
agents. An agent that looks ahead takes half a second to reach a velocity; without `look_ahead` only its acceleration
limits it.

>>> import throng_sim as tg
>>> env = tg.envs.parallel("crossing", control="eastward", observe="nearest-4")
>>> observations, infos = env.reset(seed=1)
>>> len(env.agents), observations[env.agents[0]].shape
(60, (24,))
>>> straight = {agent: observations[agent][2:4] / 10 for agent in env.agents}
>>> observations, rewards, terminations, truncations, infos = env.step(straight)

Keyword arguments of all environments are those of `Options`.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Unpack

try:
    import gymnasium
except ImportError:
    raise ImportError("environments need Gymnasium: pip install 'throng-sim[env]'") from None

from .._scene import Scene
from ._act import Discrete, SpeedTurn, Velocity
from ._batch import Options
from ._control import Control
from ._observe import Observation
from ._reward import Reward, RewardFunction, Transition
from ._single import CrowdEnv
from ._vector import CrowdVectorEnv

if TYPE_CHECKING:
    from ._parallel import CrowdParallelEnv

__all__ = [
    "Control",
    "CrowdEnv",
    "CrowdVectorEnv",
    "Discrete",
    "Observation",
    "Options",
    "Reward",
    "RewardFunction",
    "SpeedTurn",
    "Transition",
    "Velocity",
    "parallel",
    "single",
    "vector",
]


def parallel(
    scene: Scene | str, control: Control = 1.0, *, render_mode: str | None = None, **options: Unpack[Options]
) -> CrowdParallelEnv:
    """Returns an environment of PettingZoo: several agents of one world.

    `control` is the name of a group, numbers of agents, or a fraction of all agents.

    >>> env = parallel("headon", control="left", action="discrete", observe="nearest-1", limit=20.0)
    >>> observations, infos = env.reset(seed=1)
    >>> while env.agents:
    ...     made = env.step({agent: 9 for agent in env.agents})
    >>> made[2]
    {'left_0': True}
    """
    from ._parallel import CrowdParallelEnv

    return CrowdParallelEnv(scene, control, render_mode=render_mode, **options)


def single(
    scene: Scene | str, control: int = 0, *, render_mode: str | None = None, **options: Unpack[Options]
) -> CrowdEnv:
    """Returns an environment of Gymnasium: the agent with the number `control`.

    >>> env = single("crossing", control=3)
    >>> observation, info = env.reset(seed=1)
    >>> observation, reward, terminated, truncated, info = env.step([1.0, 0.0])
    >>> round(info["time"], 2)
    0.2
    """
    return CrowdEnv(scene, control, render_mode=render_mode, **options)


def vector(
    scene: Scene | str,
    num_envs: int = 64,
    control: int = 0,
    *,
    copy: bool = True,
    render_mode: str | None = None,
    **options: Unpack[Options],
) -> CrowdVectorEnv:
    """Returns a vector environment of Gymnasium: the agent with the number `control` in each of `num_envs` worlds.

    `threads` worlds make their steps at the same time. Without `copy`, all steps return the same array of observations,
    with new numbers.

    >>> envs = vector("crossing", num_envs=3, threads=2)
    >>> observations, infos = envs.reset(seed=1)
    >>> observations.shape
    (3, 54)
    """
    return CrowdVectorEnv(scene, num_envs, control, copy=copy, render_mode=render_mode, **options)


gymnasium.register(
    id="throng/Crowd-v0", entry_point="throng_sim.envs:single", vector_entry_point="throng_sim.envs:vector"
)
