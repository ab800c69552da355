"""RVO2, through pyrvo, on the reference work. Told by the program beside it what to do, on standard input.

Everybody's wish is set once: goals are so far away that it hardly changes, and setting it takes longer than a third of
a step. So what is measured is RVO2's step alone.
"""

import math
import sys
import time
from importlib.metadata import version

from pyrvo import RVOSimulator

WARM_UP = 20
STEP = 0.1

people = [tuple(map(float, sys.stdin.readline().split())) for _ in range(int(sys.stdin.readline()))]
# neighbour distance, most neighbours, time horizons for others and walls, radius, greatest speed
simulator = RVOSimulator(STEP, 5.0, 10, 2.0, 2.0, 0.25, 2.0)
for agent, (x, y, goal_x, goal_y, speed) in enumerate(people):
    simulator.add_agent((x, y))
    away = math.hypot(goal_x - x, goal_y - y)
    simulator.set_agent_pref_velocity(agent, ((goal_x - x) / away * speed, (goal_y - y) / away * speed))
for _ in range(WARM_UP):
    simulator.do_step()
warm = [
    tuple((v.x, v.y) for v in (simulator.get_agent_position(agent), simulator.get_agent_velocity(agent)))
    for agent in range(len(people))
]
print(f"pyrvo {version('pyrvo')}, step alone", flush=True)
for line in sys.stdin:
    match line.split():
        case ["restart"]:
            for agent, (position, velocity) in enumerate(warm):
                simulator.set_agent_position(agent, position)
                simulator.set_agent_velocity(agent, velocity)
            print("done", flush=True)
        case ["steps", count]:
            begin = time.process_time()
            for _ in range(int(count)):
                simulator.do_step()
            took = time.process_time() - begin
            print(int(count) * len(people), took, int(count) * STEP, flush=True)
