"""What an agent is rewarded for."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ._state import Bools, Floats


@dataclass(frozen=True)
class Transition:
    """What an action led to: a row for each agent under control."""

    progress: Floats
    """By how much the goal is nearer than before, metres: (a,). 0 for agents without a goal."""
    distance: Floats
    """Distance to the goal, metres: (a,). 0 for agents that have arrived; NaN for agents without a goal."""
    gap: Floats
    """Distance between the bodies of the agent and of the nearest neighbour that it observes, metres: (a,). Infinite
    without neighbours."""
    velocity: Floats
    """Velocity in the world, m/s: (a, 2)."""
    arrived: Bools
    """Whether the agent has arrived: (a,)."""
    seconds: float
    """Duration of the action."""


@dataclass(frozen=True)
class Reward:
    """Rewards progress and arrival, and costs time and closeness.

    >>> still = Transition(
    ...     progress=np.array([0.3]), distance=np.array([4.0]), gap=np.array([0.05]), velocity=np.zeros((1, 2)),
    ...     arrived=np.array([False]), seconds=0.2,
    ... )
    >>> Reward(progress=1.0, time=0.5, closeness=1.0, comfort=0.1)(still).round(9).tolist()
    [0.1]
    """

    progress: float = 1.0
    """For each metre nearer to the goal."""
    time: float = 0.5
    """Cost of a second."""
    closeness: float = 0.5
    """Cost of a second at a gap of 0; it falls to nothing at `comfort`."""
    comfort: float = 0.2
    """The gap at which closeness begins to cost, metres."""
    arrival: float = 5.0
    """For arriving."""

    def __call__(self, now: Transition) -> Floats:
        close = np.clip(1.0 - now.gap / self.comfort, 0.0, 1.0)
        cost = (self.time + self.closeness * close) * now.seconds
        return self.progress * now.progress - cost + self.arrival * now.arrived


RewardFunction = Callable[[Transition], Floats]
"""Returns the rewards for a transition: (a,)."""


def checked(reward: RewardFunction, now: Transition) -> Floats:
    """Returns the rewards of a function, after a look at them."""
    rewards = np.asarray(reward(now), dtype=np.float64)
    if rewards.shape != now.arrived.shape:
        wanted = f"an array of the shape {now.arrived.shape}, a number for each agent"
        raise ValueError(f"the reward function returned the shape {rewards.shape}, but must return {wanted}")
    if not np.isfinite(rewards).all():
        raise ValueError("the reward function returned infinity or NaN: a `gap` can be infinite, a `distance` NaN")
    return rewards
