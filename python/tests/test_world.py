"""Worlds: arrays, steps, changes, misuse."""

import copy
import gc
import os
import pickle
import threading

import numpy as np
import pytest
import throng_sim as tg


def crowd(n: int = 40, seed: int = 3) -> tg.Scene:
    scene = tg.Scene(walkable="POLYGON ((0 0, 20 0, 20 8, 0 8, 0 0))", seed=seed)
    scene.group("left", n=n // 2, area="POLYGON ((0.5 0.5, 6 0.5, 6 7.5, 0.5 7.5, 0.5 0.5))", goal=(19, 4), gap=0.05)
    scene.group("right", n=n // 2, area="POLYGON ((14 0.5, 19.5 0.5, 19.5 7.5, 14 7.5, 14 0.5))", goal=(1, 4), gap=0.05)
    return scene


def test_arrays_have_a_row_for_each_agent_in_the_order_of_ids() -> None:
    world = crowd().build()
    assert len(world) == 40
    assert (np.diff(world.ids.astype(int)) > 0).all()
    for name, shape, kind in [
        ("positions", (40, 2), np.float64),
        ("velocities", (40, 2), np.float32),
        ("altitudes", (40,), np.float32),
        ("vertical_velocities", (40,), np.float32),
        ("headings", (40,), np.float32),
        ("radii", (40,), np.float32),
        ("preferred_speeds", (40,), np.float32),
        ("status", (40,), np.uint8),
        ("groups", (40,), np.uint32),
        ("ids", (40,), np.uint32),
    ]:
        array = getattr(world, name)
        assert (array.shape, array.dtype) == (shape, kind), name
        assert not array.flags.writeable, name
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 0
    assert world.group_names == ["left", "right"]
    assert (world.groups == np.repeat([0, 1], 20)).all()


def test_arrays_are_live_and_stay_the_same_objects() -> None:
    world = crowd().build()
    positions, part = world.positions, world.positions[3:5, 0]
    before = positions.copy()
    world.step(25)
    assert world.positions is positions
    assert (positions != before).any(axis=1).all()
    assert (part == positions[3:5, 0]).all()
    # displacements agree with velocities, which do not come from positions
    at, velocity = positions.copy(), world.velocities.copy()
    world.step()
    moved = (positions - at) / world.dt
    assert np.abs(moved - (velocity + world.velocities) / 2).max() < 1.0


def test_views_outlive_changes_and_the_world() -> None:
    world = crowd().build()
    held = world.positions
    before = held.copy()
    new = world.add("left", [(10.0, 4.0), (10.0, 6.0)], goal=(1.0, 1.0))
    assert len(world) == 42 and world.positions.shape == (42, 2)
    assert (held == before).all()
    assert (world.goals[np.isin(world.ids, new)] == (1.0, 1.0)).all()
    world.remove(new)
    world.remove(int(world.ids[0]))
    assert len(world) == 39
    later = world.positions
    kept = later.copy()
    del world
    gc.collect()
    assert (held == before).all() and (later == kept).all()


def test_preferred_velocities_are_obeyed_at_the_next_step_and_given_back() -> None:
    scene = tg.Scene()
    scene.group("one", at=[(0, 0), (50, 50)], goal=[(9, 0), (59, 50)], keep_right=0, look_ahead=False)
    world = scene.build()
    preferred = world.preferred
    assert np.isnan(preferred).all()
    preferred[0] = (0.0, 1.0)
    world.step(50)
    assert world.velocities[0] == pytest.approx((0, 1), abs=1e-3)
    assert world.velocities[1] == pytest.approx((1.3, 0), abs=1e-3)
    assert world.preferred is preferred and preferred[0].tolist() == [0.0, 1.0]
    preferred[0] = np.nan
    world.step(400)
    assert world.positions[0] == pytest.approx((9, 0), abs=0.15)


def test_goals_can_be_written() -> None:
    world = crowd(n=2).build()
    assert world.goals.tolist() == [[19, 4], [1, 4]]
    world.goals[world.ids == 1] = (3.0, 7.0)
    world.run()
    assert world.positions[1] == pytest.approx((3, 7), abs=0.3)
    world.goals[:] = np.nan
    at = world.positions.copy()
    world.step(50)
    assert np.abs(world.positions - at).max() < 0.3


@pytest.mark.parametrize("name", ["preferred", "goals"])
def test_half_a_value_and_infinity_are_refused(name: str) -> None:
    world = crowd().build()
    getattr(world, name)[1] = (np.nan, 1.0)
    with pytest.raises(ValueError, match=f"`{name}` has NaN in one of two numbers for agent 1"):
        world.step()
    getattr(world, name)[1] = (np.inf, 1.0)
    with pytest.raises(tg.WorldError, match=f"`{name}` of agent 1"):
        world.step()
    getattr(world, name)[1] = (1.0, 1.0)
    world.step()


def test_equal_worlds_have_equal_bits_for_any_threads_and_in_python_threads() -> None:
    expected = crowd().build()
    expected.step(100)
    worlds = [crowd().build(threads=threads) for threads in (1, 2, 3)]
    runners = [threading.Thread(target=world.step, args=(100,)) for world in worlds]
    for runner in runners:
        runner.start()
    for runner in runners:
        runner.join()
    assert [world.hash() for world in worlds] == [expected.hash()] * 3
    several = [crowd(seed=seed).build() for seed in range(5)]
    alone = [crowd(seed=seed).build() for seed in range(5)]
    tg.step_all(several, 50, threads=2)
    for world in alone:
        world.step(50)
    assert [world.hash() for world in several] == [world.hash() for world in alone]
    with pytest.raises(ValueError, match="given twice"):
        tg.step_all([worlds[0], worlds[0]])


def test_one_world_in_two_threads_waits() -> None:
    world = crowd().build()
    threads = [threading.Thread(target=lambda: [world.step() for _ in range(50)]) for _ in range(2)]
    for thread in threads:
        thread.start()
    while threads[0].is_alive():
        assert np.isfinite(world.positions).all()
    for thread in threads:
        thread.join()
    twin = crowd().build()
    twin.step(100)
    assert world.hash() == twin.hash()


def test_saved_states_clones_and_pickles_go_on_alike() -> None:
    world = crowd().build()
    world.step(30)
    state = world.save()
    twins = [world.clone(), copy.deepcopy(world), pickle.loads(pickle.dumps(world))]
    world.step(30)
    for twin in twins:
        twin.step(30)
        assert twin.hash() == world.hash()
    hash = world.hash()
    world.load(state)
    assert world.time == pytest.approx(30 * world.dt)
    world.step(30)
    assert world.hash() == hash
    with pytest.raises(tg.WorldError):
        world.load(state[:50])
    assert world.hash() == hash


def test_neighbours_are_the_nearest() -> None:
    world = crowd(n=60).build()
    at = world.positions
    distance = np.linalg.norm(at[:, None] - at[None], axis=2)
    np.fill_diagonal(distance, np.inf)
    for k, reach in [(3, np.inf), (10, 1.5), (100, np.inf), (0, 1.0)]:
        near = world.neighbors(k, reach)
        assert near.indptr.shape == (len(world) + 1,)
        for row in range(len(world)):
            inside = np.sort(distance[row][(distance[row] <= reach) & np.isfinite(distance[row])])[:k]
            found = slice(near.indptr[row], near.indptr[row + 1])
            assert near.distance[found] == pytest.approx(inside)
            assert near.distance[found] == pytest.approx(distance[row, near.of(row)])


def test_events_of_all_steps_of_a_call() -> None:
    world = tg.Scene("headon").build()
    world.run()
    assert [event.kind for event in world.events] == ["arrived", "arrived"]
    assert world.events[0].time <= world.time
    assert world.finished and world.expectations.passed
    assert world.summary.arrived == 2


def test_a_world_changes_while_it_runs() -> None:
    world = crowd().build()
    world.step(10)
    world["avoid.orca.time_horizon"] = 4
    world["group.left.speed.preferred"] = 0.5
    assert (world.preferred_speeds[world.groups == 0] == 0.5).all()
    assert (world.preferred_speeds[world.groups == 1] != 0.5).all()
    with pytest.raises(ValueError, match="cannot change while a world runs"):
        world["time.step"] = 0.1
    with pytest.raises(tg.SceneError):
        world["avoid.orca.horizon"] = 1


def test_a_moved_agent_is_there() -> None:
    world = crowd().build()
    world.move(0, (10, 4))
    assert world.positions[0].tolist() == [10, 4]
    world.push(0, (1, 0))
    assert world.velocities[0].tolist() == [1, 0]
    with pytest.raises(tg.WorldError, match="cannot be at"):
        world.move(0, (100, 100))
    with pytest.raises(IndexError, match="agent 999 is not present"):
        world.move(999, (1, 1))


@pytest.mark.parametrize(
    ("at", "error"),
    [
        ([1.0, 2.0, 3.0], "must be"),
        ("x", "could not convert"),
        ([[np.nan, 1.0]], "position"),
        ([[50.0, 50.0]], "cannot be at"),
    ],
)
def test_agents_that_cannot_be_added(at: object, error: str) -> None:
    world = crowd().build()
    with pytest.raises(ValueError, match=error):
        world.add("left", at)
    with pytest.raises(ValueError, match="there is no group `middle`; there are: left, right"):
        world.add("middle", (1, 1))
    assert len(world) == 40


def test_misuse_is_an_exception() -> None:
    world = crowd().build()
    with pytest.raises(TypeError):
        tg.World()
    with pytest.raises(ValueError, match="at least 0"):
        world.step(-1)
    with pytest.raises(TypeError):
        world.step(1.5)
    with pytest.raises(IndexError):
        world.remove(12345)
    with pytest.raises(AttributeError):
        world.positions = 3
    with pytest.raises(ValueError, match="more than 0"):
        world.neighbors(3, -1)


@pytest.mark.skipif(not hasattr(os, "fork"), reason="forks exist on Unix")
@pytest.mark.filterwarnings("ignore:.*multi-threaded.*fork:DeprecationWarning")
def test_a_forked_child_goes_on() -> None:
    world = crowd().build(threads=2)
    world.step(10)
    read, write = os.pipe()
    child = os.fork()
    if child == 0:
        world.step(20)
        os.write(write, str(world.hash()).encode())
        os._exit(0)
    os.waitpid(child, 0)
    world.step(20)
    assert int(os.read(read, 100)) == world.hash()


def test_explain_draws() -> None:
    world = crowd().build()
    world.step(20)
    figure = world.explain(3)
    assert "<svg" in figure.svg and figure._repr_svg_() == figure.svg
