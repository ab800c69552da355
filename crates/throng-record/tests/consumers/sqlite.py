"""JuPedSim and PedPy read what throng wrote: python sqlite.py RUN.sqlite RUN.csv (of the same run)."""
import csv
import pathlib
import sys

import jupedsim
import pedpy

path = pathlib.Path(sys.argv[1])
rows = list(csv.DictReader(open(sys.argv[2], newline="")))
times = sorted({float(row["time"]) for row in rows})
frames = {time: frame for frame, time in enumerate(times)}
want = {(frames[float(row["time"])], int(row["number"])): (float(row["x"]), float(row["y"])) for row in rows}

trajectory = pedpy.load_trajectory_from_jupedsim_sqlite(trajectory_file=path)
data = trajectory.data
assert len(data) == len(want), (len(data), len(want))
found = {(f, i): (x, y) for f, i, x, y in zip(data.frame, data.id, data.x, data.y)}
assert found == want
area = pedpy.load_walkable_area_from_jupedsim_sqlite(trajectory_file=path)

recording = jupedsim.Recording(str(path))
assert recording.fps == trajectory.frame_rate and recording.num_frames >= len(times)
middle = recording.frame(len(times) // 2)
assert {(a.id, tuple(a.position)) for a in middle.agents} == {
    (i, p) for (f, i), p in want.items() if f == len(times) // 2
}
print(f"{len(want)} rows equal, {trajectory.frame_rate:g} frames/s, {recording.num_frames} frames, "
      f"walkable {area.area:.2f} m2, {path.stat().st_size / len(want):.1f} bytes a row, bounds {recording.bounds()}")
