"""The contents of plugins in new_scenes.py: for each plugin of Mitsuba 3.9 what stands within its element, a scene each."""

import mitsuba_scene_parts as parts
from mitsuba_scene_parts import (
    BOX,
    LAMP_PLACE,
    LOOK,
    PATH,
    SKY,
    VOLPATH,
    area,
    ball,
    boolean,
    bsdf,
    element,
    emitter,
    grey,
    integer,
    integrator,
    number,
    numbers,
    picture,
    place,
    point,
    rgb,
    shape,
    spectrum,
    string,
    texture,
    value,
    vector,
)


def film(*content, kind="hdrfilm", rfilter=BOX):
    return element("film", kind, integer("width", 32), integer("height", 24), rfilter, *content)


def camera(*content, kind="perspective", fov=number("fov", 40), to_world=LOOK, film=film(), sampler=""):
    return element("sensor", kind, fov, to_world, *content, film, sampler)


def scene(*content, sensor=camera(), **rest):
    return parts.scene(*content, sensor=sensor, **rest)


TURN = place('<scale value="0.6"/>', '<rotate y="1" angle="40"/>', '<translate x="0.2" y="0.4"/>')
SMALL = place('<scale value="0.6"/>', '<translate y="0.3"/>')
FLIP = boolean("flip_normals")
RED = rgb("reflectance", "0.8,0.2,0.1")
PAINT = bsdf("twosided", bsdf("diffuse", picture("reflectance")))
IORS = (string("int_ior", "water"), number("int_ior", 1.4), string("ext_ior", "water"), number("ext_ior", 1.1))
FACETS = (string("distribution", "ggx"), string("distribution", "beckmann"))
ALPHA, ALPHAS = number("alpha", 0.3), numbers(alpha_u=0.1, alpha_v=0.4)
GLOSS = rgb("specular_reflectance", "0.9,0.5,0.2"), number("specular_reflectance", 0.5), picture("specular_reflectance")
THROUGH = rgb("specular_transmittance", "0.9,0.5,0.2"), picture("specular_transmittance")
UNDER = rgb("diffuse_reflectance", "0.8,0.5,0.2"), picture("diffuse_reflectance"), boolean("nonlinear")
VISIBLE = boolean("sample_visible", False)


def volume(name, kind="gridvolume", *content, file="smoke.vol"):
    inside = (string("filename", file), boolean("use_grid_bbox")) if kind == "gridvolume" else ()
    return element("volume", kind, *inside, *content, name=name)


METALS = ("Au", "Ag", "Al", "Cu", "Cr", "CuO", "Cu2O", "Hg", "W", "TiN", "VC", "a-C", "none")
INDICES = (
    "vacuum",
    "helium",
    "hydrogen",
    "air",
    "carbon dioxide",
    "water",
    "acetone",
    "ethanol",
    "carbon tetrachloride",
    "glycerol",
    "benzene",
    "silicone oil",
    "bromine",
    "water ice",
    "fused quartz",
    "pyrex",
    "acrylic glass",
    "polypropylene",
    "bk7",
    "sodium chloride",
    "amber",
    "pet",
    "diamond",
)
METAL_SPECTRA = [
    "".join(
        element("spectrum", kind, string("values", values), where, name=name)
        for name, values in (("eta", "1.6, 1, 0.3, 0.2"), ("k", "1.9, 1.9, 2.9, 3.9"))
    )
    for kind, where in (
        ("regular", numbers(wavelength_min=400, wavelength_max=700)),
        ("irregular", string("wavelengths", "400, 500, 600, 700")),
    )
]
HUED = rgb("base_color", "0.9,0.5,0.2")

