"""JuPedSim's collision-free speed model. Told by the program beside it what to do, on standard input.

Arguments: a floor plan (WKT) and the corners of the exit, x and y one after the other; or `work`, the number of warm-up
steps, the side of the exits of a reference work (0 for goals where agents stay), and the radius of the agents; without arguments,
a square with 0.5 people per m2 who walk to and fro between places along its border: JuPedSim's own work. Time steps are JuPedSim's own, 0.01 s, which it
recommends not to change.

Standard input: for each agent its position and preferred speed; for a reference work also the goal of each agent, then
rings of walls: first the boundary of the walkable area, then obstacles; two corners are a thin wall, here 0.1 m thick,
since JuPedSim has no thin walls.

A simulation cannot be copied: after a restart it goes on from where it is.
"""

import math
import random
import sys
import time
from importlib.metadata import version

import jupedsim as jps
from shapely import LineString, Polygon
from shapely.ops import unary_union

WARM_UP = 20
STEP = 0.01
RADIUS = 0.2


def read():
    """Reads a list of lines of numbers."""
    return [tuple(map(float, sys.stdin.readline().split())) for _ in range(int(sys.stdin.readline()))]


def ground(rings):
    """Returns the area within the first ring and outside of all others."""
    outer, *walls = [list(zip(ring[::2], ring[1::2])) for ring in rings]
    solid = [Polygon(wall) if len(wall) > 2 else LineString(wall).buffer(0.05, cap_style="flat") for wall in walls]
    return Polygon(outer).difference(unary_union(solid))


people = read()
if sys.argv[1:2] == ["work"]:
    WARM_UP = int(sys.argv[2])
    exit_side, RADIUS = map(float, sys.argv[3:])
    goals = read()
    geometry = ground(read())
elif len(sys.argv) > 1:
    plan, *corners = sys.argv[1:]
    with open(plan) as file:
        geometry = file.read()
else:
    side = math.sqrt(len(people) / 0.5)
    geometry = [(0, 0), (side, 0), (side, side), (0, side)]
simulation = jps.Simulation(model=jps.CollisionFreeSpeedModel(), geometry=geometry, dt=STEP)
if sys.argv[1:2] == ["work"]:

    def stage(goal):
        """Returns the stage of a goal."""
        if exit_side == 0.0:
            return simulation.add_waypoint_stage(goal, 0.5)
        half = 0.5 * exit_side
        return simulation.add_exit_stage(
            [(goal[0] + dx * half, goal[1] + dy * half) for dx, dy in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
        )

    way = {}
    for goal in dict.fromkeys(goals):
        end = stage(goal)
        way[goal] = (simulation.add_journey(jps.JourneyDescription([end])), end)
    ways = [way[goal] for goal in goals]
elif len(sys.argv) > 1:
    corners = list(map(float, corners))
    stages = [simulation.add_exit_stage(list(zip(corners[::2], corners[1::2])))]
    ways = [(simulation.add_journey(jps.JourneyDescription(stages)), stages[0])]
else:
    random.seed(1)
    around = [k / 8 for k in range(8)]
    places = [(t * side, 2) for t in around[1:]] + [(t * side, side - 2) for t in around[1:]]
    places += [(2, t * side) for t in around[1:]] + [(side - 2, t * side) for t in around[1:]]
    ways = []
    for k in range(len(places)):
        first, second = (simulation.add_waypoint_stage(places[j], 1.0) for j in (k, (k + len(places) // 2 + 3) % len(places)))
        journey = jps.JourneyDescription([first, second])
        journey.set_transition_for_stage(first, jps.Transition.create_fixed_transition(second))
        journey.set_transition_for_stage(second, jps.Transition.create_fixed_transition(first))
        ways.append((simulation.add_journey(journey), first))
    across = math.ceil(math.sqrt(len(people)))
    apart = side / across
    people = [
        tuple(apart * (at + 0.5 + random.uniform(-0.3, 0.3)) for at in (k % across, k // across)) + (1.2,)
        for k in range(len(people))
    ]
for k, (x, y, speed) in enumerate(people):
    journey, stage = ways[k % len(ways)]
    simulation.add_agent(
        jps.CollisionFreeSpeedModelAgentParameters(
            position=(x, y), journey_id=journey, stage_id=stage, radius=RADIUS, desired_speed=speed
        )
    )
simulation.iterate(WARM_UP)
print(f"JuPedSim {version('jupedsim')}, collision-free speed model", flush=True)
for line in sys.stdin:
    match line.split():
        case ["restart"]:
            print("done", flush=True)
        case ["steps", count]:
            moves, begin = 0, time.process_time()
            for _ in range(int(count)):
                moves += simulation.agent_count()
                simulation.iterate()
            took = time.process_time() - begin
            print(moves, took, int(count) * STEP, flush=True)
