"""Crowds and groups that never overlap, never get stuck and never tremble.

A `Scene` says who walks where. `Scene.build` makes a `World`, whose state is NumPy arrays in the order of the agents'
numbers. `Scene.run` makes a `Run`, which shows itself in a notebook and writes files.

>>> import throng_sim as tg
>>> world = tg.Scene("circle").build()
>>> world.step(25)
>>> world.positions.shape
(36, 2)

Lengths are metres, times seconds, angles radians; in scene files angles are degrees.
"""

import importlib
from typing import Any

from ._compare import Comparison, compare
from ._model import Each, Model, View, model
from ._run import Run
from ._scene import Scene, gallery, ground, models, open, schema
from ._summary import Summary
from ._sweep import Results, sweep
from ._throng import FileError, SceneError, WorldError
from ._trajectories import Trajectories
from ._world import Event, Neighbors, Status, Stepper, World, step_all
from . import figure, measure, plot

__all__ = [
    "Comparison",
    "Each",
    "Event",
    "FileError",
    "Model",
    "Neighbors",
    "Results",
    "Run",
    "Scene",
    "SceneError",
    "Status",
    "Stepper",
    "Summary",
    "Trajectories",
    "View",
    "World",
    "WorldError",
    "compare",
    "figure",
    "gallery",
    "ground",
    "measure",
    "model",
    "models",
    "open",
    "plot",
    "schema",
    "step_all",
    "sweep",
]

# parts that need more than NumPy, or that most programs do not need, are imported when they are first used
_LATER = ("check", "envs", "reference")


def __getattr__(name: str) -> Any:
    if name in _LATER:
        return importlib.import_module(f".{name}", __name__)
    raise AttributeError(f"module `throng_sim` has no attribute `{name}`")


def __dir__() -> list[str]:
    return [*globals(), *_LATER]
