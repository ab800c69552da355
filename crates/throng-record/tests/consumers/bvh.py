"""bvhio reads the people that throng wrote: python bvh.py FOLDER RUN.glb (of the same run; FOLDER has NUMBER.bvh of each person).

Every joint is compared with that of the .glb, which is computed by the specification of glTF, at some frames.
"""
import pathlib
import sys

import bvhio
import numpy as np

from skins import Skins, to_scene

skins = Skins(sys.argv[2])
files = {int(path.stem): path for path in pathlib.Path(sys.argv[1]).glob("*.bvh")}
assert set(files) == set(skins.people), (sorted(files), sorted(skins.people))
compared, worst = 0, 0
for number, path in files.items():
    container = bvhio.readAsBvh(str(path))
    root = bvhio.readAsHierarchy(str(path))
    there = [time for time in skins.times if skins.there(number, time)]
    assert container.FrameCount == len(there), (number, container.FrameCount, len(there))
    assert abs(container.FrameTime - (skins.times[-1] - skins.times[0]) / (len(skins.times) - 1)) < 1e-6
    for frame in {*range(0, len(there), max(1, len(there) // 8)), len(there) - 1}:
        root.loadPose(frame)
        want = skins.joints(number, there[frame])
        joints = {joint.Name: joint for joint, _, _ in root.layout()}
        for name, place in want.items():
            found = to_scene(np.array(joints[name].PositionWorld)) / 100
            worst = max(worst, np.linalg.norm(found - place))
            assert worst < 0.012, (number, frame, name, found, place)
            compared += 1
print(f"{len(files)} people, {compared} joints within {1e3 * worst:.1f} mm of those of the .glb")
