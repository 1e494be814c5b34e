#!/usr/bin/env python3
"""Writes scenes in the words of Mitsuba 0.6: every plugin of its manual with each of its parameters, a file a pair.

    python3 harness/oracles/old_scenes.py FOLDER && harness/oracles/census.sh FOLDER

Values are plausible, and pictures mean nothing: the scenes show which words load.
"""
import sys
from pathlib import Path

from mitsuba_scene_parts import boolean as flag
from mitsuba_scene_parts import integer as whole
from mitsuba_scene_parts import number, value, write_obj, write_ply, write_png, write_scenes, write_serialized
from mitsuba_scene_parts import string as word


def spectrum(name, v):
    return value("spectrum", name, v)


def rgb(name):
    return value("rgb", name, "0.3, 0.2, 0.1")


def point(name, y=0.2):
    return f'<point name="{name}" x="0" y="{y}" z="0"/>'


def vector(name, y=-1):
    return f'<vector name="{name}" x="0.1" y="{y}" z="0.2"/>'


def checks(name):
    return f'<texture type="checkerboard" name="{name}"/>'


MOVE = '<transform name="toWorld"><translate x="1"/></transform>'
TURN = '<transform name="toWorld"><rotate y="1" angle="20"/></transform>'
FLIP = flag("flipNormals")
IORS = [word("intIOR", "water"), number("intIOR", 1.4), word("extIOR", "air")]
MIRROR, THROUGH, DIFFUSE = spectrum("specularReflectance", 0.2), spectrum("specularTransmittance", 0.8), rgb("diffuseReflectance")
DISTRIBUTIONS = [word("distribution", name) for name in ("beckmann", "ggx", "phong", "as")]
ALPHA, ALPHAS = number("alpha", 0.2), number("alphaU", 0.2) + number("alphaV", 0.1)
BASE, COAT = '<bsdf type="diffuse"/>', '<bsdf type="plastic"/>'
LAYER = [number("thickness", 2), spectrum("sigmaA", 0.1), MIRROR]
CROP = whole("cropOffsetX", 2) + whole("cropOffsetY", 2) + whole("cropWidth", 4) + whole("cropHeight", 4)
WEIGHT = number("samplingWeight", 1)
DAY = whole("year", 2012) + whole("month", 7) + whole("day", 9) + number("hour", 12) + number("minute", 3) + number("second", 1)
PLACE = number("latitude", 30) + number("longitude", 20) + number("timezone", 2)
SKY = [number("turbidity", 4), spectrum("albedo", 0.2), DAY, PLACE, vector("sunDirection", 1), number("stretch", 1),
       whole("resolution", 256), WEIGHT, TURN]
PATHS = [whole("maxDepth", 5), whole("rrDepth", 5), flag("strictNormals"), flag("hideEmitters")]
PROGRESSIVE = [whole("maxDepth", 5), whole("photonCount", 250000), number("initialRadius", 0), number("alpha", 0.7),
               whole("granularity", 0), whole("rrDepth", 5), whole("maxPasses", 10)]
INNER = '<integrator type="path"/>'
SIZE = whole("width", 16) + whole("height", 12)

