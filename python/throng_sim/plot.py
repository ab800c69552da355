"""Plots with matplotlib, in the project's colours.

Each function draws into `ax`, or into new axes, and returns the axes.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from . import _throng, measure
from ._run import Run
from ._world import World


def palette(count: int = 10) -> list[str]:
    """Returns the colours of groups and lines.

    >>> len(palette(3))
    3
    """
    return _throng.palette(count)


def _axes(ax: Any, **labels: str) -> Any:
    if ax is None:
        try:
            from matplotlib import pyplot
        except ImportError:
            raise ImportError("plots need matplotlib: pip install matplotlib") from None
        ax = pyplot.subplots(layout="constrained")[1]
    ax.set(**labels)
    for side in ("top", "right"):
        ax.spines[side].set_visible(False)
    return ax


def world(of: World, ax: Any = None, *, ids: bool = False) -> Any:
    """Draws a world as it is now: bodies in the colours of their groups, with headings; `ids` writes their numbers."""
    from matplotlib.collections import EllipseCollection, LineCollection

    ax = _axes(ax, xlabel="x, m", ylabel="y, m")
    ax.set_aspect("equal")
    colors = np.array(palette(max(len(of.group_names), 1)))[of.groups]
    width = 2 * of.radii
    ax.add_collection(
        EllipseCollection(
            width, width, np.zeros(len(of)), units="xy", offsets=of.positions, offset_transform=ax.transData, facecolors=colors
        )
    )
    _walls(of, ax)
    tips = of.positions + of.radii[:, None] * np.stack([np.cos(of.headings), np.sin(of.headings)], axis=1)
    ax.add_collection(LineCollection(list(np.stack([of.positions, tips], axis=1)), colors="#222222", linewidths=0.8))
    if ids:
        for number, (x, y) in zip(of.ids, of.positions, strict=True):
            ax.annotate(str(number), (x, y), fontsize=7, ha="center", va="center", color="white")
    low, high = of.bounds
    ax.set(xlim=(low[0] - 0.5, high[0] + 0.5), ylim=(low[1] - 0.5, high[1] + 0.5))
    return ax


def _ground(run: Run, ax: Any) -> None:
    from matplotlib.patches import PathPatch
    from matplotlib.path import Path

    for area in run._recording.walkable():
        rings = [Path(np.array([*ring, ring[0]]), closed=True) for ring in area]
        ax.add_patch(PathPatch(Path.make_compound_path(*rings), facecolor="#f4f4f2", edgecolor="none", zorder=0))
    _walls(run.world, ax)


def _walls(of: World, ax: Any) -> None:
    from matplotlib.collections import LineCollection

    ax.add_collection(LineCollection(list(of.walls().reshape(-1, 2, 2)), colors="#777777", linewidths=1.0, zorder=1))


def trajectories(run: Run, ax: Any = None, *, since: float = 0.0, until: float = np.inf) -> Any:
    """Draws the paths of all agents between two times, in the colours of their groups."""
    from matplotlib.collections import LineCollection

    ax = _axes(ax, xlabel="x, m", ylabel="y, m", title=run.scene.title)
    ax.set_aspect("equal")
    _ground(run, ax)
    arrays = run.arrays()
    within = (arrays["time"] >= since) & (arrays["time"] <= until)
    order = np.lexsort((arrays["time"][within], arrays["id"][within]))
    ids = arrays["id"][within][order]
    places = np.stack([arrays["x"][within][order], arrays["y"][within][order]], axis=1)
    names = run.group_names
    groups = np.array([names.index(group) for group in arrays["group"][within][order]], dtype=int)
    cuts = np.flatnonzero(np.diff(ids)) + 1
    colors = palette(max(len(names), 1))
    firsts = [0, *cuts] if len(ids) else []
    ax.add_collection(
        LineCollection(np.split(places, cuts), colors=[colors[groups[k]] for k in firsts], linewidths=0.8, alpha=0.8)
    )
    ax.autoscale_view()
    return ax


def flow(run: Run, line: Any, ax: Any = None, **options: Any) -> Any:
    """Draws the number of people that have crossed a line over time (an N-t diagram)."""
    found = measure.flow(run, line, **options)
    ax = _axes(ax, xlabel="time, s", ylabel="people across the line", title=f"{found.mean:.2f} people a second")
    ax.step(found.time, found.count, where="post", color=palette(1)[0])
    return ax


def density(run: Run, area: Any, ax: Any = None, **options: Any) -> Any:
    """Draws the classic and the Voronoi density of an area over time."""
    found = measure.density(run, area, **options)
    ax = _axes(ax, xlabel="time, s", ylabel="density, 1/m²")
    first, second = palette(2)
    ax.plot(found.time, found.density, color=first, alpha=0.5, label="people in the area")
    ax.plot(found.time, found.voronoi_density, color=second, label="Voronoi")
    ax.legend(frameon=False)
    return ax


def fundamental(run: Run, area: Any, ax: Any = None, **options: Any) -> Any:
    """Draws the fundamental diagram of an area: speed over density."""
    found = measure.fundamental(run, area, **options)
    ax = _axes(ax, xlabel="density, 1/m²", ylabel="speed, m/s")
    ax.plot(found.density, found.speed, ".", color=palette(1)[0], alpha=0.4)
    ax.set(xlim=(0, None), ylim=(0, None))
    return ax


def speeds(run: Run, ax: Any = None, **options: Any) -> Any:
    """Draws the mean speed over time."""
    time, speed = measure.speeds(run, **options)
    ax = _axes(ax, xlabel="time, s", ylabel="mean speed, m/s")
    ax.plot(time, speed, color=palette(1)[0])
    ax.set(ylim=(0, None))
    return ax
