"""USD reads what throng wrote: python usda.py RUN.usda RUN.csv [AGAIN.usda] (of the same run); writes it again as AGAIN.usda."""
import csv
import math
import sys

from pxr import Gf, Usd, UsdGeom

stage = Usd.Stage.Open(sys.argv[1])
rows = list(csv.DictReader(open(sys.argv[2], newline="")))
assert UsdGeom.GetStageUpAxis(stage) == "Z" and UsdGeom.GetStageMetersPerUnit(stage) == 1
codes = stage.GetTimeCodesPerSecond()
agents = UsdGeom.PointInstancer(stage.GetPrimAtPath("/World/Agents"))
assert agents and len(agents.GetPrototypesRel().GetTargets()) > 0
origin = stage.GetPrimAtPath("/World").GetAttribute("xformOp:translate").Get()
ids = list(agents.GetIdsAttr().Get())
slot = {number: k for k, number in enumerate(ids)}
times = agents.GetPositionsAttr().GetTimeSamples()
moments = {}
for row in rows:
    moments.setdefault(round(float(row["time"]) * codes, 6), []).append(row)
assert all(time in times for time in moments), "moments are missing"
compared = 0
for time in times[:: max(1, len(times) // 50)]:
    positions, gone = agents.GetPositionsAttr().Get(time), set(agents.GetInvisibleIdsAttr().Get(time))
    velocities, turns = agents.GetVelocitiesAttr().Get(time), agents.GetOrientationsAttr().Get(time)
    there = moments.get(time, [])
    assert {int(row["number"]) for row in there} == set(ids) - gone, time
    mask = agents.ComputeMaskAtTime(time)
    assert sum(mask) == len(there) if mask else len(there) == len(ids)
    for row in there:
        k = slot[int(row["number"])]
        place = [positions[k][a] + origin[a] for a in range(3)]
        want = [float(row["x"]), float(row["y"]), float(row.get("z", 0))]
        assert math.dist(place, want) < 2e-4, (time, row, place)
        assert math.dist(velocities[k][:2], (float(row["vx"]), float(row["vy"]))) < 1e-3
        ahead = Gf.Quatd(turns[k]).GetNormalized().Transform(Gf.Vec3d(1, 0, 0))
        off = (math.atan2(ahead[1], ahead[0]) - float(row["heading"]) + math.pi) % (2 * math.pi) - math.pi
        # for an agent that flies steeply, a small rotation is a large one along the ground
        assert abs(off) * math.hypot(ahead[0], ahead[1]) < math.radians(0.15), (time, row, ahead)
        compared += 1
if len(sys.argv) > 3:
    stage.Export(sys.argv[3])
box = UsdGeom.BBoxCache(times[0], ["default"]).ComputeWorldBound(stage.GetPrimAtPath("/World")).ComputeAlignedRange()
assert not box.IsEmpty()
print(f"{len(ids)} agents, {len(times)} samples, {codes:g} a second, {compared} places equal, bounds {box}, "
      f"{len(open(sys.argv[1]).read()) / len(rows):.1f} bytes an agent-frame")