BSDFS = {
    "diffuse": ["", RED, picture("reflectance")],
    "dielectric": ["", *IORS, *GLOSS, *THROUGH],
    "thindielectric": ["", *IORS, *GLOSS, *THROUGH],
    "roughdielectric": ["", *FACETS, ALPHA, ALPHAS, picture("alpha"), *IORS, *GLOSS, *THROUGH, VISIBLE],
    "conductor": [
        "",
        *(string("material", m) for m in METALS),
        rgb("eta", "0.2,0.9,1.1") + rgb("k", "3.9,2.4,2.1"),
        spectrum("eta", 0.2) + spectrum("k", 3),
        numbers(eta=0.2, k=3),
        spectrum("eta", "400:1.6, 500:1, 600:0.3, 700:0.2") + spectrum("k", "400:1.9, 500:1.9, 600:2.9, 700:3.9"),
        string("material", "Au") + GLOSS[0],
        GLOSS[2],
    ],
    "conductor spectra": METAL_SPECTRA,
    "roughconductor": [
        "",
        *(string("material", m) for m in ("Au", "Al", "none")),
        rgb("eta", "0.2,0.9,1.1") + rgb("k", "3.9,2.4,2.1"),
        *FACETS,
        ALPHA,
        ALPHAS,
        picture("alpha"),
        VISIBLE,
        *GLOSS,
    ],
    "plastic": ["", *UNDER, *IORS, *GLOSS],
    "roughplastic": ["", *UNDER, *IORS, *GLOSS, *FACETS, ALPHA, VISIBLE + ALPHA],
    "pplastic": ["", UNDER[0], *IORS, GLOSS[0], *FACETS, ALPHA, ALPHAS, VISIBLE + ALPHA],
    "bumpmap": [
        picture("arbitrary", boolean("raw"), file="bumps.exr") + grey(0.8),
        picture("", file="bumps.exr") + number("scale", 0.3) + grey(0.8),
        picture("", file="bumps.exr") + bsdf("roughplastic", ALPHA, id="below", name="bsdf"),
        picture("", file="bumps.exr") + grey(0.8) + boolean("flip_invalid_normals", False),
        picture("", file="bumps.exr") + grey(0.8) + boolean("use_shadowing_function", False),
    ],
    "normalmap": [
        picture("normalmap", boolean("raw"), file="normals.exr") + c + grey(0.8)
        for c in ("", boolean("flip_invalid_normals", False), boolean("use_shadowing_function", False))
    ],
    "blendbsdf": [
        number("weight", 0.8) + grey(0.2) + bsdf("plastic"),
        picture("weight") + grey(0.2) + bsdf("plastic"),
        number("weight", 0.3) + bsdf("roughconductor", name="bsdf_0") + bsdf("dielectric", name="bsdf_1"),
        texture("weight", "checkerboard") + grey(0.2) + bsdf("blendbsdf", number("weight", 0.5), grey(0.7), bsdf("plastic")),
    ],
    "mask": [
        grey(0.5),
        number("opacity", 0.3) + grey(0.5),
        picture("opacity") + grey(0.5),
        rgb("opacity", "0.5") + bsdf("twosided", grey(0.5)),
        spectrum("opacity", 0.5) + bsdf("plastic", name="material"),
    ],
    "twosided": [
        grey(0.5),
        grey(0.5) + bsdf("plastic"),
        bsdf("roughconductor", name="front"),
        bsdf("diffuse", RED, name="brdf_0") + grey(0.5),
        boolean("allow_transmission") + bsdf("dielectric"),
    ],
    "null": [""],
    "principled": [
        "",
        HUED,
        picture("base_color"),
        number("roughness", 0.2),
        picture("roughness"),
        numbers(anisotropic=0.8, metallic=1),
        number("metallic", 0.7) + HUED,
        picture("metallic"),
        number("spec_trans", 0.7) + HUED,
        numbers(spec_trans=0.7, eta=1.33),
        number("eta", 1.6),
        number("specular", 0.9),
        number("spec_tint", 0.8) + HUED,
        numbers(sheen=0.9, sheen_tint=0.5) + HUED,
        number("flatness", 0.9),
        numbers(clearcoat=1, clearcoat_gloss=0.8),
        numbers(main_specular_sampling_rate=2, clearcoat_sampling_rate=0.5, diffuse_reflectance_sampling_rate=2, clearcoat=1),
    ],
    "principledthin": [
        "",
        HUED,
        number("roughness", 0.2),
        numbers(anisotropic=0.8, spec_trans=0.5),
        numbers(spec_trans=0.7, eta=1.33),
        numbers(spec_tint=0.8, spec_trans=0.5) + HUED,
        numbers(sheen=0.9, sheen_tint=0.5) + HUED,
        number("flatness", 0.9),
        number("diff_trans", 1.2),
        numbers(
            diff_trans=0.6,
            diffuse_transmittance_sampling_rate=2,
            specular_reflectance_sampling_rate=2,
            specular_transmittance_sampling_rate=2,
            diffuse_reflectance_sampling_rate=2,
        ),
    ],
    "polarizer": ["", number("theta", 30), number("transmittance", 0.7), boolean("polarizing", False)],
    "retarder": ["", number("theta", 30), number("delta", 45), number("transmittance", 0.7)],
    "circular": ["", number("transmittance", 0.7), boolean("left_handed")],
    "hair": [
        "",
        numbers(eumelanin=0.2, pheomelanin=0.4),
        rgb("sigma_a", "0.2,0.25,0.7") + number("scale", 2),
        *IORS,
        number("longitudinal_roughness", 0.1),
        number("azimuthal_roughness", 0.6),
        number("scale_tilt", 5),
    ],
}

