"""Pictures of worlds."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from .. import plot
from .._world import World

SIZE = (640, 480)
"""Width and height of a picture, pixels."""
DPI = 100


def checked_mode(render_mode: str | None) -> str | None:
    """Returns a render mode, if it is one."""
    if render_mode not in (None, "rgb_array"):
        raise ValueError(f"render_mode is {render_mode!r}; give None or `rgb_array`")
    return render_mode


def frame(world: World, controlled: npt.NDArray[np.uint32]) -> npt.NDArray[np.uint8]:
    """Returns a picture of a world, (height, width, 3): its walls, its agents, and crosses at the goals of those under
    control.
    """
    try:
        from matplotlib.backends.backend_agg import FigureCanvasAgg
        from matplotlib.collections import LineCollection
        from matplotlib.figure import Figure
    except ImportError:
        raise ImportError("pictures need matplotlib: pip install matplotlib") from None
    figure = Figure(figsize=(SIZE[0] / DPI, SIZE[1] / DPI), dpi=DPI)
    canvas = FigureCanvasAgg(figure)
    axes = figure.add_axes((0.0, 0.0, 1.0, 1.0))
    axes.add_collection(LineCollection(list(world.walls().reshape(-1, 2, 2)), colors="black"))
    plot.world(world, axes)
    axes.set_axis_off()
    mine = np.isin(world.ids, controlled)
    goals = world.targets()[mine]
    axes.scatter(goals[:, 0], goals[:, 1], marker="x", color="black")
    canvas.draw()  # type: ignore[no-untyped-call]
    pixels = np.asarray(canvas.buffer_rgba())  # type: ignore[no-untyped-call]
    return pixels[..., :3].copy()
