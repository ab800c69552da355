"""Environments: the checks of Gymnasium and PettingZoo, observations and rewards against plain formulas, misuse."""

from __future__ import annotations

import doctest
import importlib
import math
import pkgutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import gymnasium
import numpy as np
import pytest
import shapely
import throng_sim as tg
import throng_sim.envs
from gymnasium.error import ResetNeeded
from gymnasium.utils.env_checker import check_env
from gymnasium.utils.env_match import check_environments_match
from gymnasium.vector import AutoresetMode, SyncVectorEnv
from gymnasium.vector.utils import batch_space
from pettingzoo.test import api_test, parallel_api_test, parallel_seed_test
from pettingzoo.utils import parallel_to_aec

ACTIONS = ["velocity", "speed-turn", "discrete"]


def hall(n: int = 24, seed: int = 3) -> tg.Scene:
    """Two groups in a hall with a pillar; the left goes to a point, the right leaves by an exit."""
    ground = shapely.box(0, 0, 20, 8) - shapely.box(9, 3, 11, 5)
    scene = tg.Scene(walkable=ground, seed=seed, limit=40.0)
    scene.group("left", n=n // 2, area=shapely.box(0.5, 0.5, 6, 7.5), goal=(19, 4), gap=0.05)
    scene.group("right", n=n // 2, area=shapely.box(14, 0.5, 19.5, 7.5), exit=shapely.box(0, 0, 1, 8))
    return scene


def alone(model: str = "none", **keys: Any) -> tg.Scene:
    """One agent on open ground, which obeys commands at once."""
    scene = tg.Scene(limit=20.0)
    scene.group("one", at=[(0, 0)], goal=(6, 0), model=model, preset="animation", acceleration=1000.0, **keys)
    return scene


def towards(observation: Any) -> Any:
    """Straight to the goal at the top speed, as an action of `velocity`."""
    goal = observation[..., 2:4]
    return goal / np.maximum(np.linalg.norm(goal, axis=-1, keepdims=True), 1e-6)


# --- the checks of Gymnasium and PettingZoo


@pytest.mark.parametrize("action", ACTIONS)
@pytest.mark.parametrize("observe", ["nearest-10", "walls-8", "nearest-3+walls-4"])
def test_gymnasium_checks_a_single_agent(action: str, observe: str) -> None:
    env = gymnasium.make("throng/Crowd-v0", scene=hall(), control=5, action=action, observe=observe)
    check_env(env.unwrapped)


def test_gymnasium_finds_equal_environments() -> None:
    one, other = (throng_sim.envs.single(hall(), 2, observe="nearest-4+walls-4") for _ in range(2))
    check_environments_match(one, other, num_steps=100, seed=7)


@pytest.mark.parametrize("control", ["left", "right", [0, 5, 13], 0.25, 1.0])
@pytest.mark.parametrize("action", ACTIONS)
def test_pettingzoo_checks_several_agents(control: Any, action: str, capsys: pytest.CaptureFixture[str]) -> None:
    def make() -> Any:
        return throng_sim.envs.parallel(hall(), control, action=action, observe="nearest-4+walls-4", limit=10.0)

    parallel_api_test(make(), num_cycles=200)
    parallel_seed_test(make, num_cycles=20)
    assert "Passed" in capsys.readouterr().out


def test_agents_that_arrive_leave_the_dictionaries() -> None:
    env = throng_sim.envs.parallel(hall(), "left", model="orca")
    observations, _ = env.reset(seed=4)
    gone: set[str] = set()
    while env.agents:
        before = list(env.agents)
        observations, rewards, arrived, late, infos = env.step({a: towards(observations[a]) for a in before})
        for each in (observations, rewards, arrived, late, infos):
            assert list(each) == before
        ended = {agent for agent in before if arrived[agent] or late[agent]}
        assert set(env.agents) == set(before) - ended
        assert not gone & set(env.agents)
        gone |= ended
    assert gone == set(env.possible_agents)


def test_the_vector_environment_equals_single_ones_side_by_side() -> None:
    options: dict[str, Any] = {"observe": "nearest-4+walls-4", "limit": 13.0}
    ours = throng_sim.envs.vector(hall(), 4, 20, threads=2, **options)
    theirs = SyncVectorEnv([lambda: throng_sim.envs.single(hall(), 20, **options) for _ in range(4)])
    assert ours.metadata["autoreset_mode"] == theirs.metadata["autoreset_mode"] == AutoresetMode.NEXT_STEP
    assert ours.observation_space == theirs.observation_space and ours.action_space == theirs.action_space
    rng = np.random.default_rng(5)
    ends = {"arrived": 0, "late": 0}
    (seen, infos), (seen_, infos_) = ours.reset(seed=11), theirs.reset(seed=11)
    for step in range(150):
        assert (seen == seen_).all() and seen.dtype == seen_.dtype, step
        assert infos.keys() == infos_.keys()
        assert all((infos[key] == infos_[key]).all() for key in infos), step
        assert seen in ours.observation_space
        actions = towards(seen) * rng.uniform(0.8, 1.0, (4, 1)) if step % 9 else rng.uniform(-1, 1, (4, 2))
        seen, rewards, arrived, late, infos = ours.step(actions.astype(np.float32))
        seen_, rewards_, arrived_, late_, infos_ = theirs.step(actions.astype(np.float32))
        assert (rewards == rewards_).all() and (arrived == arrived_).all() and (late == late_).all(), step
        ends["arrived"] += int(arrived.sum())
        ends["late"] += int(late.sum())
    assert min(ends.values()) > 0, ends


def test_vectors_are_the_same_for_any_threads_and_without_copies() -> None:
    runs = []
    for threads, copy in [(1, True), (2, True), (3, False)]:
        envs = throng_sim.envs.vector(hall(), 3, 1, threads=threads, copy=copy)
        first, _ = envs.reset(seed=1)
        seen = first
        for _ in range(10):
            seen, *_ = envs.step(towards(seen))
        assert (seen is first) == (not copy)
        runs.append((seen.copy(), [world.hash() for world in envs.worlds]))
    for seen, hashes in runs[1:]:
        assert (seen == runs[0][0]).all() and hashes == runs[0][1]


def test_wrappers_take_the_environments() -> None:
    several = parallel_to_aec(throng_sim.envs.parallel(hall(), "left", limit=5.0))
    api_test(several, num_cycles=50)
    many = throng_sim.envs.vector(hall(), 3, limit=2.0)
    wrapped = gymnasium.wrappers.vector.NormalizeObservation(gymnasium.wrappers.vector.RecordEpisodeStatistics(many))
    wrapped.reset(seed=1)
    for _ in range(10):
        *_, late, infos = wrapped.step(np.zeros((3, 2), dtype=np.float32))
    assert late.all() and infos["episode"]["l"].tolist() == [10] * 3


def test_gymnasium_makes_vectors() -> None:
    envs = gymnasium.make_vec("throng/Crowd-v0", num_envs=3, vectorization_mode="vector_entry_point", scene="crossing")
    seen, _ = envs.reset(seed=1)
    assert seen.shape == (3, 54) and envs.num_envs == 3
    assert envs.observation_space == batch_space(envs.single_observation_space, 3)
    envs.close()


# --- observations


def frame(vector: Any, heading: float) -> list[float]:
    cos, sin = math.cos(heading), math.sin(heading)
    return [cos * vector[0] + sin * vector[1], -sin * vector[0] + cos * vector[1]]


def observed(world: tg.World, number: int, neighbours: int, rays: int, sight: float) -> list[float]:
    """An observation by plain loops, and shapely for walls."""
    rows = {int(k): row for row, k in enumerate(world.ids)}
    own = rows[number]
    at, velocity = world.positions[own], world.velocities[own].astype(float)
    heading, radius = float(world.headings[own]), float(world.radii[own])
    seen = frame(velocity, heading)
    goal = world.targets()[own] - at
    seen += frame(goal * min(1.0, sight / math.hypot(*goal)), heading)
    others = sorted((math.dist(at, world.positions[row]), row) for row in range(len(world)) if row != own)
    others = [(distance, row) for distance, row in others if distance <= sight][:neighbours]
    for _, row in others:
        seen += frame(world.positions[row] - at, heading)
        seen += frame(world.velocities[row] - velocity, heading)
        seen.append(radius + float(world.radii[row]))
    seen += [0.0] * 5 * (neighbours - len(others))
    walls = shapely.MultiLineString([[(a, b), (c, d)] for a, b, c, d in world.walls()])
    for ray in range(rays):
        angle = heading + 2 * math.pi * ray / rays
        line = shapely.LineString([at, at + sight * np.array([math.cos(angle), math.sin(angle)])])
        hits = line.intersection(walls)
        distance = sight if hits.is_empty else shapely.Point(at).distance(hits)
        seen.append(max(distance - radius, 0.0))
    return seen


@pytest.mark.parametrize("sight", [2.0, 20.0])
def test_observations_are_those_of_plain_loops(sight: float) -> None:
    env = throng_sim.envs.parallel(hall(), 0.5, observe="nearest-6+walls-7", sight=sight)
    rng = np.random.default_rng(8)
    observations, _ = env.reset(seed=9)
    for _ in range(12):
        for agent in env.agents:
            expected = observed(env.world, int(agent.rpartition("_")[2]), 6, 7, sight)
            assert observations[agent] == pytest.approx(expected, abs=2e-5), agent
            assert env.observation_space(agent).contains(observations[agent])
        observations, *_ = env.step({agent: rng.uniform(-1, 1, 2) for agent in env.agents})


def test_agents_without_a_goal_or_neighbours_observe_zeros() -> None:
    scene = tg.Scene()
    scene.group("one", at=[(0, 0)])
    env = throng_sim.envs.single(scene, observe="nearest-2+walls-2", sight=5.0)
    observation, info = env.reset()
    assert observation[:14].tolist() == [0.0] * 14
    assert observation[14:] == pytest.approx([5 - env.world.radii[0]] * 2)
    assert math.isnan(info["distance"])
    _, reward, arrived, _, _ = env.step([1.0, 0.0])
    assert reward == pytest.approx(-0.5 * 0.2) and not arrived


# --- actions


@pytest.mark.parametrize(
    ("action", "given", "velocity"),
    [
        ("velocity", [1.0, 0.0], (1.0, 0.0)),
        ("velocity", [0.0, 0.5], (0.0, 0.5)),
        ("velocity", [9.0, -9.0], (math.sqrt(0.5), -math.sqrt(0.5))),
        ("speed-turn", [0.5, 0.0], (0.5, 0.0)),
        ("speed-turn", [1.0, 0.5], (math.sqrt(0.5), math.sqrt(0.5))),
        ("speed-turn", [1.0, -1.0], (0.0, -1.0)),
        ("discrete", 0, (0.0, 0.0)),
        ("discrete", 1, (0.5, 0.0)),
        ("discrete", 11, (0.0, 1.0)),
        ("discrete", 16, (math.sqrt(0.5), -math.sqrt(0.5))),
    ],
)
def test_an_action_is_a_velocity_in_the_frame_of_the_agent(action: str, given: Any, velocity: Any) -> None:
    turned = math.radians(30)
    env = throng_sim.envs.single(alone(heading=30.0), action=action)
    env.reset()
    assert env.world.headings[0] == pytest.approx(turned)
    top = env.world.max_speeds[0]
    env.step(given)
    expected = complex(*velocity) * complex(math.cos(turned), math.sin(turned)) * top
    assert env.world.velocities[0] == pytest.approx((expected.real, expected.imag), abs=1e-4)


def test_random_actions_never_make_agents_overlap() -> None:
    env = throng_sim.envs.parallel(hall(40), 1.0, model="none", limit=20.0)
    rng = np.random.default_rng(2)
    env.reset(seed=5)
    moved = 0.0
    while env.agents:
        before = env.world.positions.copy()
        env.step({agent: rng.uniform(-1, 1, 2) for agent in env.agents})
        at, radii = env.world.positions, env.world.radii
        if len(at) == len(before):
            moved += float(np.abs(at - before).sum())
        distances = np.hypot(*(at[:, None] - at[None]).transpose(2, 0, 1))
        ratio = distances / (radii[:, None] + radii[None])
        assert ratio[~np.eye(len(at), dtype=bool)].min() > 0.9999
    assert moved > 100


def test_only_agents_under_control_are_commanded_and_only_until_they_arrive() -> None:
    env = throng_sim.envs.parallel(alone(), "one")
    observations, _ = env.reset()
    rows = [not math.isnan(x) for x, _ in env.world.preferred]
    assert rows == [False]
    while env.agents:
        observations, _, arrived, _, _ = env.step({"one_0": towards(observations["one_0"])})
        commanded = not np.isnan(env.world.preferred[0]).any()
        assert commanded == bool(env.agents)
    assert arrived == {"one_0": True}
    env.world.step(200)
    assert env.world.positions[0] == pytest.approx((6, 0), abs=0.15)
    crowd = throng_sim.envs.parallel(hall(), [3, 7])
    crowd.reset()
    crowd.step({agent: [0.5, 0.0] for agent in crowd.agents})
    numbers = crowd.world.ids[~np.isnan(crowd.world.preferred).any(axis=1)]
    assert numbers.tolist() == [3, 7]


# --- rewards and ends


def test_the_reward_is_that_of_the_formula() -> None:
    scene = hall()
    reward = throng_sim.envs.Reward(progress=2.0, time=0.3, closeness=4.0, comfort=0.5, arrival=7.0)
    env = throng_sim.envs.single(scene, 13, model="orca", reward=reward)
    observation, info = env.reset(seed=1)
    before, ended, close = info["distance"], False, 0
    while not ended:
        observation, given, arrived, late, info = env.step(towards(observation))
        ended = arrived or late
        expected = 2.0 * (before - info["distance"]) - 0.3 * 0.2 + 7.0 * arrived
        row = np.flatnonzero(env.world.ids == 13)
        if len(row):
            at, radii = env.world.positions, env.world.radii
            gaps = np.delete(np.hypot(*(at - at[row[0]]).T) - radii - radii[row[0]], row[0])
            expected -= 4.0 * max(0.0, 1 - gaps.min() / 0.5) * 0.2
            close += gaps.min() < 0.5
        assert given == pytest.approx(expected, abs=1e-9)
        before = info["distance"]
    assert arrived and close and info["distance"] == 0.0


def test_a_function_replaces_the_reward() -> None:
    seen: list[throng_sim.envs.Transition] = []

    def mine(now: throng_sim.envs.Transition) -> Any:
        seen.append(now)
        return now.velocity[:, 0]

    env = throng_sim.envs.parallel(hall(), "left", reward=mine, repeat=2)
    env.reset(seed=1)
    _, rewards, *_ = env.step({agent: [1.0, 0.0] for agent in env.agents})
    (now,) = seen
    assert now.seconds == pytest.approx(0.08) and len(now.gap) == 12 and (now.gap > 0).all()
    left = env.world.velocities[env.world.groups == 0]
    assert list(rewards.values()) == pytest.approx(left[:, 0].tolist())


@pytest.mark.parametrize("limit", [3.0, 3.1, None])
def test_episodes_end_at_the_limit(limit: float | None) -> None:
    env = throng_sim.envs.single(alone(), limit=limit)
    env.reset()
    steps, late = 0, False
    while not late:
        _, _, arrived, late, info = env.step([0.0, 0.0])
        assert not arrived
        steps += 1
    assert steps == math.ceil((limit or 20.0) / 0.2 - 1e-9)
    with pytest.raises(ResetNeeded, match="call `reset` first"):
        env.step([0.0, 0.0])
    env.reset()
    env.step([0.0, 0.0])


def test_an_agent_that_leaves_by_an_exit_has_arrived() -> None:
    env = throng_sim.envs.single(hall(), 20, model="orca")
    observation, info = env.reset(seed=1)
    assert info["distance"] > 10
    arrived = late = False
    while not (arrived or late):
        observation, _, arrived, late, info = env.step(towards(observation))
    assert arrived and 20 not in env.world.ids
    assert (observation == 0).all() and observation in env.observation_space


def test_an_agent_that_the_program_removes_is_terminated() -> None:
    env = throng_sim.envs.parallel(hall(), [3, 7])
    env.reset(seed=1)
    env.world.remove(3)
    _, _, terminated, _, _ = env.step({"left_3": [1.0, 0.0], "left_7": [0.5, 0.0]})
    assert terminated == {"left_3": True, "left_7": False} and env.agents == ["left_7"]
    commanded = env.world.ids[~np.isnan(env.world.preferred).any(axis=1)]
    assert commanded.tolist() == [7]


def test_an_agent_that_arrives_between_two_actions_has_arrived() -> None:
    # 25 steps at 1.8 m/s are 1.8 m: it walks over the goal and on
    env = throng_sim.envs.single(alone(), repeat=25)
    env.reset()
    arrived = False
    for _ in range(6):
        _, _, arrived, _, _ = env.step([1.0, 0.0])
        if arrived:
            break
    assert arrived


# --- seeds


def test_a_seed_gives_the_same_bits_and_the_world_of_the_scene() -> None:
    scene = hall()
    for make in (
        lambda: throng_sim.envs.single(scene, 2),
        lambda: throng_sim.envs.parallel(scene, [2]),
    ):
        one, other = make(), make()
        one.reset(seed=77)
        assert one.world.hash() == scene.build(seed=77).hash()
        other.reset()
        assert other.world.hash() == scene.build().hash()
        hashes = []
        for env in (one, other):
            env.reset(seed=5)
            for _ in range(3):
                env.reset()
                hashes.append(env.world.hash())
        assert hashes[:3] == hashes[3:] and len(set(hashes)) == 3


def test_the_seed_of_the_environment_is_that_of_the_first_episode_and_draws_a_fraction() -> None:
    env = throng_sim.envs.parallel(hall(), 0.25, seed=31)
    env.reset()
    assert env.world.hash() == hall().build(seed=31).hash()
    chosen = {tuple(throng_sim.envs.parallel(hall(), 0.25, seed=k).possible_agents) for k in range(6)}
    assert len(chosen) > 1 and {len(set(names)) for names in chosen} == {6}
    assert env.possible_agents == throng_sim.envs.parallel(hall(), 0.25, seed=31).possible_agents


def test_names_are_groups_and_numbers() -> None:
    env = throng_sim.envs.parallel(hall(), [13, 3])
    assert env.possible_agents == ["left_3", "right_13"]


# --- pictures


def test_pictures() -> None:
    env = throng_sim.envs.parallel(hall(), "left", render_mode="rgb_array")
    env.reset()
    picture = env.render()
    assert picture.shape == (480, 640, 3) and picture.dtype == np.uint8 and len(np.unique(picture)) > 10
    envs = throng_sim.envs.vector(hall(), 2, render_mode="rgb_array")
    envs.reset()
    pictures = envs.render()
    assert pictures is not None and [picture.shape for picture in pictures] == [(480, 640, 3)] * 2
    silent = throng_sim.envs.single(hall())
    silent.reset()
    assert silent.render() is None
    check_env(gymnasium.make("throng/Crowd-v0", scene=hall(), render_mode="rgb_array").unwrapped)


# --- misuse


@pytest.mark.parametrize(
    ("call", "error", "text"),
    [
        (lambda e: e.parallel(hall(), "middle"), ValueError, "no group `middle`; there are: left, right"),
        (lambda e: e.parallel(hall(), [2, 99]), ValueError, "no agent 99"),
        (lambda e: e.parallel(hall(), [2, 2]), ValueError, "twice"),
        (lambda e: e.parallel(hall(), []), ValueError, "at least one agent"),
        (lambda e: e.parallel(hall(), 1.5), ValueError, "control is 1.5"),
        (lambda e: e.parallel(hall(), True), TypeError, "control is a bool"),
        (lambda e: e.single(hall(), 99), ValueError, "no agent 99"),
        (lambda e: e.single(hall(), "left"), TypeError, "the number of one agent; `parallel` takes more"),
        (lambda e: e.vector(hall(), 2, 0.5), TypeError, "the number of one agent"),
        (lambda e: e.single(tg.Scene()), tg.SceneError, "the scene has no agents"),
        (lambda e: e.single(hall(), action="jump"), ValueError, "there are: velocity, speed-turn, discrete"),
        (lambda e: e.single(hall(), observe="nearest"), ValueError, "give `nearest-10`, `walls-8`"),
        (lambda e: e.single(hall(), sight=0.0), ValueError, "sight is 0.0"),
        (lambda e: e.single(hall(), sight=math.nan), ValueError, "sight is nan"),
        (lambda e: e.single(hall(), repeat=0), ValueError, "repeat is 0"),
        (lambda e: e.single(hall(), threads=-1), ValueError, "threads is -1"),
        (lambda e: e.single(hall(), limit=0.0), ValueError, "limit is 0.0"),
        (lambda e: e.single(hall(), model="magic"), tg.SceneError, "magic"),
        (lambda e: e.single(hall(), render_mode="human"), ValueError, "give None or `rgb_array`"),
        (lambda e: e.single("no-such-scene"), tg.SceneError, "no-such-scene"),
        (lambda e: e.single(hall(), colour="red"), TypeError, "colour"),
        (lambda e: e.vector(hall(), 0), ValueError, "num_envs is 0"),
    ],
)
def test_wrong_options_say_what_is_right(call: Callable[[Any], Any], error: type[Exception], text: str) -> None:
    with pytest.raises(error, match=text):
        call(throng_sim.envs)


@pytest.mark.parametrize(
    ("action", "given", "text"),
    [
        ("velocity", [1.0], r"shape \(1, 1\), but must have \(1, 2\)"),
        ("velocity", 1.0, r"shape \(1,\), but must have \(1, 2\)"),
        ("velocity", [1.0, math.nan], "not finite"),
        ("velocity", [math.inf, 0.0], "not finite"),
        ("velocity", ["fast", "left"], "not numbers"),
        ("discrete", 17, "integer from 0 to 16"),
        ("discrete", -1, "integer from 0 to 16"),
        ("discrete", 1.5, "integer from 0 to 16"),
        ("discrete", [1, 2], r"shape \(1, 2\), but must have \(1,\)"),
    ],
)
def test_wrong_actions_are_refused_and_change_nothing(action: str, given: Any, text: str) -> None:
    env = throng_sim.envs.single(hall(), action=action)
    env.reset()
    before = env.world.hash()
    with pytest.raises(ValueError, match=text):
        env.step(given)
    assert env.world.hash() == before
    env.step(env.action_space.sample())


def test_wrong_actions_of_several_agents_are_refused() -> None:
    env = throng_sim.envs.parallel(hall(), [3, 13])
    with pytest.raises(ResetNeeded, match="call `reset` first"):
        env.step({})
    with pytest.raises(ResetNeeded, match="call `reset` first"):
        _ = env.world
    env.reset()
    good = {"left_3": [0.0, 0.0], "right_13": [0.0, 0.0]}
    for change, text in [
        ({"left_3": [0.0]}, r"the action of `left_3` has the shape \(1,\), but must have \(2,\)"),
        ({"right_13": [0.0, math.nan]}, "of `right_13` is not finite"),
        ({"left_4": [0.0, 0.0]}, "no agent `left_4`"),
    ]:
        with pytest.raises(ValueError, match=text):
            env.step(good | change)
    with pytest.raises(ValueError, match="no action for `right_13`"):
        env.step({"left_3": [0.0, 0.0]})
    env.step(good)
    env.close()
    with pytest.raises(ResetNeeded):
        env.step(good)


def test_actions_after_the_end_are_refused() -> None:
    env = throng_sim.envs.parallel(hall(), [13, 20], model="orca")
    observations, _ = env.reset(seed=1)
    while len(env.agents) == 2:
        observations, *_ = env.step({agent: towards(observations[agent]) for agent in env.agents})
    with pytest.raises(ValueError, match="but its episode is over"):
        env.step({agent: [0.0, 0.0] for agent in env.possible_agents})
    while env.agents:
        observations, *_ = env.step({agent: towards(observations[agent]) for agent in env.agents})
    with pytest.raises(ResetNeeded, match="call `reset` first"):
        env.step({})


def test_a_vector_needs_a_reset_and_whole_actions() -> None:
    envs = throng_sim.envs.vector(hall(), 2)
    with pytest.raises(ResetNeeded, match="call `reset` first"):
        envs.step(np.zeros((2, 2)))
    with pytest.raises(ValueError, match="3 seeds for 2 worlds"):
        envs.reset(seed=[1, 2, 3])
    envs.reset()
    with pytest.raises(ValueError, match=r"shape \(3, 2\), but must have \(2, 2\)"):
        envs.step(np.zeros((3, 2)))
    with pytest.raises(ValueError, match="of world 1 is not finite"):
        envs.step(np.array([[0.0, 0.0], [math.nan, 0.0]]))
    envs.close()
    with pytest.raises(ResetNeeded, match="call `reset` first"):
        envs.step(np.zeros((2, 2)))


@pytest.mark.parametrize(
    ("returned", "text"),
    [([1.0, 2.0], r"returned the shape \(2,\)"), ([math.nan], "infinity or NaN"), (3.0, r"shape \(\)")],
)
def test_wrong_rewards_are_refused(returned: Any, text: str) -> None:
    env = throng_sim.envs.single(hall(), reward=lambda now: returned)
    env.reset()
    with pytest.raises(ValueError, match=text):
        env.step([0.0, 0.0])


@pytest.mark.parametrize(("missing", "call"), [("gymnasium", ""), ("pettingzoo", "; e.parallel('headon', 'left')")])
def test_a_missing_package_is_named(missing: str, call: str) -> None:
    code = f"import sys; sys.modules[{missing!r}] = None\nimport throng_sim.envs as e{call}"
    ran = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert ran.returncode == 1 and "pip install 'throng-sim[env]'" in ran.stderr, ran.stderr


# --- examples


@pytest.mark.parametrize(
    "name", ["throng_sim.envs", *(f"throng_sim.envs.{m.name}" for m in pkgutil.iter_modules(throng_sim.envs.__path__))]
)
def test_the_examples_in_the_documentation_run(name: str) -> None:
    assert doctest.testmod(importlib.import_module(name)).failed == 0


def test_the_training_example_runs() -> None:
    example = Path(__file__).parent.parent / "examples" / "train.py"
    given = ["--generations", "1", "--pairs", "2", "--tests", "2"]
    ran = subprocess.run([sys.executable, str(example), *given], capture_output=True, text=True, check=False)
    assert ran.returncode == 0, ran.stderr
    assert "before" in ran.stdout and "after" in ran.stdout