MOVE = place('<scale x="3" y="2"/>', '<rotate z="1" angle="20"/>', '<translate x="0.3" y="0.1"/>', name="to_uv")
TEXTURES = {
    "bitmap": [
        "",
        boolean("raw"),
        *(string("filter_type", w) for w in ("bilinear", "nearest")),
        *(string("wrap_mode", w) + MOVE for w in ("repeat", "mirror", "clamp")),
        MOVE,
        boolean("accel", False),
        *(string("format", w) for w in ("variant", "fp16", "auto")),
    ],
    "bitmap file": [string("filename", f"picture.{ending}") for ending in ("exr", "pfm", "hdr", "ppm", "tga", "bmp")]
    + [string("filename", f"{name}.png") for name in ("deep", "grey", "clear")],
    "checkerboard": [
        "",
        rgb("color0", "0.9,0.5,0.1"),
        spectrum("color1", 0.9),
        picture("color0"),
        MOVE,
        texture("color1", "checkerboard", MOVE),
    ],
    "mesh_attribute": [
        string("name", w) + c for w, c in (("vertex_color", ""), ("face_part", ""), ("vertex_heat", number("scale", 0.5)))
    ],
    "volume": [
        volume("volume"),
        volume("volume", file="coloured.vol"),
        volume("volume", "constvolume", rgb("value", "0.2,0.5,0.1")),
    ],
    "uniform": [number("value", 0.6)],
    "srgb": [rgb("color", "0.7,0.4,0.1")],
    "rawconstant": [number("value", 0.4)],
}

