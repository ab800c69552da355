"""Curves of animation, of Blender's actions with and without slots."""

import bpy
import numpy as np

from . import keys

LINEAR, CONSTANT = 1, 0
"""Numbers of interpolations, as `foreach_set` takes them."""


class Curves:
    """The curves of the action of an object."""

    def __init__(self, owner: bpy.types.Object, name: str) -> None:
        action = bpy.data.actions.new(name)
        owner.animation_data_create().action = action
        if hasattr(action, "slots"):
            slot = action.slots.new(id_type="OBJECT", name=name)
            owner.animation_data.action_slot = slot
            strip = action.layers.new("Layer").strips.new(type="KEYFRAME")
            self._all = strip.channelbag(slot, ensure=True).fcurves
        else:
            self._all = action.fcurves

    def add(self, path: str, frames: np.ndarray, values: np.ndarray, tolerance: np.ndarray, first: int = 0) -> None:
        """Adds the curves of one property: `values` are (frames, 1, components)."""
        self.add_all([path], frames, values, keys.needed(values, tolerance), first)

    def add_all(
        self, paths: list[str], frames: np.ndarray, values: np.ndarray, keep: np.ndarray, first: int = 0
    ) -> None:
        """Adds curves of several properties: `values` are (frames, properties, components), and `keep` says which frames
        have a key, (frames, properties)."""
        for at, path in enumerate(paths):
            kept = keep[:, at]
            for component in range(values.shape[2]):
                self._curve(path, first + component, frames[kept], values[kept, at, component], LINEAR)

    def step(self, path: str, steps: list[tuple[int, float]], components: int) -> None:
        """Adds curves of a property whose components all change at once, at frames."""
        frames, values = (np.array(column) for column in zip(*steps, strict=True))
        for component in range(components):
            self._curve(path, component, frames, values, CONSTANT)

    def _curve(self, path: str, index: int, frames: np.ndarray, values: np.ndarray, interpolation: int) -> None:
        curve = self._all.new(path, index=index)
        curve.keyframe_points.add(len(frames))
        points = np.stack([frames, values], axis=1).astype(np.float32)
        curve.keyframe_points.foreach_set("co", points.ravel())
        curve.keyframe_points.foreach_set("interpolation", np.full(len(frames), interpolation, np.int32))
        curve.update()
