"""What Python costs: steps, reading, a model in Python, and peers on the same work.

Usage: python cost.py [PROGRAM]     (the program `throng`, built with --release, for the steps in Rust)

All on one thread. Durations of steps are the least of nine repetitions in turn, others the median of five.
"""

from __future__ import annotations

import json
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np

import throng_sim as tg


def median(work: Callable[[], None], repeat: int = 5) -> float:
    """Returns the median duration of some work, seconds."""
    spent = []
    for _ in range(repeat):
        begin = time.perf_counter()
        work()
        spent.append(time.perf_counter() - begin)
    return statistics.median(spent)


def places(n: int, seed: int = 1) -> tuple[np.ndarray, np.ndarray]:
    """Returns starts on a grid, 1 m apart, and goals on the opposite side of a square."""
    side = int(np.ceil(np.sqrt(n)))
    grid = np.stack(np.meshgrid(np.arange(side), np.arange(side)), axis=-1).reshape(-1, 2)[:n].astype(float)
    return grid, np.random.default_rng(seed).permutation(grid)


def crowd(n: int, limit: float = 1e5) -> tg.Scene:
    """Returns agents on a square who change places."""
    at, goals = places(n)
    scene = tg.Scene(dt=0.1, limit=limit)
    scene["time.until"] = "limit"
    scene.group("all", at=at, goal=goals, preset="animation", body={"radius": 0.2})
    return scene


def steps_in_rust(program: str, scene: tg.Scene, steps: int) -> float:
    """Returns the duration of a step in the program, seconds."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "crowd.toml"
        scene.save(path)
        command = [program, "run", str(path), "--no-files", "--no-expect", "--json", "--threads", "1"]
        command += ["--limit", str(steps * scene.dt)]
        report = json.loads(subprocess.run(command, capture_output=True, text=True, check=True).stdout)
    return float(report["step_seconds"]) / steps


def main() -> None:
    """Prints all figures."""
    warm, steps = 20, 20
    scene = crowd(10_000)

    def step_by_step(read: bool) -> float:
        """Returns the duration of a step in Python, seconds."""
        world = scene.build()
        world.step(warm)
        begin = time.perf_counter()
        for _ in range(steps):
            world.step()
            if read:
                np.sum(world.positions[0])
        return (time.perf_counter() - begin) / steps

    def at_once() -> float:
        world = scene.build()
        world.step(warm)
        begin = time.perf_counter()
        world.step(steps)
        return (time.perf_counter() - begin) / steps

    # other programs of the machine only slow down: the least of several alternating repetitions
    spent: dict[str, list[float]] = {"in one call": [], "each": [], "each, with positions": [], "the program": []}
    for _ in range(9):
        spent["in one call"].append(at_once())
        spent["each"].append(step_by_step(False))
        spent["each, with positions"].append(step_by_step(True))
        if len(sys.argv) > 1:
            whole = (warm + steps) * steps_in_rust(sys.argv[1], scene, warm + steps)
            spent["the program"].append((whole - warm * steps_in_rust(sys.argv[1], scene, warm)) / steps)
    least = {name: min(all) for name, all in spent.items() if all}
    for name, seconds in least.items():
        over = f": {seconds / least['the program']:.3f} times the program" if "the program" in least else ""
        print(f"10,000 agents, a step, {name}: {1e3 * seconds:.3f} ms{over}")
    reading = least["each, with positions"]

    many = crowd(100_000).build(threads=0)
    many.step()
    held = many.positions
    spent = []
    for _ in range(5):
        many.step()
        # a change of one agent writes all arrays anew that exist: the positions
        begin = time.perf_counter()
        many.push(0, (0.0, 0.0))
        spent.append(time.perf_counter() - begin)
    print(f"100,000 agents, reading positions: {1e3 * statistics.median(spent):.3f} ms ({held.nbytes} bytes)")

    inside = [0.0, 0]

    def push(view: tg.View) -> np.ndarray:
        near = view.near
        away = near.offsets / (near.distances**2)[:, None]
        return view.preferred - 0.1 * view.sum(away)

    def timed(view: tg.View) -> np.ndarray:
        begin = time.perf_counter()
        chosen = push(view)
        inside[0] += time.perf_counter() - begin
        inside[1] += 1
        return chosen

    # the model `none` of the engine does the same as an empty one in Python
    for sub_steps in (1, 2):
        thousand = crowd(1_000)
        thousand["time.sub_steps"] = sub_steps
        around = {}
        for name, model in (("empty", tg.model(lambda view: view.preferred)), ("none", "none")):
            world = thousand.build(model=model)
            world.step(warm)
            around[name] = median(lambda world=world: world.step(20)) / 20
        world = thousand.build(model=tg.model(timed))
        world.step(warm)
        inside[:] = [0.0, 0]
        world.step(40)
        call = 1e3 * inside[0] / 40
        between = 1e3 * (around["empty"] - around["none"])
        print(f"1,000 agents, {sub_steps} sub-steps: a model in Python takes {call:.3f} ms a step, calling it {between:.3f} ms more")

    peers(warm, steps, reading)


def peers(warm: int, steps: int, ours: float) -> None:
    """Prints the duration of a step of other simulators, with positions read in every step."""
    at, goals = places(10_000)
    try:
        import pyrvo
    except ImportError:
        print("pyrvo is not installed")
    else:
        sim = pyrvo.RVOSimulator(0.1, 10.0, 10, 2.0, 2.0, 0.2, 1.8)
        for x, y in at:
            sim.add_agent((x, y))
        wanted = goals

        def round_rvo() -> np.ndarray:
            here = np.array([sim.get_agent_position(k).to_tuple() for k in range(len(at))])
            way = wanted - here
            way *= 1.3 / np.maximum(np.linalg.norm(way, axis=1, keepdims=True), 1.3)
            for k, (x, y) in enumerate(way):
                sim.set_agent_pref_velocity(k, (x, y))
            sim.do_step()
            return here

        for _ in range(warm):
            round_rvo()
        spent = median(lambda: [round_rvo() for _ in range(steps)], 1) / steps  # type: ignore[func-returns-value]
        print(f"pyrvo, 10,000 agents: {1e3 * spent:.3f} ms a step with positions: {spent / ours:.1f} times ours")
    try:
        import jupedsim
    except ImportError:
        print("jupedsim is not installed")
    else:
        import shapely

        ground = shapely.box(-5, -5, 105, 105)
        sim = jupedsim.Simulation(model=jupedsim.CollisionFreeSpeedModel(), geometry=ground, dt=0.1)
        exits = [sim.add_exit_stage(shapely.box(x, y, x + 1, y + 1)) for x, y in ((-4, -4), (103, -4), (-4, 103), (103, 103))]
        journeys = [sim.add_journey(jupedsim.JourneyDescription([stage])) for stage in exits]
        for k, (x, y) in enumerate(at):
            sim.add_agent(
                jupedsim.CollisionFreeSpeedModelAgentParameters(
                    position=(x, y), journey_id=journeys[k % 4], stage_id=exits[k % 4], desired_speed=1.3, radius=0.2
                )
            )

        def round_jps() -> np.ndarray:
            sim.iterate()
            return np.array([agent.position for agent in sim.agents()])

        for _ in range(3):
            round_jps()
        spent = median(lambda: [round_jps() for _ in range(5)], 1) / 5  # type: ignore[func-returns-value]
        print(f"jupedsim, 10,000 agents: {1e3 * spent:.3f} ms a step with positions: {spent / ours:.1f} times ours")


if __name__ == "__main__":
    main()
