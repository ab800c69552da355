"""What an agent observes."""

from __future__ import annotations

import functools
import re
from dataclasses import dataclass

import gymnasium
import numpy as np
import numpy.typing as npt

from . import _walls
from ._frame import inwards, outwards
from ._state import Bools, Floats, Ints, State

PER_NEIGHBOUR = 5
"""Numbers for each neighbour."""


@dataclass(frozen=True)
class Observation:
    """An observation: a row of float32 for each agent, in its own frame (+x ahead, +y to its left), metres and m/s.

    - 0 and 1: its velocity;
    - 2 and 3: the offset to its goal, no longer than `sight`; 0 for agents without a goal;
    - 5 for each of the `neighbours`, nearest first: offset of the centre, velocity relative to the agent, and the sum
      of both radii; 0 where there is no neighbour within `sight`;
    - 1 for each of the `rays`, counter-clockwise from straight ahead: the distance from the body to the first wall, at
      most `sight`.

    >>> Observation.parse("nearest-10+walls-8", sight=20.0, fastest=4.0).size
    62
    """

    neighbours: int
    rays: int
    sight: float
    """How far an agent sees, metres."""
    fastest: float
    """Bound of all velocities, m/s."""

    @classmethod
    def parse(cls, text: str, *, sight: float, fastest: float) -> Observation:
        """Reads `nearest-K`, `walls-R`, or both with a plus between them."""
        if not (np.isfinite(sight) and sight > 0):
            raise ValueError(f"sight is {sight}, but must be more than 0 m, and finite")
        counts = {"nearest": 0, "walls": 0}
        for part in text.split("+"):
            found = re.fullmatch(r"\s*(nearest|walls)-(\d+)\s*", part)
            if not found:
                raise ValueError(f"observe is {text!r}; give `nearest-10`, `walls-8`, or `nearest-10+walls-8`")
            counts[found[1]] = int(found[2])
        return cls(counts["nearest"], counts["walls"], float(sight), float(fastest))

    @property
    def size(self) -> int:
        """The length of a row."""
        return 4 + PER_NEIGHBOUR * self.neighbours + self.rays

    def space(self) -> gymnasium.spaces.Box:
        """Returns the space of one row."""
        fast, far = self.fastest, self.sight
        high = [fast, fast, far, far] + [far, far, 2 * fast, 2 * fast, far] * self.neighbours + [far] * self.rays
        low = [-fast, -fast, -far, -far] + [-far, -far, -2 * fast, -2 * fast, 0.0] * self.neighbours + [0.0] * self.rays
        return gymnasium.spaces.Box(np.array(low, np.float32), np.array(high, np.float32))

    def write(self, state: State, rows: Ints, near: tuple[Ints, Bools], out: npt.NDArray[np.float32]) -> None:
        """Writes the observations of some agents, given their rows and their neighbours, into `out`: (a, size)."""
        headings, at = state.headings[rows], state.positions[rows]
        out[:, 0:2] = inwards(state.velocities[rows], headings)
        to_goal = np.nan_to_num(state.targets[rows] - at)
        distance = np.linalg.norm(to_goal, axis=1, keepdims=True)
        out[:, 2:4] = inwards(to_goal * np.minimum(1.0, self.sight / np.maximum(distance, 1e-9)), headings)
        others, exist = near
        end = 4 + PER_NEIGHBOUR * self.neighbours
        seen = np.empty((len(rows), self.neighbours, PER_NEIGHBOUR))
        seen[..., 0:2] = inwards(state.positions[others] - at[:, None], headings)
        seen[..., 2:4] = inwards(state.velocities[others] - state.velocities[rows][:, None], headings)
        seen[..., 4] = state.radii[others] + state.radii[rows][:, None]
        seen[~exist] = 0.0
        out[:, 4:end] = seen.reshape(len(rows), end - 4)
        if self.rays:
            out[:, end:] = self._to_walls(state, rows, headings)
        np.clip(out, *self._bounds, out=out)

    @functools.cached_property
    def _bounds(self) -> tuple[Floats, Floats]:
        space = self.space()
        return space.low.astype(np.float64), space.high.astype(np.float64)

    def _to_walls(self, state: State, rows: Ints, headings: Floats) -> Floats:
        angles = np.linspace(0, 2 * np.pi, self.rays, endpoint=False)
        ahead = np.broadcast_to(np.stack([np.cos(angles), np.sin(angles)], axis=1), (len(rows), self.rays, 2))
        rays, at = outwards(ahead, headings), state.positions[rows]
        found = _walls.distances(at, rays, state.walls, state.owners(rows), self.sight)
        return np.maximum(found - state.radii[rows][:, None], 0.0)