OVER = place('<lookat origin="1,4,2" target="0.2,0,0" up="0,1,0"/>')
UP = place('<rotate x="1" angle="-90"/>')
SUN = vector("sun_direction", "0.5,0.8,0.6")
EMITTERS = {
    "area": [
        "",
        rgb("radiance", "8,6,4"),
        number("radiance", 8),
        spectrum("radiance", 8),
        picture("radiance"),
        spectrum("radiance", "400:2, 500:3, 600:9, 700:4"),
        element("spectrum", "d65", number("scale", 6), name="radiance"),
        element("spectrum", "blackbody", number("temperature", 4000), name="radiance"),
        element("spectrum", "uniform", number("value", 6), name="radiance"),
        texture("radiance", "checkerboard"),
        numbers(radiance=8, sampling_weight=2),
        element("spectrum", "d65", rgb("color", "0.9,0.5,0.2"), number("scale", 6), name="radiance"),
        element("spectrum", "d65", texture("nested", "checkerboard"), number("scale", 6), name="radiance"),
    ],
    "directionalarea": ["", rgb("radiance", "8,6,4")],
    "point": [
        "",
        point("position", "1,3,2") + number("intensity", 9),
        place('<translate x="1" y="3" z="2"/>') + rgb("intensity", "9,6,3"),
        point("position", "1,3,2") + spectrum("intensity", 12),
    ],
    "spot": [
        OVER + c
        for c in (
            "",
            rgb("intensity", "20,15,9"),
            number("cutoff_angle", 30),
            numbers(cutoff_angle=30, beam_width=5),
            picture("texture"),
        )
    ],
    "projector": [
        OVER + c + number("scale", 20)
        for c in (
            number("fov", 25),
            number("fov", 25) + rgb("irradiance", "1,2,0.5"),
            number("fov", 25) + picture("irradiance"),
            string("focal_length", "35mm"),
            number("fov", 25) + string("fov_axis", "y") + picture("irradiance"),
        )
    ],
    "directional": ["", vector("direction", "-0.3,-1,-0.4"), OVER + rgb("irradiance", "2,1.5,1")],
    "constant": ["", rgb("radiance", "0.5,0.7,0.9"), spectrum("radiance", 0.7)],
    "envmap": [
        string("filename", "sky.exr") + c
        for c in ("", number("scale", 2), place('<rotate y="1" angle="70"/>'), boolean("mis_compensation"))
    ]
    + [string("filename", f"picture.{ending}") for ending in ("pfm", "hdr", "png")],
    "sunsky": [
        UP + c
        for c in (
            "",
            SUN,
            SUN + number("turbidity", 6),
            SUN + number("albedo", 0.8),
            SUN + rgb("albedo", "0.9,0.5,0.1"),
            SUN + number("sun_scale", 0.1),
            SUN + number("sky_scale", 2),
            SUN + number("sun_aperture", 3),
            integer("year", 2020) + integer("month", 5) + integer("day", 3) + numbers(hour=10, minute=20, second=30),
            numbers(latitude=46, longitude=6, timezone=2),
            SUN + boolean("complex_sun"),
        )
    ],
    "timed_sunsky": [
        UP + c
        for c in (
            "",
            numbers(turbidity=6, albedo=0.2),
            numbers(window_start_time=9, window_end_time=12),
            integer("start_year", 2026)
            + integer("start_month", 3)
            + integer("start_day", 2)
            + integer("end_year", 2026)
            + integer("end_month", 4)
            + integer("end_day", 1),
            numbers(sun_scale=0.1, sky_scale=2),
            numbers(shutter_open=0, shutter_close=1),
            numbers(latitude=46, longitude=6, timezone=2),
            number("sun_aperture", 2) + boolean("complex_sun", False),
        )
    ],
}
# Lights without a place of their own hang above the floor.
SHINING = {"area": LAMP_PLACE, "directionalarea": LAMP_PLACE}