PLUGINS = {
    "shape": {
        "cube": [MOVE, FLIP], "sphere": [point("center"), number("radius", 0.5), MOVE, FLIP],
        "cylinder": [point("p0"), point("p1", 1), number("radius", 0.5), FLIP, MOVE], "rectangle": [MOVE, FLIP],
        "disk": [MOVE, FLIP],
        "obj": [flag("faceNormals"), number("maxSmoothAngle", 30), FLIP, flag("flipTexCoords"), MOVE, flag("collapse")],
        "ply": [flag("faceNormals"), number("maxSmoothAngle", 30), FLIP, MOVE, flag("srgb")],
        "serialized": [whole("shapeIndex", 1), flag("faceNormals"), number("maxSmoothAngle", 30), FLIP, MOVE]},
    "bsdf": {
        "diffuse": [spectrum("reflectance", 0.5), rgb("reflectance"), '<srgb name="reflectance" value="#6d7185"/>',
                    '<spectrum name="reflectance" value="400:0.5, 600:0.2, 700:0.1"/>',
                    '<srgb name="diffuseReflectance" value="0.4 0.3 0.2"/>', checks("reflectance")],
        "roughdiffuse": [rgb("reflectance"), number("alpha", 0.3), flag("useFastApprox")],
        "dielectric": [*IORS, MIRROR, THROUGH], "thindielectric": [*IORS, MIRROR, THROUGH],
        "roughdielectric": [*DISTRIBUTIONS, ALPHA, ALPHAS, *IORS, flag("sampleVisible"), MIRROR, THROUGH],
        "conductor": [word("material", "Cu"), spectrum("eta", 0.2) + spectrum("k", 3), word("extEta", "air"),
                      number("extEta", 1.3), MIRROR],
        "roughconductor": [*DISTRIBUTIONS, ALPHA, ALPHAS, word("material", "Al"), number("extEta", 1.1),
                           flag("sampleVisible"), MIRROR],
        "plastic": [*IORS, MIRROR, DIFFUSE, flag("nonlinear")],
        "roughplastic": [*DISTRIBUTIONS, ALPHA, *IORS, MIRROR, DIFFUSE, flag("nonlinear"), flag("sampleVisible"),
                         checks("alpha")],
        "coating": [p + BASE for p in [*IORS, *LAYER]],
        "roughcoating": [p + BASE for p in [*DISTRIBUTIONS, ALPHA, *IORS, *LAYER]],
        "bumpmap": [BASE + '<texture type="checkerboard"/>',
                    BASE + '<texture type="scale">' + number("scale", 10) + '<texture type="checkerboard"/></texture>'],
        "phong": [number("exponent", 20), MIRROR, DIFFUSE],
        "ward": [word("variant", "balanced"), ALPHAS, MIRROR, DIFFUSE],
        "mixturebsdf": [word("weights", "0.7, 0.3") + BASE + COAT],
        "blendbsdf": [number("weight", 0.8) + BASE + COAT, checks("weight") + BASE + COAT],
        "mask": [p + BASE for p in (number("opacity", 0.3), rgb("opacity"), spectrum("opacity", 0.4), checks("opacity"), "")],
        "twosided": [BASE, BASE + COAT], "difftrans": [spectrum("transmittance", 0.4)],
        "hk": [rgb("sigmaS"), number("thickness", 1)],
        "normalmap": [BASE + '<texture type="bitmap">' + word("filename", "t.png") + number("gamma", 1) + "</texture>"]},
    "texture": {
        "bitmap": [*(word("wrapMode", w) for w in ("repeat", "mirror", "clamp", "zero", "one")), word("wrapModeU", "clamp"),
                   number("gamma", 2.2), number("gamma", -1), number("gamma", 1),
                   *(word("filterType", w) for w in ("ewa", "trilinear", "nearest")), number("maxAnisotropy", 10),
                   flag("cache"), number("uoffset", 0.1), number("vscale", 3), word("channel", "r")],
        "checkerboard": [rgb("color0"), spectrum("color1", 0.3), number("uscale", 4) + number("vscale", 4)],
        "gridtexture": [rgb("color0"), number("lineWidth", 0.02), number("uscale", 4)],
        "scale": [number("scale", 0.5) + '<texture type="checkerboard"/>', rgb("scale") + '<texture type="checkerboard"/>'],
        "vertexcolors": [""], "wireframe": [number("lineWidth", 0.1)]},
    "emitter": {
        "point": [MOVE, point("position"), spectrum("intensity", 3), WEIGHT],
        "spot": [MOVE, rgb("intensity"), number("cutoffAngle", 30), number("cutoffAngle", 30) + number("beamWidth", 10),
                 checks("texture"), WEIGHT],
        "directional": [TURN, vector("direction"), spectrum("irradiance", 2)], "collimated": [MOVE, spectrum("power", 1)],
        "sky": [*SKY, number("scale", 2)], "sun": [*SKY[:5], number("scale", 2), number("sunRadiusScale", 1)],
        "sunsky": [*SKY, number("sunScale", 2), number("skyScale", 2), number("sunRadiusScale", 1)],
        "envmap": [number("scale", 2), TURN, number("gamma", 1), flag("cache"), WEIGHT],
        "constant": [spectrum("radiance", 1), WEIGHT, '<blackbody name="radiance" temperature="5000K" scale="1e-3"/>']},
    "medium": {
        "homogeneous": [rgb("sigmaS") + rgb("sigmaA"), rgb("sigmaT") + rgb("albedo"), number("scale", 2),
                        word("material", "skin1"), '<phase type="hg">' + number("g", 0.3) + "</phase>"],
        "heterogeneous": [word("method", "woodcock")]},
    "sensor": {
        "perspective": [MOVE, word("focalLength", "35mm"), number("fov", 40), number("fov", 40) + word("fovAxis", "Smaller"),
                        number("shutterOpen", 0) + number("shutterClose", 1), number("nearClip", 0.1) + number("farClip", 99),
                        number("focusDistance", 3), number("principalPointOffsetX", 0.1)],
        "thinlens": [number("apertureRadius", 0.1) + p for p in (MOVE, number("fov", 40), number("focusDistance", 3))],
        "orthographic": [MOVE, number("nearClip", 0.1)], "telecentric": [number("apertureRadius", 0.1)], "spherical": [MOVE]},
    "integrator": {
        "ao": [whole("shadingSamples", 4), number("rayLength", -1)],
        "direct": [whole("shadingSamples", 4), whole("emitterSamples", 2) + whole("bsdfSamples", 1),
                   whole("luminaireSamples", 2), flag("strictNormals"), flag("hideEmitters")],
        "path": PATHS, "volpath_simple": PATHS, "volpath": PATHS,
        "bdpt": [whole("maxDepth", 5), flag("lightImage"), flag("sampleDirect"), whole("rrDepth", 5)],
        "photonmapper": [whole("directSamples", 16), whole("glossySamples", 32), whole("maxDepth", 5),
                         whole("globalPhotons", 250000), whole("causticPhotons", 250000), whole("volumePhotons", 250000),
                         number("globalLookupRadius", 0.05), number("causticLookupRadius", 0.01), whole("lookupSize", 120),
                         whole("granularity", 0), flag("hideEmitters"), whole("rrDepth", 5)],
        "ppm": PROGRESSIVE, "sppm": PROGRESSIVE,
        "pssmlt": [flag("bidirectional"), whole("directSamples", 16), whole("luminanceSamples", 1000), flag("twoStage"),
                   number("pLarge", 0.3)],
        "mlt": [flag("lensPerturbation"), number("lambda", 50)], "erpt": [number("numChains", 1)],
        "ptracer": [whole("maxDepth", 5), whole("rrDepth", 5), whole("granularity", 2000), flag("bruteForce")],
        "adaptive": [number("maxError", 0.05) + INNER], "vpl": [whole("shadowMapResolution", 512), number("clamping", 0.1)],
        "irrcache": [number("quality", 1) + INNER],
        "multichannel": [INNER + '<integrator type="field">' + word("field", "shNormal") + "</integrator>"],
        "field": [word("field", "distance")]},
    "sampler": {name: [whole("sampleCount", 16), whole("dimension", 4), whole("scramble", -1)]
                for name in ("independent", "stratified", "ldsampler", "halton", "hammersley", "sobol")},
    "film": {
        "hdrfilm": [SIZE + p for p in (
            "", word("fileFormat", "openexr"), word("fileFormat", "rgbe"), word("fileFormat", "pfm"),
            word("pixelFormat", "luminance"), word("pixelFormat", "rgba"), word("pixelFormat", "spectrumAlpha"),
            word("componentFormat", "float16"), word("componentFormat", "uint32"), CROP, flag("attachLog"), flag("banner"),
            flag("highQualityEdges"))],
        "tiledhdrfilm": [word("pixelFormat", "rgb")],
        "ldrfilm": [word("fileFormat", "jpeg"), word("pixelFormat", "rgb"), word("tonemapMethod", "reinhard"),
                    number("gamma", -1), number("exposure", 0), number("key", 0.18), number("burn", 0), flag("banner"),
                    flag("highQualityEdges"), CROP],
        "mfilm": [word("fileFormat", "numpy"), whole("digits", 4), word("variable", "data"), word("pixelFormat", "luminance")]},
    "rfilter": {"box": [number("radius", 0.5)], "tent": [number("radius", 1)], "gaussian": [number("stddev", 0.5)],
                "mitchell": [number("B", 0.3) + number("C", 0.3)], "catmullrom": [""], "lanczos": [whole("lobes", 3)]}}
