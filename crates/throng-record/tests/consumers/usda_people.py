"""USD reads the skeletons that throng wrote: python usda_people.py RUN.usda RUN.glb (of the same run).

The joints of all people, by queries of UsdSkel, and the skins of some, are compared with those of the .glb, which are computed by the
specification of glTF. The validators of USD find no errors.
"""
import sys

import numpy as np
from pxr import Gf, Usd, UsdGeom, UsdSkel, UsdValidation

from skins import Skins

stage, skins = Usd.Stage.Open(sys.argv[1]), Skins(sys.argv[2])
codes = stage.GetTimeCodesPerSecond()
roots = [UsdSkel.Root(prim) for prim in stage.Traverse() if prim.IsA(UsdSkel.Root)]
numbers = {root.GetPrim().GetAttribute("throng:number").Get(): root for root in roots}
assert set(numbers) == set(skins.people), (sorted(numbers), sorted(skins.people))
times = [*skins.times[:: max(1, len(skins.times) // 6)], skins.times[-1]]
joints, vertices, worst, farthest = 0, 0, 0, 0
for at, (number, root) in enumerate(numbers.items()):
    cache = UsdSkel.Cache()
    cache.Populate(root, Usd.PrimDefaultPredicate)
    (binding,) = cache.ComputeSkelBindings(root, Usd.PrimDefaultPredicate)
    skeleton = cache.GetSkelQuery(binding.GetSkeleton())
    (target,) = binding.GetSkinningTargets()
    mesh = UsdGeom.Mesh(target.GetPrim())
    assert target.IsRigidlyDeformed() is False and skeleton.GetAnimQuery().JointTransformsMightBeTimeVarying()
    assert mesh.GetNormalsInterpolation() == "vertex" and len(mesh.GetNormalsAttr().Get()) == len(mesh.GetPointsAttr().Get())
    assert len(UsdGeom.PrimvarsAPI(mesh).GetPrimvar("displayColor").Get()) == len(mesh.GetPointsAttr().Get())
    names = [name.rsplit("/")[-1] for name in skeleton.GetJointOrder()]
    for time in times:
        code = round(time * codes, 6)
        seen = UsdGeom.Imageable(root).ComputeVisibility(code) != "invisible"
        assert seen == skins.there(number, time), (number, time)
        if not seen:
            continue
        xforms = UsdGeom.XformCache(code)
        want = skins.joints(number, time)
        for name, placed in zip(names, skeleton.ComputeJointWorldTransforms(xforms)):
            off = np.linalg.norm(np.array(placed.ExtractTranslation()) - want[name])
            worst, joints = max(worst, off), joints + 1
            assert off < 0.012, (number, time, name, placed.ExtractTranslation(), want[name])
        if at % 10 == 0:
            points = mesh.GetPointsAttr().Get()
            assert target.ComputeSkinnedPoints(skeleton.ComputeSkinningTransforms(code), points, code)
            # a skin stands where its skeleton does
            world = xforms.GetLocalToWorldTransform(skeleton.GetPrim())
            found = np.array([world.Transform(Gf.Vec3d(point)) for point in points])
            off = np.linalg.norm(found - skins.skin(number, time), axis=1)
            farthest, vertices = max(farthest, off.max()), vertices + len(off)
            assert off.max() < 0.02, (number, time, off.argmax())
registry = UsdValidation.ValidationRegistry()
errors = UsdValidation.ValidationContext(registry.GetOrLoadAllValidators()).Validate(stage)
wrong = [error for error in errors if error.GetType() == UsdValidation.ValidationErrorType.Error]
assert not wrong, [(error.GetName(), error.GetMessage()) for error in wrong[:5]]
print(f"{len(roots)} people, {joints} joints within {1e3 * worst:.1f} mm, {vertices} vertices within {1e3 * farthest:.1f} mm of those of "
      f"the .glb; {len(errors)} remarks of validators")
