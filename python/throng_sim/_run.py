"""Runs: what a world did."""

from __future__ import annotations

import html
import os
from collections.abc import Generator
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from . import _throng
from ._summary import Summary
from ._trajectories import Trajectories

if TYPE_CHECKING:
    from ._scene import Scene
    from ._world import World

_ALL = 2**63
"""More steps than any run has."""


class Run:
    """What a world did, recorded at a fixed rate. A notebook shows it as a player.

    It has the Arrow C stream interface, without a copy: `pyarrow.table(run)`, `polars.DataFrame(run)`,
    `pandas.DataFrame.from_arrow(run)` (pandas 3), and DuckDB reads the table of pyarrow. Columns: `time`, `id`, `group`,
    `x`, `y`, `z`, `vx`, `vy`, `vz`, `heading`, `radius`, `status`.

    >>> import throng_sim as tg
    >>> run = tg.Scene("headon").run(record=5)
    >>> run.summary.arrived, run.expectations.passed
    (2, True)
    """

    def __init__(self, recording: _throng.Recording, world: World) -> None:
        self._recording, self.scene, self.world = recording, world._scene, world
        self.summary: Summary = world.summary
        """Statistics of the run."""
        self.expectations: Summary = world.expectations
        """Whether the run met the scene's `[expect]`."""
        self.hash: int = world.hash()
        """A hash of the last state."""

    @classmethod
    def of(cls, world: World, *, record: float = 10.0, until: float | None = None) -> Run:
        """Runs a world until its scene is over, or until `until` seconds; records `record` frames a second."""
        steps = cls.gradually(world, record=record, until=until, steps=_ALL)
        while True:
            try:
                next(steps)
            except StopIteration as end:
                run: Run = end.value
                return run

    @classmethod
    def gradually(
        cls, world: World, *, record: float = 10.0, until: float | None = None, steps: int = 25
    ) -> Generator[float, None, Run]:
        """Runs a world as `of` does, but yields its time at least every `steps` steps. The generator returns the run.

        >>> import throng_sim as tg
        >>> len(list(tg.Run.gradually(tg.Scene("headon").build(), until=2.0, steps=10)))
        5
        """
        recording = _throng.Recording(world._world, record)
        while not world._world.is_at_end(until):
            if world.behavior is not None:
                world._obey()
            recording.go_on(world._world, until, 1 if world.behavior is not None else steps)
            yield world.time
        return cls(recording, world)

    @property
    def times(self) -> npt.NDArray[np.float64]:
        """The times of the frames, seconds."""
        return np.array(self._recording.times())

    @property
    def group_names(self) -> list[str]:
        """The names of the groups."""
        return self._recording.group_names

    @property
    def bounds(self) -> npt.NDArray[np.float64]:
        """Lower left and upper right corner of the scene, metres: (2, 2)."""
        return np.array(self._recording.bounds)

    def __len__(self) -> int:
        return len(self._recording)

    def __arrow_c_stream__(self, requested_schema: object = None) -> object:
        return self._recording.__arrow_c_stream__(requested_schema)

    def table(self) -> Any:
        """Returns all rows as a table of pyarrow."""
        try:
            import pyarrow
        except ImportError:
            raise ImportError("a table needs pyarrow: pip install pyarrow") from None
        return pyarrow.table(self)

    def arrays(self) -> dict[str, npt.NDArray[Any]]:
        """Returns the columns as NumPy arrays; `group` and `status` are texts."""
        table = self.table()
        return {name: table.column(name).to_numpy() for name in table.column_names}

    def trajectories(self) -> Trajectories:
        """Returns what the agents did: their states, and the poses of people, at any time."""
        return Trajectories(self._recording.trajectories())

    def save(
        self,
        *paths: str | os.PathLike[str],
        rate: float = 25.0,
        speed_up: float = 1.0,
        size: tuple[int, int] | None = None,
        moment: float | None = None,
    ) -> None:
        """Writes files; the ending of a name says what: .csv, .parquet, .rec, .sqlite, .usda, .glb, .bvh, .txt, .mp4, .gif,
        .png, .svg and all others that `throng run` writes.

        `rate` is pictures a second of video, `speed_up` seconds of the world a second of video, `size` width and height
        in pixels, `moment` the time that single pictures show. Record with the same rate for a smooth video.
        """
        self._recording.save([Path(path) for path in paths], rate, speed_up, size, moment)

    def html(self) -> str:
        """Returns a web page that plays the run: one file, without a network."""
        return self._recording.player()

    def _repr_html_(self) -> str:
        (left, bottom), (right, top) = self.bounds
        height = round(min(max(290 + 760 * (top - bottom) / max(right - left, 1e-9), 440), 1000))
        page = html.escape(self.html(), quote=True)
        return f'<iframe srcdoc="{page}" style="width: 100%; height: {height}px; border: 0"></iframe>'

    def widget(self) -> Any:
        """Returns a widget (anywidget) that plays the world on, live: it goes on from where the run ended."""
        from ._widget import widget

        return widget(self.world)

    def __repr__(self) -> str:
        passed = {True: "passed", False: "failed"}[self.expectations.passed] if self.expectations.checks else "none"
        summary = self.summary
        return f"<Run: {summary.arrived} of {summary.agents} arrived in {summary.time:.2f} s, expectations: {passed}>"
