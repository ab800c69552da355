"""Local models in Python."""

import _thread
import gc
import signal
import threading
import time
import weakref

import numpy as np
import pytest
import throng_sim as tg


def ring(n: int = 20) -> tg.Scene:
    angle = np.arange(n) * 2 * np.pi / n
    at = max(8, n / 10) * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    scene = tg.Scene()
    scene.group("ring", at=at, goal=-at, preset="animation")
    return scene


def test_a_model_that_prefers_is_the_model_none() -> None:
    @tg.model
    def as_preferred(view: tg.View) -> np.ndarray:
        return view.preferred

    ours, theirs = ring().build(model=as_preferred), ring().build(model="none")
    for _ in range(50):
        ours.step()
        theirs.step()
        assert np.abs(ours.positions - theirs.positions).max() < 1e-4
    assert ours.summary.overlaps == 0


def test_the_view_is_what_the_world_is() -> None:
    seen = []

    @tg.model(neighbors=5, reach=4.0)
    def look(view: tg.View) -> np.ndarray:
        seen.append(view)
        return view.preferred

    world = ring().build(model=look)
    world.step(40)
    at, radius, ids = world.positions.copy(), world.radii.copy(), world.ids.copy()
    seen.clear()
    world.step()
    view = seen[0]
    assert (view.ids == ids).all() and view.positions == pytest.approx(at)
    assert len(view) == 20 and 0 < view.dt <= world.dt
    near = view.near
    assert near.start[-1] == len(near.ids) and near.row.shape == near.ids.shape
    other = np.searchsorted(ids, near.ids)
    assert near.offsets == pytest.approx(at[other] - at[near.row], abs=1e-5)
    assert (near.radii >= radius[other] + radius[near.row] - 1e-6).all()
    distance = np.linalg.norm(at[:, None] - at[None], axis=2)
    np.fill_diagonal(distance, np.inf)
    for k in range(20):
        inside = np.sort(distance[k][distance[k] <= 4.0])[:5]
        found = np.linalg.norm(near.offsets[near.start[k] : near.start[k + 1]], axis=1)
        assert found == pytest.approx(inside, abs=1e-4)
    assert view.sum(np.ones(len(near.ids))) == pytest.approx(np.diff(near.start))


def test_walls_are_seen() -> None:
    walls = []

    @tg.model(sees=3.0)
    def look(view: tg.View) -> np.ndarray:
        walls.append(view.walls)
        return view.preferred

    scene = tg.Scene(walkable="POLYGON ((0 0, 10 0, 10 4, 0 4, 0 0))")
    scene.group("one", at=[(2, 1)], goal=(9, 1))
    scene.build(model=look).step()
    ends = {tuple(np.round(end).astype(int)) for end in np.concatenate([walls[0].a, walls[0].b])}
    assert (-2, -1) in ends and (8, -1) in ends


def test_a_model_for_each_agent_is_the_same_as_for_all() -> None:
    @tg.model
    def together(view: tg.View) -> np.ndarray:
        push = view.near.offsets / (view.near.offsets**2).sum(axis=1, keepdims=True)
        return view.preferred - 0.2 * view.sum(push)

    @tg.model(each=True)
    def alone(w: tg.Each) -> np.ndarray:
        push = sum((other.offset / (other.offset @ other.offset) for other in w.others), np.zeros(2))
        return w.me.preferred - 0.2 * push

    a, b = ring().build(model=together), ring().build(model=alone)
    a.step(60)
    b.step(60)
    assert a.positions == pytest.approx(b.positions, abs=1e-3)
    assert a.summary.overlaps == b.summary.overlaps == 0


def test_the_same_bits_for_any_threads() -> None:
    @tg.model
    def mine(view: tg.View) -> np.ndarray:
        return view.preferred - 0.1 * view.sum(view.near.offsets)

    worlds = [ring(60).build(model=mine, threads=threads) for threads in (1, 2)]
    for world in worlds:
        world.step(50)
    clone = worlds[0].clone()
    clone.step(10)
    worlds[0].step(10)
    assert clone.hash() == worlds[0].hash()
    worlds[1].step(10)
    assert worlds[0].hash() == worlds[1].hash()


BAD = [
    (lambda view: None, TypeError, "returned None; return an array of 20 by 2 numbers"),
    (lambda view: "left", TypeError, "returned an object of type str"),
    (lambda view: view.preferred[0], ValueError, r"shape \(2,\); return an array of 20 by 2"),
    (lambda view: view.preferred[:3], ValueError, r"shape \(3, 2\); return an array of 20 by 2"),
    (lambda view: np.zeros((20, 3)), ValueError, r"shape \(20, 3\)"),
    (lambda view: view.preferred * np.nan, ValueError, "velocities must be finite"),
    (lambda view: 1 / 0, ZeroDivisionError, "division"),
    (lambda view: view.speed, AttributeError, "speed"),
]