FILES = {"obj": "m.obj", "ply": "m.ply", "serialized": "m.serialized", "bitmap": "t.png", "envmap": "t.png"}


def scene(kind, name, content):
    """A scene in which the plugin is where it belongs."""
    if name in FILES:
        content = word("filename", FILES[name]) + content

    def own(tag, other="", attribute=""):
        return f'<{tag} type="{name}"{attribute}>{content}</{tag}>' if tag == kind else other

    film = own("film", f'<film type="hdrfilm">{SIZE}{own("rfilter")}</film>')
    camera = content if kind == "sensor" else \
        '<transform name="toWorld"><lookAt origin="0,1,5" target="0,0,0" up="0,1,0"/></transform>'
    sensor = f'<sensor type="{name if kind == "sensor" else "perspective"}">{camera}{film}{own("sampler")}</sensor>'
    surface = f'<bsdf type="diffuse">{own("texture", attribute=" name=" + chr(34) + "reflectance" + chr(34))}</bsdf>'
    body = own("bsdf", surface) + own("medium", attribute=' name="interior"')
    return "\n".join(['<?xml version="1.0" encoding="utf-8"?>', '<scene version="0.6.0">',
                      own("integrator", '<integrator type="volpath"/>' if kind == "medium" else INNER), sensor,
                      own("shape", f'<shape type="sphere">{body}</shape>'), own("emitter", '<emitter type="constant"/>'),
                      "</scene>", ""])


def write_files(folder):
    points, faces = [(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)]
    normals, uv = [(0, 0, 1)] * 3, [(0, 0)] * 3
    write_obj(folder / "m.obj", points, faces, normals, uv)
    write_ply(folder / "m.ply", points, faces)
    write_serialized(folder / "m.serialized", [(points, faces, normals, uv)] * 2)
    write_png(folder / "t.png", [[(0.8, 0.4, 0.2), (0.1 * y, 0.4, 0.2)] for y in range(3)])


def main():
    if len(sys.argv) != 2:
        sys.exit(f"usage: {sys.argv[0]} FOLDER")
    folder = Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    write_files(folder)
    write_scenes(folder, ((f"{kind}-{name}-{i:02d}", scene(kind, name, content)) for kind, plugins in PLUGINS.items()
                          for name, contents in plugins.items() for i, content in enumerate(contents)))


main()
