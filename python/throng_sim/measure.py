"""Measures of pedestrians on the ground: the functions of `throng measure`, with its definitions (docs/measures.md).

Areas are shapes of shapely, GeoJSON, WKT, or corners; lines are two points. All take a `Run`, whose rate of recording is
their resolution: record at least 10 frames a second.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _geometry, _throng
from ._run import Run

Array = npt.NDArray[np.float64]

INTERVAL = 0.8
"""Seconds over which displacements become velocities."""


@dataclass(frozen=True)
class Density:
    """Figures of an area at each time."""

    time: Array
    """Seconds."""
    density: Array
    """People in the area over its size, 1/m²."""
    speed: Array
    """Mean speed of those in the area, m/s; NaN if there is nobody."""
    voronoi_density: Array
    """Voronoi density (Steffen and Seyfried 2010), 1/m²."""
    voronoi_speed: Array
    """Voronoi speed, m/s."""


@dataclass(frozen=True)
class Flow:
    """Crossings of a line."""

    time: Array
    """Time at which each person crosses first, rising, seconds."""
    id: npt.NDArray[np.uint32]
    """Numbers of these people."""
    mean: float
    """Crossings after the first over the time from the first to the last, 1/s."""
    steady: float
    """The same without the first and the last of the crossings, 1/s."""

    @property
    def count(self) -> Array:
        """The number of people that have crossed at each time of `time`."""
        return np.arange(1.0, len(self.time) + 1)


@dataclass(frozen=True)
class Lanes:
    """Lane formation of people who walk in two directions."""

    time: Array
    """Seconds."""
    order: Array
    """Order parameter of Rex and Löwen at each time: 1 for lanes, about 0 for a mixture."""
    steady: float
    """Its mean over the middle half of the time in which both directions are present."""


@dataclass(frozen=True)
class Fundamental:
    """The fundamental diagram: density and speed of an area at each time at which somebody was in it."""

    density: Array
    """Voronoi density, 1/m²."""
    speed: Array
    """Voronoi speed, m/s, over the part of the area that is somebody's."""

    @property
    def flow(self) -> Array:
        """Specific flow, 1/(m s)."""
        return self.density * self.speed


def density(run: Run, area: Any, **options: Any) -> Density:
    """Returns densities and speeds in an area.

    Options of all measures: `group`, a name; `since` and `until`, seconds; `interval`, seconds over which displacements
    become velocities; `cut_off`, metres, the greatest extent of Voronoi cells.

    >>> import throng_sim as tg
    >>> run = tg.Scene("corridor").run(until=20)
    >>> found = tg.measure.density(run, [(10, 0), (20, 0), (20, 5), (10, 5)])
    >>> len(found.time) == len(run)
    True
    """
    figures = _figures(run, areas=[_corners(area)], **options)
    return Density(time=figures["time"], **figures["areas"][0])


def flow(run: Run, line: Any, **options: Any) -> Flow:
    """Returns the crossings of a line, `((x, y), (x, y))`, in either direction."""
    (ax, ay), (bx, by) = _line(line)
    found = _figures(run, lines=[((ax, ay), (bx, by))], **options)["lines"][0]
    return Flow(time=found["time"], id=found["id"], mean=found["flow"], steady=found["steady_flow"])


def lanes(run: Run, **options: Any) -> Lanes:
    """Returns the order of lanes."""
    figures = _figures(run, **options)
    return Lanes(figures["time"], figures["lane_order"], figures["steady_lane_order"])


def fundamental(run: Run, area: Any, **options: Any) -> Fundamental:
    """Returns the fundamental diagram of an area."""
    found = density(run, area, **options)
    known = (found.voronoi_density > 0) & np.isfinite(found.voronoi_speed)
    return Fundamental(found.voronoi_density[known], found.voronoi_speed[known])


def speeds(run: Run, **options: Any) -> tuple[Array, Array]:
    """Returns times, and the mean speed of all people at each, m/s."""
    figures = _figures(run, **options)
    return figures["time"], figures["speed"]


def _figures(
    run: Run,
    *,
    areas: list[list[tuple[float, float]]] | None = None,
    lines: list[tuple[tuple[float, float], tuple[float, float]]] | None = None,
    group: str | None = None,
    since: float = 0.0,
    until: float = np.inf,
    interval: float = INTERVAL,
    cut_off: float | None = None,
) -> dict[str, Any]:
    return _throng.figures(run._recording, (areas or [], lines or []), interval, cut_off, group, (since, until))


def _corners(area: Any) -> list[tuple[float, float]]:
    if isinstance(area, str) or _geometry.is_geometry(area) or isinstance(area, dict):
        found = _geometry.polygons(area)
        if len(found) != 1 or len(found[0]) != 1:
            raise ValueError("the area must be one polygon without holes")
        area = found[0][0]
    corners = np.asarray(area, dtype=float)
    if corners.ndim != 2 or corners.shape[1] != 2:
        raise ValueError(f"the area has the shape {corners.shape}, but corners are (k, 2)")
    return [(float(x), float(y)) for x, y in corners]


def _line(line: Any) -> tuple[tuple[float, float], tuple[float, float]]:
    if _geometry.is_geometry(line):
        line = _geometry.mapping(line)["coordinates"]
    ends = np.asarray(line, dtype=float)
    if ends.shape != (2, 2):
        raise ValueError(f"the line has the shape {ends.shape}, but is two points: (2, 2)")
    (a, b), (c, d) = ends
    return (float(a), float(b)), (float(c), float(d))
