"""Trajectories of files and runs, poses of people, and the ground of outlines."""

from pathlib import Path

import numpy as np
import pytest
import shapely
import throng_sim as tg
from throng_sim import figure


@pytest.fixture(scope="module")
def run() -> tg.Run:
    scene = tg.Scene(dt=0.04)
    scene.group("walkers", at=[(0, 0), (0, 2)], goal=(6, 1), speed=1.3, body={"radius": 0.2})
    scene.group("carts", at=[(0, 8)], goal=(6, 8), body={"radius": 0.7})
    scene.group("late", at=[(3, 4)], goal=(3, 7), source={"start": 1.0, "interval": 1.0, "count": 1})
    return scene.run(record=25, until=5)


def inside(turns: np.ndarray, points: np.ndarray) -> np.ndarray:
    """Rotates points by quaternions w, x, y, z, with matrices."""
    w, x, y, z = np.moveaxis(turns.astype(float), -1, 0)
    rows = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ]
    return np.stack([sum(part * points[..., k] for k, part in enumerate(row)) for row in rows], axis=-1)


def test_states_are_those_of_the_table(run: tg.Run) -> None:
    trajectories = run.trajectories()
    assert list(trajectories.ids) == sorted(set(run.arrays()["id"]))
    assert trajectories.group_names == run.group_names
    assert np.array_equal(trajectories.times, run.times)
    positions, headings = trajectories.states(run.times)
    columns = run.arrays()
    for time, number, x, y, heading in zip(
        *(columns[name] for name in ("time", "id", "x", "y", "heading")), strict=True
    ):
        at = list(trajectories.ids).index(number), list(run.times).index(time)
        assert np.array_equal(positions[at], [x, y, 0]) and headings[at] == heading
    there = ~np.isnan(headings)
    assert there.sum() == len(columns["id"])
    for row, (first, last) in enumerate(trajectories.spans):
        assert np.array_equal(there[row], (run.times >= first) & (run.times <= last))
    chosen, _ = trajectories.states(run.times, ids=trajectories.ids[[2, 0]])
    assert np.array_equal(chosen, positions[[2, 0]], equal_nan=True)
    with pytest.raises(ValueError, match="99 is not the number of an agent"):
        trajectories.states([0.0], ids=[99])
    # half-way between two moments
    middle, _ = trajectories.states((run.times[:-1] + run.times[1:]) / 2)
    assert np.allclose(middle[0], (positions[0, :-1] + positions[0, 1:]) / 2, atol=1e-12)


@pytest.mark.parametrize("ending", ["rec", "csv", "parquet", "sqlite", "glb", "usda"])
def test_files_have_the_same_trajectories(run: tg.Run, tmp_path: Path, ending: str) -> None:
    run.save(tmp_path / f"run.{ending}")
    trajectories = tg.Trajectories.read(tmp_path / f"run.{ending}")
    mine = run.trajectories()
    assert np.array_equal(trajectories.ids, mine.ids)
    positions, headings = (array[:, 3:60:7] for array in mine.states(run.times))
    found = tuple(array[:, 3:60:7] for array in trajectories.states(run.times))
    assert np.nanmax(np.abs(found[0] - positions)) < 2e-3
    turns = np.nanmax(np.abs(np.angle(np.exp(1j * (found[1] - headings)))[np.array(mine.radii) < 0.5]))
    assert turns < 0.02 or ending == "sqlite", "a .sqlite has headings of its own precision"
    assert np.array_equal(np.isnan(found[1]), np.isnan(headings))


def test_people(run: tg.Run) -> None:
    trajectories = run.trajectories()
    is_person = trajectories.radii <= 0.5
    assert [build is not None for build in trajectories.builds] == list(is_person)
    assert np.array_equal(np.isnan(trajectories.heights), ~is_person)
    assert np.array_equal(trajectories.people, trajectories.ids[is_person])
    assert set(trajectories.builds) <= {*figure.BUILDS, None}
    cart = trajectories.ids[~is_person][0]
    with pytest.raises(ValueError, match=f"{cart} is not the number of a person"):
        trajectories.poses([0.0], ids=[int(cart)])


def test_poses_are_forward_kinematics(run: tg.Run) -> None:
    """The joints in the world follow from skeleton, hips and rotations."""
    trajectories = run.trajectories()
    times = np.linspace(0, run.times[-1], 37)
    hips, local = trajectories.poses(times)
    places, turns = trajectories.poses(times, world=True)
    assert hips.shape == (3, 37, 3) and local.shape == (3, 37, 19, 4)
    for row, number in enumerate(trajectories.people):
        agent = list(trajectories.ids).index(number)
        offsets = figure.skeleton(trajectories.builds[agent]) * trajectories.heights[agent]
        assert np.allclose(places[row, :, 0], hips[row], equal_nan=True)
        for joint, parent in enumerate(figure.PARENTS):
            if parent >= 0:
                expected = places[row, :, parent] + inside(turns[row, :, parent], offsets[joint])
                assert np.allclose(places[row, :, joint], expected, atol=1e-6, equal_nan=True)
                spoke = np.array([0.3, -0.5, 0.8])
                expected = inside(turns[row, :, parent], inside(local[row, :, joint], spoke))
                assert np.allclose(inside(turns[row, :, joint], spoke), expected, atol=1e-5, equal_nan=True)
        _, headings = trajectories.states(times)
        assert np.array_equal(np.isnan(hips[row, :, 0]), np.isnan(headings[agent]))
    assert np.nanmin(places[..., 2]) > -0.005, "no joint is below the ground"


