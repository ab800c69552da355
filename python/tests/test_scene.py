"""Scenes: from names, files, texts, dicts and shapes; errors."""

import json
import pickle
from pathlib import Path

import numpy as np
import pytest
import shapely
import throng_sim as tg

TEXT = """
title = "Two"
[[group]]
place.points = [[0, 0], [5, 0]]
goal.points.at = [[5, 0], [0, 0]]
"""


def test_a_scene_from_a_name_a_file_a_text_and_a_dict(tmp_path: Path) -> None:
    assert tg.Scene("circle") == tg.Scene(tg.Scene("circle").toml)
    file = tmp_path / "two.toml"
    file.write_text(TEXT)
    keys = {
        "title": "Two",
        "group": [{"place": {"points": [(0, 0), (5, 0)]}, "goal": {"points": {"at": np.array([[5, 0], [0, 0]])}}}],
    }
    scenes = [tg.Scene(TEXT), tg.Scene(file), tg.Scene(str(file)), tg.Scene(keys)]
    for scene in scenes:
        assert scene == scenes[0]
        world = scene.build()
        world.run()
        assert world.positions == pytest.approx(np.array([[5, 0], [0, 0]]), abs=0.2)
    assert scenes[0].title == "Two" and scenes[0].groups == ["0"]


def test_the_gallery_has_every_scene() -> None:
    names = [name for group in tg.gallery().values() for name in group]
    assert {"circle", "doorway", "corridor"} <= set(names) and len(names) > 50
    assert "hrvo" in tg.models()
    assert "group" in tg.schema()["properties"]


def test_shapes_of_shapely_geojson_and_wkt_are_the_same_ground() -> None:
    shape = shapely.Polygon([(0, 0), (12, 0), (12, 8), (0, 8)], holes=[[(5, 3), (7, 3), (7, 5), (5, 5)]])
    hashes = set()
    for given in (shape, shape.wkt, json.loads(shapely.to_geojson(shape)), shapely.MultiPolygon([shape])):
        scene = tg.Scene(walkable=given, dt=0.05, limit=20)
        scene.group("a", at=[(1, 4), (1, 6)], goal=(11, 4), speed=(1.3, 0.2))
        world = scene.build(seed=4)
        world.run()
        assert world.summary.arrived == 2 and world.dt == 0.05
        assert shape.buffer(-0.12).covers(shapely.MultiPoint(world.positions))
        hashes.add(world.hash())
    assert len(hashes) == 1


def test_obstacles_exits_and_models() -> None:
    scene = tg.Scene(walkable=shapely.box(0, 0, 20, 6), obstacles=[shapely.box(9, 0, 10, 2.4), shapely.box(9, 3.6, 10, 6)])
    name = scene.group("people", n=20, area=shapely.box(0.5, 0.5, 7, 5.5), exit=shapely.box(18, 0, 20, 6), model="hrvo", gap=0.1)
    assert name == "people" and scene["group.people.count"] == 20
    world = scene.build()
    summary = world.run()
    assert (summary.removed, len(world), summary.overlaps) == (20, 0, 0)


def test_values_are_set_and_read() -> None:
    scene = tg.Scene("doorway")
    twin = scene.copy()
    scene["avoid.orca.time_horizon"] = 2.5
    scene["group.people.count"] = 7
    scene["title"] = 'a "quoted" title'
    assert scene["group.0.avoid.orca.time_horizon"] == 2.5
    assert scene["group.people.count"] == 7 and twin["group.people.count"] == 100
    assert scene.title == 'a "quoted" title'
    assert len(scene.build()) == 7
    assert scene.with_model("rvo:time_horizon=4")["group.0.avoid.rvo.time_horizon"] == 4
    with pytest.raises(KeyError):
        scene["group.9.count"]


def test_a_scene_is_pickled_with_its_folder(tmp_path: Path) -> None:
    (tmp_path / "plan.wkt").write_text("POLYGON ((0 0, 12 0, 12 8, 0 8, 0 0))")
    (tmp_path / "s.toml").write_text('walkable.file = "plan.wkt"\n[[group]]\nplace.point = [3, 3]\n')
    scene = tg.Scene(tmp_path / "s.toml")
    twin = pickle.loads(pickle.dumps(scene))
    assert twin == scene and len(twin.build()) == 1
    with pytest.raises(TypeError, match="unhashable"):
        hash(scene)


def test_an_error_says_where_it_is_and_how_to_mend_it() -> None:
    with pytest.raises(tg.SceneError) as raised:
        tg.Scene("[[group]]\nplace.point = [0, 0]\nspeeed.preferred = 1\n")
    error = raised.value
    assert (error.line, error.column, error.kind) == (3, 1, "UnknownKey")
    assert "speeed" in error.what and "speed" in error.hint
    with pytest.raises(tg.SceneError, match="there is no scene `crcle`"):
        tg.Scene("crcle")
    scene = tg.Scene("circle")
    with pytest.raises(tg.SceneError, match="time_horizon"):
        scene["avoid.orca.time_horizon"] = "long"
    with pytest.raises(tg.SceneError):
        tg.Scene(walkable="POLYGON ((0 0, 4 4, 4 0, 0 4, 0 0))").build()


@pytest.mark.parametrize(
    ("make", "kind", "text"),
    [
        (lambda: tg.Scene(walkable="POLYGON ((0"), ValueError, "not WKT"),
        (lambda: tg.Scene(walkable=3), TypeError, "is not a shape"),
        (lambda: tg.Scene(walkable=shapely.Point(1, 2)), ValueError, "is a Point"),
        (lambda: tg.Scene(obstacles=[shapely.Point(0, 0).buffer(2) - shapely.Point(0, 0).buffer(1)]), ValueError, "hole"),
        (lambda: tg.Scene().group(goal=(1, 2, 3), at=[(0, 0)]), ValueError, "3 numbers"),
        (lambda: tg.Scene().group(at=[(0, 0)], area=shapely.box(0, 0, 1, 1)), ValueError, "not both"),
        (lambda: tg.Scene().group(at=[(0, 0)], n=3), ValueError, "has 1 points"),
        (lambda: tg.Scene({"group": object()}), TypeError, "cannot be a value"),
        (lambda: tg.Scene(limit=-1).build(), tg.SceneError, "limit"),
        (lambda: tg.open("missing.dxf", people=3), tg.SceneError, "missing.dxf"),
    ],
)
def test_misuse_is_an_exception(make: object, kind: type[Exception], text: str) -> None:
    with pytest.raises(kind, match=text):
        make()  # type: ignore[operator]


def test_a_floor_plan_is_opened_with_an_exit(tmp_path: Path) -> None:
    plan = tmp_path / "hall.wkt"
    plan.write_text("POLYGON ((0 0, 12 0, 12 8, 0 8, 0 0))")
    scene = tg.open(plan, exit=(11, 0, 1, 8), people=9)
    world = scene.build()
    world.run()
    assert world.summary.removed == 9
    scene.save(tmp_path / "hall.toml")
    assert tg.Scene(tmp_path / "hall.toml").build().hash() == scene.build().hash()
