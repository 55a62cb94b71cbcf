"""Skins a .usda with usd-core's own UsdSkel and compares every vertex at ten of its keys with point caches of the same rigs.

Usage: python usd.py file.usda rig.pc2...
"""
import sys
import numpy as np
from pxr import Gf, Usd, UsdGeom, UsdSkel, UsdValidation
from compare import judge, read_cache, ten_of

stage = Usd.Stage.Open(sys.argv[1])
caches = [read_cache(path) for path in sys.argv[2:]]
meshes = [p for p in stage.Traverse() if p.IsA(UsdGeom.Mesh)]
times = stage.GetStartTimeCode(), stage.GetEndTimeCode()
complaints = UsdValidation.ValidationContext(UsdValidation.ValidationRegistry().GetOrLoadAllValidators()).Validate(stage)
for complaint in complaints:
    print(complaint.GetErrorAsString())
assert UsdSkel.BakeSkinning(stage.Traverse(), Gf.Interval(*times)), 'UsdSkel cannot skin it'
assert len(meshes) == len(caches), f'expected {len(caches)} meshes, got {len(meshes)}'

off = 0.0
for mesh, (cache, _) in zip(meshes, caches):
    for key in ten_of(len(cache)):
        time = times[0] + (times[1] - times[0]) * key / (len(cache) - 1)
        points = np.array(UsdGeom.Mesh(mesh).GetPointsAttr().Get(time), float)
        world = np.array(UsdGeom.Xformable(mesh).ComputeLocalToWorldTransform(time))
        off = max(off, float(np.linalg.norm(points @ world[:3, :3] + world[3, :3] - cache[key], axis=1).max()))
print('UsdGeom says:', UsdGeom.GetStageUpAxis(stage), 'up,', UsdGeom.GetStageMetersPerUnit(stage), 'm a unit')
sys.exit(len(complaints) > 0 or judge('usd-core ' + '.'.join(str(n) for n in Usd.GetVersion()), off, caches[0][0]))
