"""Tests in Blender's own Python (bpy), of the sources beside them. The package must be installed."""

import sys
from collections.abc import Iterator
from pathlib import Path

import bpy
import pytest

sys.path.insert(0, str(Path(__file__).parents[1]))
import throng


@pytest.fixture
def scene() -> Iterator[bpy.types.Scene]:
    """An empty scene at 25 frames a second, with the extension."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    throng.register()
    empty = bpy.context.scene
    empty.render.fps = 25
    yield empty
    throng.unregister()


def contents() -> dict[str, int]:
    """Returns how many data blocks of each kind the file has."""
    kinds = (
        "actions",
        "armatures",
        "cameras",
        "collections",
        "lights",
        "materials",
        "meshes",
        "node_groups",
        "objects",
        "worlds",
    )
    return {kind: len(getattr(bpy.data, kind)) for kind in kinds}


@pytest.fixture(scope="session")
def recorded(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    """Files of a run: some people enter late, some leave early."""
    import throng_sim as tg

    scene = tg.Scene(dt=0.04, limit=12)
    scene.group("early", n=12, area=_box(-6, -3, 0, 3), exit=_box(6, -4, 9, 4), speed=(1.3, 0.2), gap=0.1)
    scene.group("late", at=[(0, -6)], goal=(0, 6), source={"start": 1.0, "interval": 2.0, "count": 4})
    folder = tmp_path_factory.mktemp("recorded")
    files = {ending: folder / f"run.{ending}" for ending in ("rec", "csv", "glb", "parquet", "sqlite", "usda")}
    scene.run(record=25).save(*files.values())
    return files


def _box(left: float, bottom: float, right: float, top: float) -> dict:
    corners = [(left, bottom), (right, bottom), (right, top), (left, top)]
    return {"type": "Polygon", "coordinates": [corners]}
