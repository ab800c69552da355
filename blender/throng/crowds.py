"""A crowd in the scene: all objects of a clip, or none if it fails."""

from collections.abc import Iterator
from contextlib import contextmanager

import bpy

from . import armatures, crowd, others, place, stage
from .clip import of
from .task import Progress

SEEN = "throng_seen"
"""Property of the root of a crowd: points that a camera must see to see the crowd, relative to the root, metres."""


def build(
    context: bpy.types.Context, trajectories, title: str, level: float = 0.0, has_place: bool = True
) -> Iterator[Progress]:
    """Adds a crowd to the scene, on the ground at a height (metres). Yields what is done."""
    scene = context.scene
    clip = of(trajectories, scene)
    settings = scene.throng
    with whole():
        into = bpy.data.collections.new(title)
        scene.collection.children.link(into)
        root = bpy.data.objects.new(title, None)
        root.empty_display_size = 0.5
        into.objects.link(root)
        seen = stage.outline(place.reached(clip) - clip.origin())
        root[SEEN] = seen.ravel().tolist()
        root.location = clip.origin() + [0, 0, level]
        people, rest = clip.rows(people=True), clip.rows(people=False)
        parts = [
            ("People", armatures.people, people[: settings.armatures]),
            ("Crowd", crowd.people, people[settings.armatures :]),
            ("Agents", others.agents, rest),
        ]
        for name, add, rows in parts:
            if rows:
                part = _collection(name, into)
                for share in add(clip, rows, root, part):
                    yield Progress(share, f"{name}: {len(rows)} agents")
        if has_place:
            place.build(clip, settings.wall_height, root, _collection("Place", into))
        if settings.has_stage:
            stage.build(scene, seen + root.location, into)
        if settings.fit_range:
            scene.frame_start, scene.frame_end = clip.start, max(clip.end, clip.start)
            scene.frame_set(clip.start)


def _collection(name: str, parent: bpy.types.Collection) -> bpy.types.Collection:
    made = bpy.data.collections.new(name)
    parent.children.link(made)
    return made


@contextmanager
def whole() -> Iterator[None]:
    """Removes all new data if what is inside fails or is cancelled."""
    scene = bpy.context.scene
    before, camera, world = set(bpy.data.user_map()), scene.camera, scene.world
    try:
        yield
    except BaseException:
        scene.camera, scene.world = camera, world
        bpy.data.batch_remove([made for made in bpy.data.user_map() if made not in before])
        raise
