"""Both principled BSDFs for bsdfs.py: Burley 2012, Physically Based Shading at Disney; Burley 2015, Extending the Disney
BRDF to a BSDF with Integrated Subsurface Scattering. Choices that the papers leave open are Mitsuba 3's: the exact
Fresnel term of a dielectric, separable shadowing, the root of the colour for glass, the probabilities of the lobes.
Directions are in degrees elsewhere and vectors here; "o" is the side that radiance goes to, "i" where light comes from.

    PYTHON harness/oracles/principled.py     (holds every case of bsdfs.py against Mitsuba's own eval and pdf)
"""
import math

from interfaces import Facets, direction, dot, fresnel, reflection_shape, unit

LUMINANCE = (0.212671, 0.715160, 0.072169)


def schlick(c):
    return (1 - min(max(c, 0.0), 1.0)) ** 5


def hue(colour):
    y = dot(LUMINANCE, colour)
    return tuple(x / y for x in colour) if y > 0 else (1.0, 1.0, 1.0)


def between(a, b, t):
    return a + (b - a) * t


def flipped(v):
    return tuple(-x for x in v)


class Burley:
    def __init__(self, p):
        self.p = p
        self.colour = p.get("base_color", (0.5, 0.5, 0.5))
        self.roughness = p.get("roughness", 0.5)

    def get(self, name):
        return self.p.get(name, 0.0)

    def rate(self, name):
        return self.p.get(name + "_sampling_rate", 1.0)

    def facets(self, scale=1.0):
        """Burley 2012, section 5.4: aspect = sqrt(1 - 0.9 anisotropic)."""
        alpha, aspect = (self.roughness * scale) ** 2, math.sqrt(1 - 0.9 * self.get("anisotropic"))
        return Facets("ggx", max(0.001, alpha / aspect), max(0.001, alpha * aspect))

    def base(self, o, i, d):
        """Diffuse with retroreflection (2015, section 5.3), flattened towards Hanrahan and Krueger's (2012, section 5.3); d
        is the cosine of both directions to their half."""
        lo, li = schlick(o[2]), schlick(i[2])
        r = 2 * self.roughness * d * d
        lambert, retro = (1 - lo / 2) * (1 - li / 2), r * (lo + li + lo * li * (r - 1))
        f90 = self.roughness * d * d
        ss = between(1, f90, lo) * between(1, f90, li)
        flat = 1.25 * (ss * (1 / (o[2] + i[2]) - 0.5) + 0.5)
        return [c * between(lambert + retro, flat, self.get("flatness")) / math.pi for c in self.colour]

    def cloth(self, d):
        return [self.get("sheen") * schlick(d) * between(1, h, self.get("sheen_tint")) for h in hue(self.colour)]

    def tinted(self, c, n, transmitted):
        """Schlick's approximation, from 0.08 `specular` in the base's hue; into thinner media by the refracted angle."""
        weight = schlick(c if n > 1 else transmitted)
        r0 = ((n - 1) / (n + 1)) ** 2
        return [between(r0 * h, 1, weight) for h in hue(self.colour)], weight


def beyond(c, n):
    return math.sqrt(max(0.0, 1 - (1 - c * c) / n ** 2))


