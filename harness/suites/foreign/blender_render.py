"""Cycles, by Blender's Python module, as the renderer under test.

  blender_render.py SCENE.json OUTPUT.pfm WIDTH HEIGHT SPP SEED FAULT
"""
import json
import math
import os
import sys
import tempfile

import bpy
import numpy as np
from mathutils import Vector
from planted import Job

if sys.argv[1] == "--version":
    sys.exit(print("Blender", bpy.app.version_string))


def add(data, name, at):
    thing = bpy.data.objects.new(name, data)
    thing.location = at
    bpy.context.scene.collection.objects.link(thing)
    return thing


def diffuse(colour):
    material = bpy.data.materials.new("diffuse")
    material.use_nodes = True
    nodes = material.node_tree.nodes
    nodes.clear()
    bsdf, out = nodes.new("ShaderNodeBsdfDiffuse"), nodes.new("ShaderNodeOutputMaterial")
    bsdf.inputs["Color"].default_value = (*colour, 1)
    material.node_tree.links.new(bsdf.outputs[0], out.inputs["Surface"])
    return material


def build(scene, wanted, fault):
    for ball in wanted["balls"]:
        bpy.ops.mesh.primitive_uv_sphere_add(segments=64, ring_count=32, radius=ball["radius"], location=ball["at"])
        bpy.context.object.data.materials.append(diffuse(ball["colour"]))
    for light in wanted["lights"]:
        if fault == "light" and light["name"] == "cold":
            continue
        data = bpy.data.lights.new(light["name"], "POINT")
        data.energy, data.color, data.shadow_soft_size = max(light["watts"]), [w / max(light["watts"]) for w in light["watts"]], light["radius"]
        add(data, light["name"], light["at"])
    view = wanted["camera"]
    camera = add(bpy.data.cameras.new("camera"), "camera", view["from"])
    camera.data.angle = math.radians(view["fov"])
    camera.rotation_euler = (Vector(view["to"]) - Vector(view["from"])).to_track_quat("-Z", "Y").to_euler()
    scene.camera = camera
    scene.world = bpy.data.worlds.new("sky")
    scene.world.use_nodes = True
    scene.world.node_tree.nodes["Background"].inputs["Color"].default_value = (*wanted["sky"], 1)


def render(scene, job):
    scene.render.engine = "CYCLES"
    scene.cycles.samples, scene.cycles.seed = job.spp, job.seed
    scene.cycles.use_adaptive_sampling = scene.cycles.use_denoising = False
    scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = job.width, job.height, 100
    scene.render.threads_mode, scene.render.threads = "FIXED", 1
    scene.render.image_settings.file_format, scene.render.image_settings.color_depth = "OPEN_EXR", "32"
    with tempfile.TemporaryDirectory() as folder:
        scene.render.filepath = os.path.join(folder, "image.exr")
        bpy.ops.render.render(write_still=True)
        pixels = np.array(bpy.data.images.load(scene.render.filepath).pixels[:], dtype=np.float32)
    return pixels.reshape(job.height, job.width, 4)[::-1, :, :3]


job = Job()
bpy.ops.wm.read_factory_settings(use_empty=True)
build(bpy.context.scene, json.load(open(job.scene)), job.fault)
job.write(render(bpy.context.scene, job))
