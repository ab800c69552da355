"""Runs: of a scene, and of the objects of the file."""

from collections.abc import Generator
from pathlib import Path

import bpy
import numpy as np
import throng_sim as tg

from . import shapes
from .task import Progress

RECORD = 25.0
"""Recorded moments a second. Between them agents move on lines, and people walk smoothly."""
MARGIN = 10.0
"""Ground around all shapes where no object is ground, metres."""
GAP = 0.1
"""Least distance of the bodies at the start, metres."""


def scene_of_file(name: str) -> tg.Scene:
    """Opens a scene file, a floor plan, or a scene of the gallery."""
    path = bpy.path.abspath(name)
    return tg.Scene(Path(path) if Path(path).exists() else name)


def scene_of_objects(context: bpy.types.Context) -> tuple[tg.Scene, float]:
    """Returns the scene of the objects with roles, and the height of its ground, metres."""
    found, settings = shapes.of(context), context.scene.throng
    if not found.starts:
        raise ValueError(
            "no object is a start: select an object, and choose the role Start in the sidebar, Throng > Object"
        )
    if not found.goals:
        raise ValueError(
            "no object is a goal: select an object, and choose the role Goal in the sidebar, Throng > Object"
        )
    ground = tg.ground(found.ground or [_around(found)], found.solids)
    if not ground["coordinates"]:
        raise ValueError("obstacles cover all ground: give the role Obstacle to fewer objects")
    scene = tg.Scene(walkable=ground, limit=settings.seconds)
    for thing, outline in found.starts:
        chosen = thing.throng.goal
        if chosen is not None and chosen not in found.goals:
            raise ValueError(
                f"{thing.name} sends people to {chosen.name}, which is no visible goal: give it the role Goal"
            )
        goals = [_goal(goal, corners) for goal, corners in found.goals.items() if chosen in (None, goal)]
        scene.group(
            thing.name,
            n=thing.throng.people,
            area={"type": "Polygon", "coordinates": [outline]},
            goal=goals[0] if len(goals) == 1 else {"nearest": goals},
            speed=(thing.throng.speed, thing.throng.spread) if thing.throng.spread > 0 else thing.throng.speed,
            gap=GAP,
            body={"radius": thing.throng.radius},
        )
    return scene, found.level


def _goal(thing: bpy.types.Object, outline: shapes.Outline) -> dict:
    return {"exit" if thing.throng.leaves else "area": {"polygon": outline}}


def _around(found: shapes.Shapes) -> shapes.Outline:
    """Returns a rectangle around all shapes."""
    outlines = [*found.solids, *found.goals.values(), *(outline for _, outline in found.starts)]
    points = np.concatenate([np.array(outline) for outline in outlines])
    (left, bottom), (right, top) = points.min(axis=0) - MARGIN, points.max(axis=0) + MARGIN
    return [(left, bottom), (right, bottom), (right, top), (left, top)]


def run(scene: tg.Scene, settings) -> Generator[Progress, None, tg.Run]:
    """Runs a scene. Yields its progress, and returns the run."""
    world = scene.build(seed=settings.seed, threads=0)
    steps = tg.Run.gradually(world, record=RECORD, until=settings.seconds)
    while True:
        try:
            time = next(steps)
        except StopIteration as end:
            return end.value
        yield Progress(min(time / settings.seconds, 1.0), f"Run: {time:.1f} s, {len(world)} agents")