class Principled(Burley):
    def __init__(self, p):
        super().__init__(p)
        self.eta = p.get("eta") or 2 / (1 - math.sqrt(0.08 * p.get("specular", 0.5))) - 1
        self.n = self.eta, 1.0  # inside, outside
        metallic, clear = self.get("metallic"), self.get("spec_trans")
        self.diffuse, self.glass = (1 - metallic) * (1 - clear), (1 - metallic) * clear
        self.coat_alpha = between(0.1, 0.001, self.get("clearcoat_gloss"))

    def coat_density(self, m):
        """GTR1 (2012, appendix B, equation 4)."""
        a2 = self.coat_alpha ** 2
        return (a2 - 1) / (math.pi * math.log(a2) * (1 + (a2 - 1) * m[2] ** 2))

    def parts(self, o, i):
        """The facet, its cosines, the Fresnel term, and 1 / |n_i i + n_o o|^2 for light that passes; None where there
        is none."""
        n_o, n_i = ((self.n[1] if v[2] > 0 else self.n[0]) for v in (o, i))
        if o[2] * i[2] > 0:
            n_i = n_o
        m = unit(tuple(n_o * a + n_i * b for a, b in zip(o, i)))
        m = m if m[2] > 0 else flipped(m)
        om, im = dot(o, m), dot(i, m)
        if om * o[2] <= 0 or im * i[2] <= 0 or (o[2] < 0 and self.glass == 0):
            return None
        n_beyond = self.n[0] if o[2] > 0 else self.n[1]
        return m, abs(om), abs(im), fresnel(abs(om), n_beyond / n_o), n_o, n_i

    def front(self, o, i, m, c, r):
        metallic, tint = self.get("metallic"), self.get("spec_tint")
        shape, _ = reflection_shape(self.facets(), o, i)
        hued, weight = self.tinted(c, self.eta, beyond(c, self.eta))
        wide = Facets("ggx", 0.25, 0.25)
        coat = (0.25 * self.get("clearcoat") * between(0.04, 1, weight) * self.coat_density(m) * wide.g1(o) * wide.g1(i))
        return tuple(shape * ((1 - metallic) * between(r, h, tint) + metallic * between(b, 1, weight)) + coat
                     for h, b in zip(hued, self.colour))

    def eval(self, o, i):
        found = self.parts(o, i)
        if not found:
            return (0, 0, 0)
        m, om, im, r, n_o, n_i = found
        f = self.facets()
        if o[2] * i[2] < 0:  # Walter et al. 2007, equation 21, with light from i
            shape = om * im / abs(o[2] * i[2]) * n_o ** 2 * (1 - r) * f.g1(o) * f.g1(i) * f.density(m)
            below = (n_i * dot(i, m) + n_o * dot(o, m)) ** 2
            return tuple(math.sqrt(c) * self.glass * shape / below for c in self.colour)
        if o[2] < 0:
            return (self.glass * r * reflection_shape(f, o, i)[0],) * 3
        return tuple(g + self.diffuse * b + (1 - self.get("metallic")) * s
                     for g, b, s in zip(self.front(o, i, m, om, r), self.base(o, i, im), self.cloth(im)))

    def pdf(self, o, i):
        found = self.parts(o, i)
        if not found:
            return 0.0
        m, om, im, r, n_o, n_i = found
        above = o if o[2] > 0 else flipped(o)
        facet = self.facets().pdf(above, m)
        lobes = (self.diffuse * self.rate("diffuse_reflectance"),
                 0.25 * self.get("clearcoat") * self.rate("clearcoat"), self.rate("main_specular"))
        diffuse, coat, main = (x / sum(lobes) for x in lobes) if o[2] > 0 else (0, 0, 1)
        passes = (self.glass if o[2] > 0 else 1) * (1 - r)
        if o[2] * i[2] < 0:  # Walter et al., equation 17
            return main * passes * facet * n_i ** 2 * im / (n_i * dot(i, m) + n_o * dot(o, m)) ** 2
        return (main * (1 - passes) * facet + coat * self.coat_density(m) * m[2]) / (4 * om) + diffuse * abs(i[2]) / math.pi


class PrincipledThin(Burley):
    """2015, section 5.3: reflection, and its mirror image behind with facets that are as rough as figure 15 shows. Mitsuba
    lets light pass only where it meets the back of the facet that passes it on. Its density of samples has that test,
    too; ours does not, since that depends on which direction is the viewer's."""

    def folded(self, o, i):
        o, i = (o, i) if o[2] > 0 else (flipped(o), flipped(i))
        up = (i[0], i[1], abs(i[2]))
        through = i[2] < 0
        n = self.p.get("eta", 1.5)
        m = unit(tuple(a + b for a, b in zip(o, up)))
        return o, up, m, dot(o, m), through, n, self.facets(0.65 * n - 0.35 if through else 1.0)

    def eval(self, o, i):
        o, i, _, d, through, n, f = self.folded(o, i)
        shape, m = reflection_shape(f, o, i)
        r, passes, clear = fresnel(d, n), self.get("diff_trans") / 2, self.get("spec_trans")
        if through:
            shape = shape if dot((i[0], i[1], -i[2]), m) < 0 else 0.0
            return tuple(clear * c * (1 - r) * shape + (1 - clear) * passes * c / math.pi for c in self.colour)
        hued, _ = self.tinted(d, n, beyond(d, n))
        return tuple(clear * between(r, h, self.get("spec_tint")) * shape + (1 - clear) * (1 - passes) * (b + s)
                     for h, b, s in zip(hued, self.base(o, i, d), self.cloth(d)))

    def pdf(self, o, i):
        o, i, m, d, through, _, f = self.folded(o, i)
        clear, passes = self.get("spec_trans"), self.get("diff_trans") / 2
        lobes = (clear / 2 * self.rate("specular_reflectance"), clear / 2 * self.rate("specular_transmittance"),
                 (1 - clear) * (1 - passes) * self.rate("diffuse_reflectance"),
                 (1 - clear) * passes * self.rate("diffuse_transmittance"))
        facet, diffuse = (lobes[1], lobes[3]) if through else (lobes[0], lobes[2])
        return (facet * f.pdf(o, m) / (4 * d) + diffuse * i[2] / math.pi) / sum(lobes)


