"""PedPy and `throng measure` agree within 1 % on a run of throng: density, speed, acceleration, flow, and both of Voronoi cells.

    pip install pedpy
    python pedpy_agrees.py ../../../../target/release/throng
"""

import csv
import json
import pathlib
import subprocess
import sys
import tempfile

import pandas
import pedpy

program = pathlib.Path(sys.argv[1]).resolve()
folder = pathlib.Path(tempfile.mkdtemp())
rate, cut_off, moment = 25, 1.0, 20.0


def throng(*arguments):
    return subprocess.run([program, *arguments], cwd=folder, check=True, capture_output=True, text=True).stdout


throng("run", "doorway", "-o", "run.csv", "-q", "--no-expect", "--duration", "40")
asked = ["--area=-3,-1.5,2.5,3", "--line=0,-0.5,0,0.5", f"--cut-off={cut_off}"]
ours = json.loads(throng("measure", "run.csv", *asked, "--json", "-o", "moments.csv"))["people"]
with open(folder / "moments.csv") as file:
    moments = list(csv.DictReader(file))

rows = pandas.read_csv(folder / "run.csv").rename(columns={"number": "id"})
rows["frame"] = (rows.time * rate).round().astype(int)
traj = pedpy.TrajectoryData(data=rows[["id", "frame", "x", "y"]], frame_rate=rate)
area = pedpy.MeasurementArea([(-3, -1.5), (-0.5, -1.5), (-0.5, 1.5), (-3, 1.5)])
line = pedpy.MeasurementLine([(0, -0.5), (0, 0.5)])
ground = pedpy.WalkableArea([(-50, -50), (50, -50), (50, 50), (-50, 50)])
one_sided = pedpy.SpeedCalculation.BORDER_SINGLE_SIDED
speed = pedpy.compute_individual_speed(traj_data=traj, frame_step=5, speed_calculation=one_sided)
acceleration = pedpy.compute_individual_acceleration(traj_data=traj, frame_step=5)
density = pedpy.compute_classic_density(traj_data=traj, measurement_area=area)
area_speed = pedpy.compute_mean_speed_per_frame(traj_data=traj, individual_speed=speed, measurement_area=area)
cells = pedpy.compute_individual_voronoi_polygons(
    traj_data=traj, walkable_area=ground, cut_off=pedpy.Cutoff(radius=cut_off, quad_segments=3)
)
voronoi, inside = pedpy.compute_voronoi_density(individual_voronoi_data=cells, measurement_area=area)
voronoi_speed = pedpy.compute_voronoi_speed(
    traj_data=traj, individual_speed=speed, individual_voronoi_intersection=inside, measurement_area=area
)
# PedPy leaves out movements that end with the last frame: a frame in which all agents stand makes it the last but one
after = rows[rows.frame == rows.frame.max()].assign(frame=rows.frame.max() + 1)
longer = pedpy.TrajectoryData(data=pandas.concat([rows, after])[["id", "frame", "x", "y"]], frame_rate=rate)
n_t, crossings = pedpy.compute_n_t(traj_data=longer, measurement_line=line)
frames = crossings.frame.sort_values()


def mean(column):
    values = [float(row[column] or 0) for row in moments]
    return sum(values) / len(values)


def at(table, column):
    return float(table[table.frame == moment * rate][column].iloc[0])


(then,) = [row for row in moments if abs(float(row["time"]) - moment) < 1e-6]
pairs = {
    "speed": (ours["speed"]["mean"], speed.speed.mean()),
    "acceleration": (ours["acceleration"]["mean"], acceleration.acceleration.mean()),
    "density": (mean("density"), density.density.mean()),
    "speed in the area": (mean("area_speed"), area_speed.speed.mean()),
    "Voronoi density": (mean("voronoi_density"), voronoi.density.mean()),
    "Voronoi speed": (mean("voronoi_speed"), voronoi_speed.speed.mean()),
    "Voronoi density at a moment": (float(then["voronoi_density"]), at(voronoi, "density")),
    "N at a moment": (int(then["crossed"]), at(n_t, "cumulative_pedestrians")),
    "crossed": (ours["lines"][0]["crossed"], len(crossings)),
    "flow": (ours["lines"][0]["flow"], (len(frames) - 1) * rate / (frames.iloc[-1] - frames.iloc[0])),
}
for name, (found, theirs) in pairs.items():
    print(f"{name:28} {found:10.5f} {theirs:10.5f} {100 * (found / theirs - 1):+.4f} %")
sys.exit(any(abs(found / theirs - 1) > 0.01 for found, theirs in pairs.values()))
