"""Trajectories: where agents are at any time, and the poses of people."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import numpy.typing as npt

from . import _throng


class Trajectories:
    """What agents did, of a file or of a run: their states, and the poses of people, at any time.

    `Trajectories.read` reads all files of trajectories that `throng info` lists; `Run.trajectories` returns those of a
    run. Arrays have a row for each agent, in the order of `ids`.

    >>> import throng_sim as tg
    >>> trajectories = tg.Scene("headon").run(record=5).trajectories()
    >>> positions, headings = trajectories.states([0.0, 1.0])
    >>> positions.shape, headings.shape
    ((2, 2, 3), (2, 2))
    >>> hips, rotations = trajectories.poses([0.0, 0.5, 1.0])
    >>> hips.shape, rotations.shape
    ((2, 3, 3), (2, 3, 19, 4))
    """

    def __init__(self, native: _throng.Trajectories) -> None:
        self._native = native
        self.title: str = native.title
        """The title of the scene; empty if the file has none."""
        self.notes: list[str] = native.notes
        """What the reader found or changed, a sentence each."""
        self.times: npt.NDArray[np.float64] = native.times()
        """The times of the samples, seconds."""
        self.ids: npt.NDArray[np.uint32] = native.ids()
        """The numbers of the agents."""
        self.groups: npt.NDArray[np.uint32] = native.groups()
        """The groups of the agents: indices into `group_names`."""
        self.group_names: list[str] = native.group_names
        """The names of the groups."""
        self.radii: npt.NDArray[np.float32] = native.radii()
        """The radii of the agents, metres."""
        self.spans: npt.NDArray[np.float64] = native.spans()
        """The times of the first and the last sample of each agent, seconds: (n, 2)."""
        self.in_space: bool = native.in_space
        """Whether agents fly."""
        self.builds: list[str | None] = native.builds()
        """`"woman"`, `"man"` or `"child"`; `None` for agents that are not people: in space, or wider than 1 m."""
        self.heights: npt.NDArray[np.float64] = native.heights()
        """The heights of people, metres; NaN for other agents."""
        self.looks: npt.NDArray[np.uint8] = native.looks()
        """The numbers of the looks of people, 0 to 15: `throng_sim.figure.colors` has their colours."""

    @classmethod
    def read(
        cls, path: str | os.PathLike[str], *, frame_rate: float | None = None, unit: float | None = None
    ) -> Trajectories:
        """Reads a file. `frame_rate` (frames a second) and `unit` (metres) are for files that do not state them.

        Raises `ValueError` if the file cannot be read, is damaged, or has no agents.
        """
        return cls(_throng.Trajectories.read(Path(path), frame_rate, unit))

    def __len__(self) -> int:
        return len(self._native)

    @property
    def walkable(self) -> list[list[npt.NDArray[np.float64]]]:
        """The walkable areas: corners of each, then of its holes, metres. Empty: everywhere outside obstacles."""
        return [[np.array(ring) for ring in area] for area in self._native.walkable()]

    @property
    def obstacles(self) -> list[tuple[npt.NDArray[np.float64], bool]]:
        """The obstacles: corners, metres, and whether they are closed polygons; thin walls are not."""
        return [(np.array(corners), closed) for corners, closed in self._native.obstacles()]

    def states(
        self,
        times: Sequence[float] | npt.NDArray[np.float64],
        *,
        ids: Sequence[int] | npt.NDArray[np.integer] | None = None,
    ) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]:
        """Returns positions, (n, t, 3), metres, and headings, (n, t), radians, at times (seconds).

        `ids` are the numbers of the agents, in the order of the rows (all agents). NaN before the first and after the
        last sample of an agent. Between samples positions are on a line.

        Raises `ValueError` if a number is not that of an agent.
        """
        return self._native.states([int(number) for number in (self.ids if ids is None else ids)], list(times))

    def poses(
        self,
        times: Sequence[float] | npt.NDArray[np.float64],
        *,
        ids: Sequence[int] | npt.NDArray[np.integer] | None = None,
        world: bool = False,
    ) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float32]]:
        """Returns the poses of people at times (seconds); `ids` are their numbers, in the order of the rows (all people).

        Positions of the hips, (n, t, 3), metres, and rotations of the joints of `throng_sim.figure`, (n, t, 19, 4), as
        quaternions w, x, y, z: of the hips in the world, of the other joints against their parents. With `world`, the
        positions, (n, t, 19, 3), and the rotations of all joints in the world. NaN while a person is not there.

        The walk of a person is planned once, when its poses are first needed.

        Raises `ValueError` if a number is not that of a person.
        """
        if ids is None:
            ids = self.people
        return self._native.poses([int(number) for number in ids], list(times), world)

    @property
    def people(self) -> npt.NDArray[np.uint32]:
        """The numbers of the agents that are people."""
        return self.ids[[build is not None for build in self.builds]]

    def __repr__(self) -> str:
        span = f", {self.times[0]:.2f} to {self.times[-1]:.2f} s" if len(self) else ""
        return f"<Trajectories: {len(self)} agents{span}>"
