"""Which agents are under control."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
import numpy.typing as npt

from .._world import World

Control = str | int | float | Iterable[int]
"""The name of a group, a number or numbers of agents, or a fraction of all agents from 0 to 1."""


def chosen(world: World, control: Control, seed: int) -> npt.NDArray[np.uint32]:
    """Returns the numbers of the agents under control, rising. The seed draws a fraction."""
    if len(world) == 0:
        raise ValueError("the scene has no agents at its start: control needs some")
    match control:
        case str():
            return _group(world, control)
        case bool():
            raise TypeError("control is a bool; give the name of a group, numbers of agents, or a fraction")
        case float() | np.floating():
            return _fraction(world, float(control), seed)
        case int() | np.integer():
            return _numbers(world, [int(control)])
    return _numbers(world, [int(number) for number in control])


def one(control: object) -> int:
    """Returns the number of the one agent under control."""
    if isinstance(control, bool) or not isinstance(control, int | np.integer):
        raise TypeError(f"control is {control!r}, but must be the number of one agent; `parallel` takes more")
    return int(control)


def _group(world: World, name: str) -> npt.NDArray[np.uint32]:
    names = world.group_names
    if name not in names:
        raise ValueError(f"there is no group `{name}`; there are: {', '.join(names)}")
    found = np.array(world.ids[world.groups == names.index(name)])
    if len(found) == 0:
        raise ValueError(f"the group `{name}` has no agents at the start; control another")
    return found


def _fraction(world: World, part: float, seed: int) -> npt.NDArray[np.uint32]:
    if not 0 < part <= 1:
        raise ValueError(f"control is {part}, but a fraction is more than 0 and at most 1")
    count = max(1, round(part * len(world)))
    return np.sort(np.random.default_rng(seed).choice(world.ids, count, replace=False))


def _numbers(world: World, numbers: list[int]) -> npt.NDArray[np.uint32]:
    if not numbers:
        raise ValueError("control has no numbers; give at least one agent")
    if len(set(numbers)) < len(numbers):
        raise ValueError("control has a number twice; give each agent once")
    missing = sorted(set(numbers) - set(world.ids.tolist()))
    if missing:
        raise ValueError(f"there is no agent {missing[0]} at the start; `scene.build().ids` has the numbers")
    return np.sort(np.array(numbers, dtype=np.uint32))
