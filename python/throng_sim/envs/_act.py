"""What an agent does: actions as velocities."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Protocol

import gymnasium
import numpy as np
import numpy.typing as npt

from ._frame import outwards
from ._state import Floats

SHARPEST = np.pi / 2
"""The turn that stands for 1, radians."""
DIRECTIONS = 8
"""Directions of discrete actions."""
SPEEDS = (0.5, 1.0)
"""Speeds of discrete actions, as parts of the top speed."""


class ActionKind(Protocol):
    """A kind of actions."""

    def space(self) -> gymnasium.Space[Any]:
        """Returns the space of one action."""

    def velocities(self, actions: npt.NDArray[Any]) -> Floats:
        """Returns actions as velocities in the frames of the agents, as parts of their top speeds: (a, 2)."""


class Velocity:
    """Two numbers from -1 to 1: the velocity ahead and to the left, as parts of the top speed."""

    def space(self) -> gymnasium.Space[Any]:
        return gymnasium.spaces.Box(-1.0, 1.0, (2,), np.float32)

    def velocities(self, actions: npt.NDArray[Any]) -> Floats:
        return np.asarray(np.clip(actions, -1.0, 1.0), dtype=np.float64)


class SpeedTurn:
    """Two numbers: the speed from 0 to 1 as a part of the top speed, and the turn of the direction from that of the
    body, from -1, 90 degrees to the right, to 1, 90 degrees to the left.
    """

    def space(self) -> gymnasium.Space[Any]:
        return gymnasium.spaces.Box(np.array([0.0, -1.0], np.float32), np.array([1.0, 1.0], np.float32))

    def velocities(self, actions: npt.NDArray[Any]) -> Floats:
        speed, turn = np.clip(actions[:, 0], 0.0, 1.0), SHARPEST * np.clip(actions[:, 1], -1.0, 1.0)
        return np.stack([speed * np.cos(turn), speed * np.sin(turn)], axis=1)


class Discrete:
    """A number: 0 stands; 1 to 8 walk at half, 9 to 16 at the whole top speed, in steps of 45 degrees counter-clockwise
    from straight ahead.
    """

    def space(self) -> gymnasium.Space[Any]:
        return gymnasium.spaces.Discrete(1 + DIRECTIONS * len(SPEEDS))

    def velocities(self, actions: npt.NDArray[Any]) -> Floats:
        angles = 2 * np.pi * np.arange(DIRECTIONS) / DIRECTIONS
        around = np.stack([np.cos(angles), np.sin(angles)], axis=1)
        choices = np.concatenate([np.zeros((1, 2)), *(speed * around for speed in SPEEDS)])
        return choices.take(actions, axis=0)


KINDS: dict[str, ActionKind] = {"velocity": Velocity(), "speed-turn": SpeedTurn(), "discrete": Discrete()}


def action_kind(name: str) -> ActionKind:
    """Returns a kind of actions by its name."""
    if name not in KINDS:
        raise ValueError(f"action is {name!r}; there are: {', '.join(KINDS)}")
    return KINDS[name]


def checked(space: gymnasium.Space[Any], given: Any, count: int, name: Callable[[int], str]) -> npt.NDArray[Any]:
    """Returns the actions of `count` agents as one array. Errors name the agent of a row.

    Numbers beyond the limits of a box are not an error: they are cut off.
    """
    shape = (count, *(space.shape or ()))
    try:
        actions = np.asarray(given)
        numbers = actions.astype(np.float64)
    except (TypeError, ValueError):
        raise ValueError(f"the actions are not numbers in an array of the shape {shape}: {given!r}") from None
    if actions.shape != shape:
        raise ValueError(f"the actions have the shape {actions.shape}, but must have {shape}: a row for each agent")
    if not np.isfinite(numbers).all():
        row = int(np.argwhere(~np.isfinite(numbers))[0][0])
        raise ValueError(f"the action {actions[row].tolist()} of {name(row)} is not finite: check what chooses it")
    if not isinstance(space, gymnasium.spaces.Discrete):
        return numbers
    choices = numbers.astype(np.int64)
    wrong = (choices != numbers) | (choices < 0) | (choices >= space.n)
    if wrong.any():
        row = int(wrong.argmax())
        raise ValueError(f"the action {actions[row]} of {name(row)} must be an integer from 0 to {space.n - 1}")
    return choices


def preferred(kind: ActionKind, actions: npt.NDArray[Any], headings: Floats, max_speeds: Floats) -> Floats:
    """Returns actions as velocities in the world, m/s: (a, 2). The engine limits them to the top speeds."""
    return outwards(kind.velocities(actions), headings) * max_speeds[:, None]
