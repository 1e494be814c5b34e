"""Mitsuba 3 as the renderer under test: mitsuba_render.py SCENE.xml OUTPUT.pfm WIDTH HEIGHT SPP SEED FAULT"""
import sys

import mitsuba as mi
import numpy as np
from planted import Job

if sys.argv[1] == "--version":
    sys.exit(print("Mitsuba", mi.__version__))
job = Job()
mi.set_variant("scalar_rgb")
scene = mi.load_file(job.scene, width=job.width, height=job.height)
if job.fault == "light":
    parameters = mi.traverse(scene)
    key = next(name for name in parameters.keys() if name.startswith("cold") and name.endswith("radiance.value"))
    parameters[key] = mi.Color3f(0)
    parameters.update()
job.write(np.array(mi.render(scene, spp=job.spp, seed=job.seed))[:, :, :3])