TINT = {"base_color": (0.2, 0.5, 0.8)}
RATES = {"diffuse_reflectance_sampling_rate": 0.7, "main_specular_sampling_rate": 1.6, "clearcoat_sampling_rate": 3.0}
THIN_RATES = {"diffuse_reflectance_sampling_rate": 0.7, "specular_reflectance_sampling_rate": 1.6,
              "specular_transmittance_sampling_rate": 2.5, "diffuse_transmittance_sampling_rate": 0.4}
CLOTH = {"sheen": 0.8, "sheen_tint": 0.6}
COAT = {"clearcoat": 0.9, "clearcoat_gloss": 0.3}
CASES = [
    ("principled", {}), ("principled", {**TINT, "roughness": 0.7, "specular": 0.9, "spec_tint": 0.4}),
    ("principled", {**TINT, "roughness": 0.6, "metallic": 0.7, "anisotropic": 0.8}),
    ("principled", {**TINT, **CLOTH, "flatness": 0.6, "eta": 1.8}), ("principled", {**TINT, **COAT, **RATES}),
    ("principled", {**TINT, **COAT, "eta": 0.7, "roughness": 0.6, "metallic": 0.3, "spec_tint": 0.5}),
    ("principled", {**TINT, "spec_trans": 0.6, "roughness": 0.7, "metallic": 0.2, "anisotropic": 0.4, **RATES, **COAT}),
    ("principled", {**TINT, **CLOTH, "spec_trans": 0.9, "eta": 1.4, "flatness": 0.5, "spec_tint": 0.3}),
    ("principled", {**TINT, "spec_trans": 0.8, "eta": 0.65}),
    ("principledthin", {}), ("principledthin", {**TINT, **CLOTH, "flatness": 0.6, "diff_trans": 0.7, "roughness": 0.8}),
    ("principledthin", {**TINT, "spec_trans": 0.7, "eta": 1.7, "spec_tint": 0.4, "anisotropic": 0.6, "diff_trans": 1.3,
                        **THIN_RATES}),
    ("principledthin", {**TINT, "spec_trans": 0.6, "eta": 0.8, "spec_tint": 0.5, "roughness": 0.7}),
]
KINDS = {"principled": Principled, "principledthin": PrincipledThin}


def compare_with_mitsuba():
    import random

    import mitsuba as mi
    mi.set_variant("scalar_rgb")
    draw, worst = random.Random(1), 0.0
    for kind, p in CASES:
        ours = KINDS[kind](p)
        content = {k: {"type": "rgb", "value": list(v)} if isinstance(v, tuple) else v for k, v in p.items()}
        theirs = mi.load_dict({"type": kind, **content})
        for _ in range(20000):
            o, i = (direction((math.degrees(math.acos(draw.uniform(-1, 1))), draw.uniform(0, 360))) for _ in range(2))
            if min(abs(o[2]), abs(i[2])) < 0.02 or (kind == "principled" and o[2] < 0 and ours.glass == 0):
                continue
            si = mi.SurfaceInteraction3f()
            si.wi = mi.Vector3f(o)
            context, wo = mi.BSDFContext(), mi.Vector3f(i)
            pairs = [(a * abs(i[2]), b) for a, b in zip(ours.eval(o, i), theirs.eval(context, si, wo))]
            if kind == "principled" or o[2] * i[2] > 0 or -dot(i, ours.folded(o, i)[2]) * o[2] > 0:
                pairs.append((ours.pdf(o, i), theirs.pdf(context, si, wo)))
            for a, b in pairs:
                error = abs(a - b) / (abs(b) + 1e-3)
                worst = max(worst, error)
                if error > 1e-3:
                    raise SystemExit(f"{kind} {p} o {o} i {i}: {a} for Mitsuba's {b}")
    print(f"{len(CASES)} cases agree with Mitsuba {mi.__version__} at 20,000 pairs each, the worst within {worst:.1e}")


if __name__ == "__main__":
    compare_with_mitsuba()