MESH = {
    "obj": string("filename", "mesh.obj"),
    "ply": string("filename", "mesh.ply"),
    "serialized": string("filename", "two.serialized"),
}
TANGENT = place('<scale value="0.8"/>', '<translate x="-0.4" z="-0.4"/>')
SHAPES = {
    "sphere": [SMALL, point("center", "0,0.3,0") + number("radius", 0.7), TURN + FLIP],
    "cylinder": [SMALL, point("p0", "-0.5,0,0") + point("p1", "0.6,0.9,0") + number("radius", 0.4), TURN + FLIP],
    **{kind: [TURN, TURN + FLIP] for kind in ("cube", "rectangle", "disk")},
    **{
        kind: [
            file + TURN + c
            for c in (
                "",
                boolean("face_normals"),
                FLIP,
                *((boolean("flip_tex_coords"), boolean("flip_tex_coords", False)) if kind != "serialized" else ()),
            )
        ]
        for kind, file in MESH.items()
    },
    "serialized shape_index": [MESH["serialized"] + TURN + integer("shape_index", 1)],
    "ply binary": [string("filename", f"{name}.ply") + TURN for name in ("little", "big", "painted", "indices")],
    "obj forms": [string("filename", f"{name}.obj") + TURN for name in ("forms", "quads", "normals")],
    **{kind: [string("filename", "curves.txt") + c for c in ("", SMALL)] for kind in ("bsplinecurve", "linearcurve")},
    "sdfgrid": [
        string("filename", "ball.vol") + c
        for c in (TANGENT, TANGENT + string("normals", "analytic"), TANGENT + string("normals", "smooth"))
    ],
    **{
        kind: [
            string("filename", "splats.ply") + c
            for c in ("", number("scale_factor", 0.5), number("extent", 2), boolean("extent_adaptive_clamping"), SMALL)
        ]
        for kind in ("ellipsoids", "ellipsoidsmesh")
    },
    "sphere weight": [SMALL + number("silhouette_sampling_weight", 2)],
    "ellipsoidsmesh shell": [
        string("filename", "splats.ply") + string("shell", w) for w in ("default", "box", "ico_sphere", "uv_sphere")
    ],
}

THICK = rgb("sigma_t", "1,0.75,0.5") + number("scale", 2)
HG = element("phase", "hg", number("g", 0.6))
MEDIA = {
    "homogeneous": [
        "",
        THICK,
        THICK + rgb("albedo", "0.9,0.6,0.2"),
        THICK + number("albedo", 0.5),
        number("sigma_t", 2),
        spectrum("sigma_t", 2),
        number("sigma_t", 2) + boolean("has_spectral_extinction", False),
        THICK + boolean("sample_emitters"),
        THICK + volume("albedo", file="coloured.vol"),
        THICK + volume("albedo", "constvolume", number("value", 0.4)),
    ],
    "heterogeneous": [
        volume("sigma_t") + number("scale", 4) + c
        for c in (
            "",
            rgb("albedo", "0.9,0.6,0.2"),
            volume("albedo", file="coloured.vol"),
            volume("albedo", "constvolume", rgb("value", "0.9,0.6,0.2")),
            HG,
            boolean("has_spectral_extinction", False),
        )
    ]
    + [volume("sigma_t", "constvolume", number("value", 1.5)) + number("albedo", 0.8)],
}
LOBES = element("phase", "hg", number("g", 0.8)), element("phase", "isotropic")
PHASES = {
    "isotropic": [""],
    "hg": ["", number("g", 0.5), number("g", -0.5)],
    "rayleigh": [""],
    "blendphase": [
        number("weight", 0.3) + "".join(LOBES),
        volume("weight") + "".join(LOBES),
        number("weight", 0.6) + element("phase", "rayleigh", name="phase_0") + element("phase", "hg", name="phase_1"),
    ],
    "tabphase": [string("values", "0.5, 0.6, 1.0, 2.0, 4.0")],
    "sggx": [volume("S", file="flakes.vol")],
}
VOLUMES = {
    "gridvolume": [
        string("filename", "smoke.vol") + c
        for c in (
            "",
            boolean("use_grid_bbox"),
            *(boolean("use_grid_bbox") + string("filter_type", w) for w in ("nearest", "trilinear")),
            *(boolean("use_grid_bbox") + string("wrap_mode", w) for w in ("repeat", "mirror", "clamp")),
            boolean("use_grid_bbox") + boolean("raw"),
            boolean("use_grid_bbox") + boolean("accel", False),
            place('<scale value="1.5"/>', '<translate x="-0.8" y="-0.2" z="-0.5"/>'),
        )
    ],
    "constvolume": [number("value", 0.8), rgb("value", "0.9,0.6,0.2"), spectrum("value", 0.7)],
}
