"""The state of several worlds as one."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property

import numpy as np
import numpy.typing as npt

from .._world import World

Floats = npt.NDArray[np.float64]
Ints = npt.NDArray[np.int64]
Bools = npt.NDArray[np.bool_]


class State:
    """The agents of several worlds as they are now: those of the first, then those of the second, and so on.

    Arrays are read when they are first asked for, and are copies: make another `State` after a step.
    """

    def __init__(self, worlds: Sequence[World]) -> None:
        self.worlds = list(worlds)
        self.first: Ints = np.cumsum([0, *map(len, self.worlds)])
        """Where the agents of each world begin, and the end: (w + 1,)."""

    @cached_property
    def positions(self) -> Floats:
        """Centres, metres: (n, 2)."""
        return self._joined("positions")

    @cached_property
    def velocities(self) -> Floats:
        """Velocities, m/s: (n, 2)."""
        return self._joined("velocities")

    @cached_property
    def headings(self) -> Floats:
        """Directions of the bodies, radians counter-clockwise from +x: (n,)."""
        return self._joined("headings")

    @cached_property
    def radii(self) -> Floats:
        """Radii of the bodies, metres: (n,)."""
        return self._joined("radii")

    @cached_property
    def max_speeds(self) -> Floats:
        """Top speeds, m/s: (n,)."""
        return self._joined("max_speeds")

    @cached_property
    def targets(self) -> Floats:
        """The points to which agents go, of areas the nearest, metres: (n, 2). NaN: none."""
        return np.concatenate([world.targets() for world in self.worlds])

    @cached_property
    def walls(self) -> Floats:
        """Walls, x and y of both ends, metres: (w, m, 4). Worlds with fewer walls have some of no length."""
        each = [world.walls() for world in self.worlds]
        padded = np.zeros((len(each), max(map(len, each)), 4))
        for index, walls in enumerate(each):
            padded[index, : len(walls)] = walls
        return padded

    def owners(self, rows: Ints) -> Ints:
        """Returns the indices of the worlds of some agents."""
        return np.searchsorted(self.first, rows, side="right") - 1

    def _joined(self, name: str) -> Floats:
        return np.concatenate([getattr(world, name) for world in self.worlds], dtype=np.float64)

    @cached_property
    def _keys(self) -> npt.NDArray[np.uint64]:
        """A number for each agent, rising."""
        owners = np.repeat(np.arange(len(self.worlds), dtype=np.uint64), np.diff(self.first))
        return _keys(owners, np.concatenate([world.ids for world in self.worlds]))

    def rows(self, world: Ints, ids: npt.NDArray[np.uint32]) -> tuple[Ints, Bools]:
        """Returns the rows of agents, given by the indices of their worlds and their numbers, and which are present.

        The row of an agent that is not present is any row.
        """
        wanted = _keys(world.astype(np.uint64), ids)
        rows = np.minimum(np.searchsorted(self._keys, wanted), max(len(self._keys) - 1, 0))
        if len(self._keys) == 0:
            return rows, np.zeros(len(rows), dtype=bool)
        return rows, self._keys[rows] == wanted

    def near(self, rows: Ints, k: int, sight: float) -> tuple[Ints, Bools]:
        """Returns the rows of the `k` nearest agents within `sight` metres of some agents, nearest first: (a, k).

        The second array says which of them exist.
        """
        lists = [world.neighbors(k, sight) for world in self.worlds]
        pairs = np.cumsum([0, *(len(found.indices) for found in lists)])
        begin = np.concatenate([found.indptr[:-1] + at for found, at in zip(lists, pairs[:-1], strict=True)])
        count = np.concatenate([np.diff(found.indptr) for found in lists])
        others = np.concatenate([found.indices + at for found, at in zip(lists, self.first[:-1], strict=True)] + [[0]])
        exist = np.arange(k) < count[rows, None]
        return others[np.where(exist, begin[rows, None] + np.arange(k), len(others) - 1)], exist


def _keys(world: npt.NDArray[np.uint64], ids: npt.NDArray[np.uint32]) -> npt.NDArray[np.uint64]:
    return (world << np.uint64(32)) | ids.astype(np.uint64)