def test_poses_are_those_of_the_glb(run: tg.Run, tmp_path: Path) -> None:
    """Feet of the file, read by a program of its own, are the feet of the poses."""
    import json
    import struct

    path = tmp_path / "run.glb"
    run.save(path)
    data = path.read_bytes()
    (length,) = struct.unpack_from("<I", data, 12)
    document = json.loads(data[20 : 20 + length])
    people = {
        node["extras"]["number"]: node["extras"] for node in document["nodes"] if "build" in node.get("extras", {})
    }
    trajectories = run.trajectories()
    assert people.keys() == set(trajectories.people.tolist())
    for row, number in enumerate(trajectories.ids):
        if number in people:
            assert people[number]["build"] == trajectories.builds[row]
            first, last = trajectories.spans[row]
            assert (people[number]["from"], people[number]["to"]) == (pytest.approx(first), pytest.approx(last))


def test_meshes() -> None:
    for build in figure.BUILDS:
        for level, count in zip(figure.LEVELS, (1104, 704, 352, 128), strict=True):
            mesh = figure.mesh(build, level)
            assert (mesh.regions < figure.REGIONS.index("skirt")).sum() == count
            assert mesh.positions.shape == mesh.normals.shape == (len(mesh.regions), 3)
            assert np.allclose(mesh.weights.sum(axis=1), 1, atol=1e-6)
            assert (np.count_nonzero(mesh.weights, axis=1) <= 2).all()
            assert mesh.joints.max() < len(figure.JOINTS) and mesh.regions.max() < len(figure.REGIONS)
            for look, limit in ((1, 0.017), (6, 0.024)):
                a, b, c = np.moveaxis(mesh.positions[mesh.triangles_of(look)].astype(float), 1, 0)
                volume = (a * np.cross(b, c)).sum() / 6
                assert 0.01 < volume < limit, "a closed body, seen from outside"
    assert figure.colors(3).shape == (len(figure.REGIONS), 3)
    # the fourth look has a rucksack, and trousers
    assert set(figure.REGIONS) - {figure.REGIONS[region] for region in figure.worn(3)} == {
        "skirt",
        "coat",
        "long hair",
        "umbrella",
    }
    with pytest.raises(ValueError, match="`giant` is no build: give woman, man, child"):
        figure.mesh("giant")
    with pytest.raises(ValueError, match="`finest` is no level"):
        figure.mesh("man", "finest")


def test_wrong_files(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match=r"cannot read .*none\.rec"):
        tg.Trajectories.read(tmp_path / "none.rec")
    empty = tmp_path / "empty.csv"
    empty.write_text("time,number,x,y\n")
    with pytest.raises(ValueError, match="the file has no agents"):
        tg.Trajectories.read(empty)
    for option in ("frame_rate", "unit"):
        with pytest.raises(ValueError, match=f"{option} must be more than 0"):
            tg.Trajectories.read(empty, **{option: -1.0})


def test_units_of_files(tmp_path: Path) -> None:
    path = tmp_path / "people.txt"
    path.write_text("# id frame x y z\n" + "".join(f"1 {k} {100 + 10 * k} 50 180\n" for k in range(20)))
    trajectories = tg.Trajectories.read(path, frame_rate=10, unit=0.01)
    assert np.allclose(trajectories.states([0.5])[0][0, 0, :2], [1.5, 0.5])
    assert trajectories.times[-1] == pytest.approx(1.9)


def test_ground() -> None:
    """The union of outlines without solids, as shapely has it."""
    rng = np.random.default_rng(5)
    triangles = [rng.uniform(0, 10, (3, 2)).tolist() for _ in range(12)]
    solids = [rng.uniform(0, 10, (3, 2)).tolist() for _ in range(4)]
    expected = shapely.union_all([shapely.Polygon(t) for t in triangles]).difference(
        shapely.union_all([shapely.Polygon(t) for t in solids])
    )
    found = tg.ground(triangles, solids)
    shape = shapely.union_all([shapely.Polygon(rings[0], rings[1:]) for rings in found["coordinates"]])
    assert shape.symmetric_difference(expected).area < 1e-5
    assert tg.ground([]) == {"type": "MultiPolygon", "coordinates": []}
    with pytest.raises(tg.SceneError, match="farther than"):
        tg.ground([[(0, 0), (float("nan"), 0), (1, 1)]])


def test_gradually_is_as_at_once() -> None:
    whole = tg.Scene("circle").run(record=10, until=3)
    steps = tg.Run.gradually(tg.Scene("circle").build(), record=10, until=3, steps=7)
    times = []
    while True:
        try:
            times.append(next(steps))
        except StopIteration as end:
            run = end.value
            break
    assert np.allclose(np.diff(times[:-1]), 0.28)
    assert (run.hash, len(run)) == (whole.hash, len(whole))
    assert run.table().equals(whole.table())


def test_gradually_with_a_behavior() -> None:
    def to_the_middle(world: tg.World) -> np.ndarray:
        return -world.positions

    whole = tg.Scene("circle").run(behavior=to_the_middle, until=2)
    world = tg.Scene("circle").build(behavior=to_the_middle)
    steps = tg.Run.gradually(world, until=2)
    assert len(list(steps)) == 50
    assert world.hash() == whole.hash
