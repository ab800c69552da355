"""A crowd on the frames of a scene."""

from dataclasses import dataclass

import numpy as np
import throng_sim as tg

SLACK = 1e-6
"""Times nearer than this are equal, seconds."""
FAR = 1000.0
"""The origin of the crowd is a multiple of this, metres: coordinates near it are accurate in single precision."""


@dataclass(frozen=True)
class Clip:
    """Trajectories, and the frames on which they are shown."""

    trajectories: tg.Trajectories
    fps: float
    """Frames a second."""
    start: int
    """The frame of the first moment."""

    @property
    def end(self) -> int:
        """The last frame."""
        first, last = self.trajectories.times[[0, -1]]
        return self.start + max(int((last - first) * self.fps + SLACK), 0)

    @property
    def frames(self) -> np.ndarray:
        """All frames."""
        return np.arange(self.start, self.end + 1)

    def times(self, frames: np.ndarray) -> np.ndarray:
        """Returns the times of frames, seconds."""
        return self.trajectories.times[0] + (frames - self.start) / self.fps

    def spans(self) -> np.ndarray:
        """The frames between which each agent is there, with fractions: (n, 2)."""
        return self.start + (self.trajectories.spans - self.trajectories.times[0]) * self.fps

    def present(self, row: int) -> np.ndarray:
        """Returns the frames at which an agent is there."""
        first, last = self.spans()[row]
        slack = SLACK * self.fps
        return np.arange(max(int(np.ceil(first - slack)), self.start), min(int(np.floor(last + slack)), self.end) + 1)

    def times_within(self, row: int, frames: np.ndarray) -> np.ndarray:
        """Returns the times of frames, within the time in which an agent is there."""
        return np.clip(self.times(frames), *self.trajectories.spans[row])

    def origin(self) -> np.ndarray:
        """The point of the world to which objects are relative: x, y, 0, metres."""
        moments = self.trajectories.times[:: max(1, len(self.trajectories.times) // 8)]
        positions, _ = self.trajectories.states(moments)
        middle = np.nanmedian(positions.reshape(-1, 3), axis=0)
        return np.round(middle / FAR) * FAR * [1, 1, 0]

    def rows(self, people: bool) -> list[int]:
        """Returns the rows of the agents that are people, or of the others."""
        return [row for row, build in enumerate(self.trajectories.builds) if (build is not None) == people]


def of(trajectories: tg.Trajectories, scene) -> Clip:
    """Returns the clip of trajectories in a scene of Blender."""
    return Clip(trajectories, scene.render.fps / scene.render.fps_base, scene.throng.start)