@pytest.mark.parametrize(("bad", "kind", "text"), BAD)
def test_an_error_names_the_model_and_its_line(bad: object, kind: type[Exception], text: str) -> None:
    world = ring().build(model=tg.model(bad))  # type: ignore[call-overload]
    with pytest.raises(kind, match=text) as raised:
        world.step(5)
    notes = " ".join(getattr(raised.value, "__notes__", []))
    if kind in (ZeroDivisionError, AttributeError):
        assert "test_model.py, line" in notes
        assert any(entry.name == "<lambda>" for entry in raised.traceback)
    # the step is whole, and the world goes on
    assert np.isfinite(world.positions).all()
    world.set_model(tg.model(lambda view: view.preferred))
    world.step()


def test_errors_of_a_model_for_each_agent() -> None:
    for bad, kind, text in [
        (lambda w: 3, TypeError, "returned 3 for agent 0; return a velocity"),
        (lambda w: (1, 2, 3), TypeError, "for agent 0"),
        (lambda w: (np.nan, 0), ValueError, "for agent 0; the numbers of a velocity must be finite"),
    ]:
        with pytest.raises(kind, match=text):
            ring().build(model=tg.model(each=True)(bad)).step()


def test_a_model_cannot_use_its_world_inside_of_a_step() -> None:
    world = ring().build()
    other = ring().build()

    @tg.model
    def curious(view: tg.View) -> np.ndarray:
        other.step()
        world.positions  # noqa: B018
        return view.preferred

    world.set_model(curious)
    with pytest.raises(RuntimeError, match="a model reads its view, not the world"):
        world.step()
    assert other.time > 0


def test_ctrl_c_ends_steps_after_a_whole_one() -> None:
    @tg.model
    def slow(view: tg.View) -> np.ndarray:
        time.sleep(0.01)
        return view.preferred

    for model in (slow, None):
        world = ring(200 if model is None else 20).build(model=model)
        threading.Timer(0.2, _thread.interrupt_main, [signal.SIGINT]).start()
        begin = time.monotonic()
        with pytest.raises(KeyboardInterrupt):
            world.step(1_000_000)
        assert time.monotonic() - begin < 5
        assert 0 < world.time < 1e4
        before = world.time
        world.step()
        assert world.time == pytest.approx(before + world.dt)


def test_a_world_that_its_model_refers_to_is_collected() -> None:
    class Token:
        pass

    token = Token()
    gone = weakref.ref(token)
    world = ring().build()

    @tg.model
    def selfish(view: tg.View, held: tg.World = world, token: Token = token) -> np.ndarray:
        return view.preferred

    world.set_model(selfish)
    world.step()
    del world, selfish, token
    gc.collect()
    assert gone() is None


def test_what_is_not_a_model() -> None:
    with pytest.raises(TypeError, match="is not a model"):
        ring().build(model=3)
    with pytest.raises(ValueError, match="there is no model `orc`"):
        ring().build(model="orc")
    with pytest.raises(TypeError, match="made of a function"):
        tg.model()(3)
    with pytest.raises(ValueError, match="sees is -1"):
        tg.model(sees=-1)(lambda view: view.preferred)


def test_a_behaviour_is_asked_before_each_step() -> None:
    asked = []

    def away(world: tg.World) -> np.ndarray:
        asked.append(world.time)
        return 1.2 * world.positions / np.linalg.norm(world.positions, axis=1, keepdims=True)

    world = ring().build(behavior=away)
    world.step(100)
    assert asked == pytest.approx(np.arange(100) * world.dt)
    radius = np.linalg.norm(world.positions, axis=1)
    assert radius == pytest.approx(np.full(20, 8 + 1.2 * world.time), abs=0.2)
    # the same in a run, in a clone, and by hand
    run = ring().run(behavior=away, until=world.time, record=1000)
    assert run.hash == world.hash() and len(run) == 101
    twin, hand = world.clone(), world.clone()
    hand.behavior = None
    world.run(until=world.time + 1)
    twin.step(25)
    for _ in range(25):
        hand.preferred[:] = away(hand)
        hand.step()
    assert world.hash() == twin.hash() == hand.hash()
    with pytest.raises(ValueError, match=r"the behaviour `bad` returned an array of shape \(3,\); return one of shape \(20, 2\)"):

        def bad(world: tg.World) -> list[float]:
            return [1, 2, 3]

        ring().build(behavior=bad).step()
