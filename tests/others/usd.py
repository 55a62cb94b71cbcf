"""Skins a .usda with usd-core's own UsdSkel and compares every vertex at ten of its keys with point caches of the same rigs, one after
the other. Every texture that it names must be there.

Usage: python usd.py file.usda rig.npy...
"""
import os
import sys
import numpy as np
from pxr import Gf, Usd, UsdGeom, UsdShade, UsdSkel, UsdValidation
from compare import judge, read_cache, ten_of

stage = Usd.Stage.Open(sys.argv[1])
caches = [read_cache(path)[0] for path in sys.argv[2:]]
meshes = [p for p in stage.Traverse() if p.IsA(UsdGeom.Mesh)]
times = stage.GetStartTimeCode(), stage.GetEndTimeCode()
complaints = UsdValidation.ValidationContext(UsdValidation.ValidationRegistry().GetOrLoadAllValidators()).Validate(stage)
for complaint in complaints:
    print(complaint.GetErrorAsString())
textures = [i.Get() for p in stage.Traverse() if p.IsA(UsdShade.Shader) for i in UsdShade.Shader(p).GetInputs() if i.GetBaseName() == 'file']
assert all(t.resolvedPath for t in textures), f'textures are missing: {textures}'
assert UsdSkel.BakeSkinning(stage.Traverse(), Gf.Interval(*times)), 'UsdSkel cannot skin it'


def points_at(mesh, time):
    points = np.array(UsdGeom.Mesh(mesh).GetPointsAttr().Get(time), float)
    place = np.array(UsdGeom.Xformable(mesh).ComputeLocalToWorldTransform(time))
    return points @ place[:3, :3] + place[3, :3]


# UsdSkel's scales are of half precision: 11 bits.
scaled = any(UsdSkel.Animation(p).GetScalesAttr().ValueMightBeTimeVarying() for p in stage.Traverse() if p.IsA(UsdSkel.Animation))
off = 0.0
for key in ten_of(len(caches[0])):
    time = times[0] + (times[1] - times[0]) * key / (len(caches[0]) - 1)
    points = np.concatenate([points_at(mesh, time) for mesh in meshes])
    expected = np.concatenate([cache[key] for cache in caches])
    assert points.shape == expected.shape, f'expected {len(expected)} vertices, got {len(points)}'
    off = max(off, float(np.linalg.norm(points - expected, axis=1).max()))
print(f'UsdGeom says: {UsdGeom.GetStageUpAxis(stage)} up, {UsdGeom.GetStageMetersPerUnit(stage)} m a unit;', len(textures), 'textures')
who = 'usd-core ' + '.'.join(str(n) for n in Usd.GetVersion()) + (', scaled bones' if scaled else '')
bad = len(complaints) > 0 or judge(who, off, caches[0], 2.0**-11 if scaled else 1e-5)
sys.stdout.flush()
os._exit(bad)  # at once: threads of usd-core that still free the stage have ended an exit with "pure virtual method called"
