# Building blocks of the scene script below: Blender's objects, shaders and Cycles' settings. Each function states what
# it stands for in the scene's own terms; conversions of units and directions are nowhere else.
# Works with Blender 3.4 without numpy and without Open Shading Language.
import array
import math
import os
import sys

import bmesh
import bpy
from mathutils import Matrix, Vector

HERE = os.path.dirname(os.path.abspath(__file__))
SCENE = bpy.context.scene


def clear():
    """Nothing of Blender's default scene stays."""
    for data in (bpy.data.objects, bpy.data.meshes, bpy.data.lights, bpy.data.cameras, bpy.data.materials):
        for item in list(data):
            data.remove(item)
    SCENE.world = bpy.data.worlds.new("world")
    SCENE.world.use_nodes = True
    SCENE.world.node_tree.nodes.clear()


def settings(width, height, threads, bounces, filter_kind, filter_width):
    """An unbiased path tracer: nothing is clamped, cut, blurred, guided by thresholds or taken for dark."""
    render, cycles = SCENE.render, SCENE.cycles
    render.engine = "CYCLES"
    cycles.device = "CPU"
    render.resolution_x, render.resolution_y, render.resolution_percentage = width, height, 100
    render.threads_mode, render.threads = "FIXED", threads
    render.use_persistent_data = True
    render.use_compositing = render.use_sequencer = render.use_motion_blur = render.use_stamp = False
    render.film_transparent = False
    render.image_settings.file_format = "OPEN_EXR"
    render.image_settings.color_mode, render.image_settings.color_depth = "RGB", "32"
    render.image_settings.exr_codec = "ZIP"
    SCENE.view_settings.view_transform = "Raw"
    cycles.pixel_filter_type, cycles.filter_width = filter_kind, filter_width
    cycles.film_exposure = 1
    cycles.use_adaptive_sampling = cycles.use_denoising = False
    cycles.use_auto_tile = False
    cycles.sampling_pattern = "SOBOL"
    cycles.time_limit = 0
    for kind in ("max", "diffuse", "glossy", "transmission", "volume"):
        setattr(cycles, kind + "_bounces", bounces)
    cycles.transparent_max_bounces = 1024
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0
    cycles.blur_glossy = 0
    cycles.light_sampling_threshold = 0
    cycles.caustics_reflective = cycles.caustics_refractive = True
    cycles.use_fast_gi = False
    SCENE.render.use_simplify = False


def camera(kind, columns, near, far, tangents=(0, 0), middle=(0, 0), lens_radius=0, focus=1, angle=0):
    """columns: right, up, backward and place, world space. tangents: of half the image, or half its size; middle: of
    the image from the axis, in halves of it."""
    data = bpy.data.cameras.new("camera")
    data.clip_start, data.clip_end = near, far
    # Ratio of a pixel's height and width; Blender accepts aspects from 1 up.
    tall = tangents[1] * SCENE.render.resolution_x / (tangents[0] * SCENE.render.resolution_y) if angle == 0 else 1
    SCENE.render.pixel_aspect_x, SCENE.render.pixel_aspect_y = max(1, 1 / tall), max(1, tall)
    wide = SCENE.render.resolution_x >= SCENE.render.resolution_y
    larger = 0 if wide else 1
    data.sensor_fit = "HORIZONTAL" if wide else "VERTICAL"
    if kind == "fisheye":
        data.type, data.cycles.panorama_type, data.cycles.fisheye_fov = "PANO", "FISHEYE_EQUIDISTANT", angle
    elif kind == "orthographic":
        data.type, data.ortho_scale = "ORTHO", 2 * tangents[larger]
    else:
        # Blender keeps a focal length in mm; the sensor's size sets the tangent.
        data.type, data.lens_unit, data.lens = "PERSP", "MILLIMETERS", 50
        setattr(data, "sensor_width" if wide else "sensor_height", 100 * tangents[larger])
        data.shift_x = middle[0] * tangents[0] / tangents[larger] / 2
        data.shift_y = middle[1] * tangents[1] / tangents[larger] / 2
    if lens_radius > 0:
        # Cycles' lens has the radius lens / 1000 / (2 fstop), a disc where there are no blades.
        data.dof.use_dof, data.dof.focus_distance = True, focus
        data.dof.aperture_fstop, data.dof.aperture_blades = data.lens / 2000 / lens_radius, 0
    add("camera", data, columns)
    SCENE.camera = bpy.data.objects["camera"]


def add(name, data, columns):
    """An object in its place: columns x, y, z and place of its matrix."""
    thing = bpy.data.objects.new(name, data)
    SCENE.collection.objects.link(thing)
    thing.matrix_world = Matrix([[c[i] for c in columns] for i in range(3)] + [[0, 0, 0, 1]])
    return thing
