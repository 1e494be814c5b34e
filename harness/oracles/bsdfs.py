"""Expected values of every BSDF of docs/formats/scene.md, from the published formulas: prints bsdfs_expected.tsv, which
renderer/bsdfs/bsdf_oracle_test.cpp reads.

    python3 harness/oracles/bsdfs.py > harness/oracles/bsdfs_expected.tsv      (standard library only; half a minute)

nightly.sh holds the table against it. It shares nothing with the renderer, not
even the form of the formulas: Fresnel by complex arithmetic for metals and glass alike, facets by their distribution of
slopes (Heitz 2014), refraction with the half vector of Walter et al. 2007 written with both indices, averages over the
facets by their area instead of the visible ones. Directions are (degrees from the normal, degrees of azimuth); "o" is
the side that radiance goes to, "i" where light comes from.

Born, Wolf: Principles of Optics, sections 1.5 and 14.2. Walter, Marschner, Li, Torrance 2007: Microfacet Models for
Refraction through Rough Surfaces. Heitz 2014: Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs.
Lafortune, Willems 1994: Using the Modified Phong Reflectance Model for Physically Based Rendering. Weidlich, Wilkie
2007: Arbitrarily Layered Micro-Facet Surfaces. Walsh 1926; Orchard 1969: Reflection and Transmission of Light by
Diffusing Suspensions (tables of the diffuse reflectance of an interface).
"""
import math
import sys

from interfaces import Facets, check_facets, diffuse_reflectance, direction, dot, fresnel, reflection_shape, refracted
from interfaces import simpson, unit

import principled

AIR, BK7, POLYPROPYLENE = 1.000277, 1.5046, 1.49  # of the manual of Mitsuba 3, table of named indices


# --- BSDFs: each class takes the parameters of the plugin and has eval(o, i) and, where there is one, mirror(o) -------


def metal_reflectance(p, cos_i, around=1.0):
    if "eta" not in p and "k" not in p:
        return p.get("specular_reflectance", (1, 1, 1))
    eta, k = p.get("eta", (0, 0, 0)), p.get("k", (1, 1, 1))
    return tuple(s * fresnel(cos_i, complex(a, b) / around)
                 for s, a, b in zip(p.get("specular_reflectance", (1, 1, 1)), eta, k))


def facets_of(p):
    alpha = p.get("alpha", 0.1)
    return Facets(p.get("distribution", "beckmann"), p.get("alpha_u", alpha), p.get("alpha_v", alpha),
                  p.get("sample_visible", True))


def iors(p, inside):
    return p.get("int_ior", inside), p.get("ext_ior", AIR)


def colour(p, name, default):
    return p.get(name, (default,) * 3)


class Diffuse:
    def __init__(self, p):
        self.rho = colour(p, "reflectance", 0.5)

    def eval(self, o, i):
        return tuple(r / math.pi for r in self.rho)


class Conductor:
    def __init__(self, p, around=1.0):
        self.p, self.around = p, around

    def mirror(self, o):
        return metal_reflectance(self.p, o[2], self.around)


class RoughConductor:
    def __init__(self, p, around=1.0):
        self.p, self.f, self.around = p, facets_of(p), around

    def eval(self, o, i):
        shape, m = reflection_shape(self.f, o, i)
        return tuple(r * shape for r in self.facet(o, m))

    def facet(self, o, m):
        return metal_reflectance(self.p, dot(o, m), self.around)

    def pdf(self, o, i):
        m = unit(tuple(a + b for a, b in zip(o, i)))
        return self.f.pdf(o, m) / (4 * dot(o, m))  # Walter et al., equation 14

    def albedo(self, o):
        def value(m):
            c = dot(o, m)
            i = tuple(2 * c * y - x for x, y in zip(o, m))
            return self.f.g1(i) * self.facet(o, m)[0] if i[2] > 0 else 0.0
        return self.f.g1(o) / self.f.g1_exact(o) * self.f.mean_seen(o, value, 200, 180)


class Dielectric:
    def __init__(self, p):
        self.n = iors(p, BK7)
        self.reflectance, self.transmittance = (colour(p, "specular_" + w, 1) for w in ("reflectance", "transmittance"))

    def lobes(self, o):
        """(direction, probability, weight of radiance, of flux, index entered / left) of reflection and refraction.
        Radiance over the squared index is what an interface keeps: from i's side to o's it changes by (n_o / n_i)^2."""
        n_o, n_i = (self.n[1], self.n[0]) if o[2] > 0 else self.n
        r = fresnel(abs(o[2]), n_i / n_o)
        yield (-o[0], -o[1], o[2]), r, self.reflectance, self.reflectance, 1
        up = refracted((o[0], o[1], abs(o[2])), n_i / n_o)
        if up:
            yield ((-up[0], -up[1], -math.copysign(up[2], o[2])), 1 - r,
                   tuple(t * (n_o / n_i) ** 2 for t in self.transmittance), self.transmittance, n_i / n_o)


class ThinDielectric(Dielectric):
    def lobes(self, o):
        """Between the faces of a pane light goes to and fro: summed bounce by bounce."""
        r = fresnel(abs(o[2]), self.n[0] / self.n[1])
        inside = refracted((o[0], o[1], abs(o[2])), self.n[0] / self.n[1])
        assert abs(fresnel(inside[2], self.n[1] / self.n[0]) - r) < 1e-12
        all_r, beam = r, (1 - r) * (1 - r) * r
        for _ in range(10000):
            all_r, beam = all_r + beam, beam * r * r
        yield (-o[0], -o[1], o[2]), all_r, self.reflectance, self.reflectance, 1
        yield tuple(-x for x in o), 1 - all_r, self.transmittance, self.transmittance, 1


class RoughDielectric:
    def __init__(self, p):
        self.f, self.n = facets_of(p), iors(p, BK7)
        self.reflectance, self.transmittance = (colour(p, "specular_" + w, 1) for w in ("reflectance", "transmittance"))

    def parts(self, o, i):
        n_o, n_i = ((self.n[1] if v[2] > 0 else self.n[0]) for v in (o, i))
        if o[2] * i[2] > 0:
            shape, m = reflection_shape(self.f, o, i)
            c = abs(dot(o, m))
            n_beyond = self.n[0] if o[2] > 0 else self.n[1]
            return m, fresnel(c, n_beyond / n_o), shape, 1 / (4 * c)
        m = unit(tuple(-(n_i * a + n_o * b) for a, b in zip(i, o)))  # Walter et al., equation 16
        if m[2] < 0:
            m = tuple(-x for x in m)
        im, om = dot(i, m), dot(o, m)
        if om * o[2] <= 0 or im * i[2] <= 0:
            return None
        below = (n_i * im + n_o * om) ** 2
        shape = abs(im * om / (i[2] * o[2])) * n_o ** 2 * self.f.density(m) * self.f.g1(i) * self.f.g1(o) / below
        # Samples i for a given o: equation 17 with the roles of the sides exchanged.
        return m, fresnel(abs(om), n_i / n_o), shape, n_i ** 2 * abs(im) / below

    def eval(self, o, i):
        found = self.parts(o, i)
        if not found:
            return (0, 0, 0)
        _, r, shape, _ = found
        if o[2] * i[2] > 0:
            return tuple(c * r * shape for c in self.reflectance)
        return tuple(c * (1 - r) * shape for c in self.transmittance)  # equation 21

    def pdf(self, o, i):
        m, r, _, jacobian = self.parts(o, i)
        up = o if o[2] > 0 else tuple(-x for x in o)
        return self.f.pdf(up, m) * jacobian * (r if o[2] * i[2] > 0 else 1 - r)


class Plastic:
    """Light that the base scatters up is thrown back by the share R, and so on: rho (1 + rho R + (rho R)^2 ...);
    without `nonlinear` the series in R alone, after a first rho (the manual of Mitsuba 3, `plastic`)."""

    def __init__(self, p):
        n_in, n_out = iors(p, POLYPROPYLENE)
        self.n, self.nonlinear = n_in / n_out, p.get("nonlinear", False)
        self.rho, self.specular = colour(p, "diffuse_reflectance", 0.5), colour(p, "specular_reflectance", 1)
        self.prepare(p)

    def prepare(self, p):
        self.back = diffuse_reflectance(1 / self.n)

    def through(self, v):
        return 1 - fresnel(v[2], self.n)

    def base(self, rho):
        total, bounce = 0.0, rho
        for _ in range(2000):
            total, bounce = total + bounce, bounce * self.back * (rho if self.nonlinear else 1)
        return total

    def eval(self, o, i):
        return tuple(self.through(o) * self.through(i) * self.base(r) / (math.pi * self.n ** 2) for r in self.rho)

    def mirror(self, o):
        return tuple(s * fresnel(o[2], self.n) for s in self.specular)

    def albedo(self, o):
        """Of the diffuse part: what the base sends up gets out by 1 - R, seen from inside."""
        return self.through(o) * self.base(self.rho[0]) * (1 - self.back)


class RoughPlastic(Plastic):
    """The interface is rough: its reflection that of facets, and what it lets through and throws back their averages;
    the latter over 64 cosines, ends included, as Mitsuba 3 has it."""
    mirror = albedo = None

    def prepare(self, p):
        self.f, self.shares = facets_of(p), {}
        nodes = [max(1e-6, k / 63) for k in range(64)]
        self.back = 2 * sum(c * self.share(c, 1 / self.n, False) for c in nodes) / 64

    def share(self, c, n, transmits):
        key = (c, n, transmits)
        if key not in self.shares:
            o = (math.sqrt(1 - c * c), 0.0, c)

            def value(m):
                om = dot(o, m)
                r = fresnel(om, n)
                if not transmits:
                    i = tuple(2 * om * y - x for x, y in zip(o, m))
                    return r * self.f.g1(i) if i[2] > 0 else 0.0
                cos_t = math.sqrt(max(0.0, 1 - (1 - om * om) / n ** 2))
                i = tuple((om / n - cos_t) * y - x / n for x, y in zip(o, m))
                return (1 - r) * self.f.g1(i) if i[2] < 0 else 0.0
            self.shares[key] = self.f.mean_seen(o, value)
        return self.shares[key]

    def through(self, v):
        return self.share(v[2], self.n, True)

    def eval(self, o, i):
        shape, m = reflection_shape(self.f, o, i)
        r = fresnel(dot(o, m), self.n)
        return tuple(s * r * shape + d for s, d in zip(self.specular, Plastic.eval(self, o, i)))

    def pdf(self, o, i):
        """Where the base is black."""
        return RoughConductor.pdf(self, o, i)


class Phong:
    """Lafortune and Willems 1994, equations 5 and 9, as in Mitsuba 0.6. Colours are scaled down to what conserves
    energy, by the strongest channel of their sum; Mitsuba takes the sum of each one's strongest."""

    def __init__(self, p):
        self.n = p.get("exponent", 30.0)
        d, s = colour(p, "diffuse_reflectance", 0.5), colour(p, "specular_reflectance", 0.2)
        most = max(1.0, *(a + b for a, b in zip(d, s)))
        self.diffuse, self.specular = tuple(x / most for x in d), tuple(x / most for x in s)

    def lobe(self, o, i):
        c = dot((-o[0], -o[1], o[2]), i)
        return (self.n + 2) / (2 * math.pi) * c ** self.n if c > 0 else 0.0

    def eval(self, o, i):
        return tuple(d / math.pi + s * self.lobe(o, i) for d, s in zip(self.diffuse, self.specular))


class Layered:
    """f = T T / n^2 exp(-sigma_a thickness (1 / cos o' + 1 / cos i')) f_base(o', i') (Weidlich and Wilkie 2007), with
    the light that goes to and fro below the interface as renderer/bsdfs/bsdf_layered.h says. A metal's index is relative to
    what lies on it: here the lacquer."""

    def __init__(self, p, kind, base):
        n_in, n_out = iors(p, BK7)
        self.n, self.kind = n_in / n_out, kind
        self.base = kind(base, n_in) if kind in (Conductor, RoughConductor) else kind(base)
        self.depth = [s * p.get("thickness", 1.0) for s in colour(p, "sigma_a", 0.0)]
        self.specular = colour(p, "specular_reflectance", 1)

    def way(self, *inside):
        return [math.exp(-d * sum(1 / v[2] for v in inside)) for d in self.depth]

    def diffuse(self, rho):
        return [r / (1 - r * diffuse_reflectance(1 / self.n, d)) for r, d in zip(rho, self.depth)]

    def eval(self, o, i):
        ro, ri = fresnel(o[2], self.n), fresnel(i[2], self.n)
        below_o, below_i = refracted(o, self.n), refracted(i, self.n)
        way, f = self.way(below_o, below_i), [0.0] * 3
        if self.kind in (Diffuse, Phong):
            f = [r / math.pi for r in self.diffuse(self.base.rho if self.kind is Diffuse else self.base.diffuse)]
        if self.kind is Phong:
            lobe = self.base.lobe(below_o, below_i)
            f = [x + s * lobe / (1 - s * w * min(ro, ri)) for x, s, w in zip(f, self.base.specular, way)]
        if self.kind is RoughConductor:
            rho = self.base.facet(below_o, unit(tuple(a + b for a, b in zip(below_o, below_i))))
            f = [x / (1 - r * w * min(ro, ri)) for x, r, w in zip(self.base.eval(below_o, below_i), rho, way)]
        return tuple(x * w * (1 - ro) * (1 - ri) / self.n ** 2 for x, w in zip(f, way))

    def mirror(self, o):
        r, out = fresnel(o[2], self.n), []
        below = refracted(o, self.n)
        base = self.base.mirror(below) if self.kind is Conductor else (0, 0, 0)
        for s, b, w in zip(self.specular, base, self.way(below, below)):
            total, beam = s * r, (1 - r) * b * w
            for _ in range(2000):  # each round: out by 1 - r, or back to the base
                total, beam = total + beam * (1 - r), beam * r * b * w
            out.append(total)
        return tuple(out)

    def pdf(self, o, i):
        """Where the interface's own reflection is black and the base all gloss: solid angles shrink by
        cos / (n^2 cos') on the way in."""
        below_o, below_i = refracted(o, self.n), refracted(i, self.n)
        return self.base.pdf(below_o, below_i) * i[2] / (self.n ** 2 * below_i[2])

    def albedo(self, o):
        """Of a diffuse base, by the light on its way out: per cosine inside, what is absorbed and let through."""
        if self.kind is not Diffuse:
            return None
        r, d = fresnel(o[2], self.n), self.depth[0]

        def out(angle):
            c = math.cos(angle)
            return (1 - fresnel(c, 1 / self.n)) * math.exp(-d / c) * 2 * c * math.sin(angle)
        critical = math.asin(1 / self.n)
        escapes = simpson(lambda t: out(critical * (1 - t * t)) * 2 * critical * t, 0, 1, 2000)
        return (1 - r) * self.way(refracted(o, self.n))[0] * self.diffuse(self.base.rho)[0] * escapes


# --- the table -------------------------------------------------------------------------------------------------------

KINDS = {"diffuse": Diffuse, "conductor": Conductor, "roughconductor": RoughConductor, "dielectric": Dielectric,
         "thindielectric": ThinDielectric, "roughdielectric": RoughDielectric, "plastic": Plastic,
         "roughplastic": RoughPlastic, "phong": Phong, **principled.KINDS}
NAMED = {"diamond": 2.419, "water": 1.333, "air": AIR, "bk7": BK7}
PAIRS = [((0, 0), (0, 0)), ((30, 40), (30, 220)), ((30, 40), (45, 200)), ((60, 100), (60, 290)), ((60, 100), (20, 300)),
         ((80, -20), (75, 165)), ((89, 10), (85, 185)), ((89, 10), (40, 120)), ((0, 0), (80, 70)), ((20, 0), (25, 90))]
BEHIND = [((180 - o[0], o[1]), (180 - i[0], i[1])) for o, i in PAIRS[1:6]]
STEEP = [(0, 0), (30, 50), (60, 100), (80, 200), (89, 300)]
TINTS = {"specular_reflectance": (0.9, 0.7, 0.5)}
GLASS = dict(TINTS, specular_transmittance=(0.4, 0.6, 0.8))
PAINT = dict(TINTS, diffuse_reflectance=(0.2, 0.5, 0.8))
METAL = {"eta": (0.2, 0.9, 1.6), "k": (3.9, 2.4, 1.9)}
OILED = {"int_ior": 1.4, "ext_ior": 1.1, "sigma_a": (0.1, 0.5, 1.2), "thickness": 0.7, **TINTS}
BLACK = (0, 0, 0)


def axes(distribution, u, v):
    return {"distribution": distribution, "alpha_u": u, "alpha_v": v}


CASES = [
    ("diffuse", {}), ("diffuse", {"reflectance": (0.2, 0.5, 0.8)}),
    ("conductor", {}), ("conductor", {**METAL, **TINTS}), ("conductor", {"eta": (0.5, 1.0, 2.0)}),
    ("conductor", {"k": (0.5, 2.0, 4.0)}),
    ("roughconductor", {}), ("roughconductor", {**axes("ggx", 0.2, 0.5), **METAL, **TINTS}),
    ("roughconductor", {**axes("beckmann", 0.6, 0.25), **METAL, **TINTS}),
    ("roughconductor", {"distribution": "ggx", "alpha": 0.4, "sample_visible": False, **METAL}),
    ("roughconductor", {"distribution": "beckmann", "alpha": 0.5, "sample_visible": False, **METAL}),
    ("dielectric", {}), ("dielectric", {"int_ior": 1.5, "ext_ior": 1.1, **GLASS}),
    ("dielectric", {"int_ior": 1.1, "ext_ior": 2.1, **GLASS}),
    ("dielectric", {"int_ior": "diamond", "ext_ior": "water"}),
    ("thindielectric", {}), ("thindielectric", {"int_ior": 2.2, "ext_ior": 1.1, **GLASS}),
    ("thindielectric", {"int_ior": 1.5, "ext_ior": 1.0, **GLASS}),
    ("roughdielectric", {}), ("roughdielectric", {**axes("ggx", 0.3, 0.6), "int_ior": 1.5, "ext_ior": 1.1, **GLASS}),
    ("roughdielectric", {**axes("beckmann", 0.5, 0.2), "int_ior": 2.2, "ext_ior": 1.0, **GLASS}),
    ("roughdielectric", {"distribution": "ggx", "alpha": 0.4, "sample_visible": False, "int_ior": 1.1, "ext_ior": 1.5,
                         **GLASS}),
    ("plastic", {}), ("plastic", {"int_ior": 1.5, "ext_ior": 1.1, "nonlinear": True, **PAINT}),
    ("plastic", {"int_ior": 2.2, "ext_ior": 1.0, "nonlinear": False, **PAINT}),
    ("roughplastic", {}),
    ("roughplastic", {"distribution": "ggx", "alpha": 0.3, "int_ior": 1.5, "ext_ior": 1.1, "nonlinear": True, **PAINT}),
    ("roughplastic", {"distribution": "beckmann", "alpha": 0.5, "int_ior": 2.2, "ext_ior": 1.0, "nonlinear": False,
                      **PAINT}),
    ("roughplastic", {"distribution": "ggx", "alpha": 0.4, "sample_visible": False, "int_ior": 1.5, "ext_ior": 1.0,
                      "diffuse_reflectance": BLACK}),
    ("roughplastic", {"diffuse_reflectance": BLACK}),
    ("phong", {}), ("phong", {"exponent": 12.0, "diffuse_reflectance": (0.1, 0.3, 0.2),
                              "specular_reflectance": (0.7, 0.4, 0.5)}),
    ("phong", {"exponent": 50.0, "diffuse_reflectance": (0.6, 0.3, 0.2), "specular_reflectance": (0.6, 0.8, 0.5)}),
    ("layered", {}, "diffuse", {}), ("layered", {"sigma_a": (0.1, 0.5, 1.2)}, "diffuse", {}),
    ("layered", OILED, "diffuse", {"reflectance": (0.3, 0.6, 0.9)}),
    ("layered", OILED, "conductor", {**METAL, "specular_reflectance": (0.9, 0.8, 0.6)}),
    ("layered", OILED, "roughconductor", {**axes("ggx", 0.5, 0.25), **METAL, "specular_reflectance": (0.9, 0.8, 0.6)}),
    ("layered", {**OILED, "specular_reflectance": BLACK}, "roughconductor",
     {"distribution": "beckmann", "alpha": 0.4, "sample_visible": False, **METAL}),
    ("layered", OILED, "phong", {"exponent": 12.0, "diffuse_reflectance": (0.1, 0.3, 0.2),
                                 "specular_reflectance": (0.7, 0.4, 0.5)}),
    *principled.CASES,
]


def xml(kind, p, inside=""):
    out = f"<bsdf type='{kind}'>"
    for name, value in p.items():
        if isinstance(value, bool):
            out += f"<boolean name='{name}' value='{str(value).lower()}'/>"
        elif isinstance(value, tuple):
            out += f"<rgb name='{name}' value='{', '.join(map(repr, value))}'/>"
        else:
            out += f"<{'string' if isinstance(value, str) else 'float'} name='{name}' value='{value}'/>"
    return out + inside + "</bsdf>"


def numbers(values):
    return " ".join(f"{v:.9g}" for v in values)


def transmitted_pairs(b):
    """Near the direction that Snell's law gives, and a few degrees from it."""
    for theta, phi, turn, tilt in ((0, 0, 0, 0), (30, 40, 170, 4), (50, 100, 180, -6), (60, 20, 190, 8),
                                   (80, 70, 175, 3), (89, 130, 182, 5)):
        for side in (1, -1):
            n_o, n_i = (b.n[1], b.n[0]) if side > 0 else b.n
            sine = min(1.0, n_o / n_i * math.sin(math.radians(theta)))
            beyond = round(min(85.0, math.degrees(math.asin(sine)) + tilt), 3)
            o, i = (theta, phi), (180 - beyond, phi + turn)
            pair = (o, i) if side > 0 else ((180 - theta, phi), (beyond, phi + turn))
            if b.parts(*map(direction, pair)):
                yield pair


def rows(kind, p, b):
    pairs = [] if kind in ("conductor", "dielectric", "thindielectric") else list(PAIRS)
    if kind == "roughdielectric":
        pairs += BEHIND + list(transmitted_pairs(b))
    if kind == "principled" and b.glass > 0:
        pairs += BEHIND + list(transmitted_pairs(b))
    if kind == "principledthin":
        pairs += BEHIND + [(o, (180 - i[0], i[1])) for o, i in PAIRS] + [((180 - o[0], o[1]), i) for o, i in PAIRS]
    has_pdf = kind in ("roughconductor", "roughdielectric", "principled", "principledthin") or BLACK in (p.get("diffuse_reflectance"),
                                                                         p.get("specular_reflectance"))
    for pair in pairs if hasattr(b, "eval") else []:
        o, i = map(direction, pair)
        where = "\t" + numbers(pair[0] + pair[1]) + "\t"
        yield "eval" + where + numbers(b.eval(o, i))
        if has_pdf:
            yield "pdf" + where + numbers([b.pdf(o, i)])
    for angles in STEEP:
        if getattr(b, "mirror", None):
            yield "mirror\t" + numbers(angles) + "\t" + numbers(b.mirror(direction(angles)))
    for theta, phi in STEEP if hasattr(b, "lobes") else []:
        for angles in ((theta, phi), (180 - theta, phi)):
            for name, lobe in zip(("reflection", "refraction"), b.lobes(direction(angles))):
                wi, probability, radiance, flux, eta = lobe
                yield f"{name}\t" + numbers(angles) + "\t" + numbers((*wi, probability, *radiance, *flux, eta))
    isotropic_metal = kind == "roughconductor" and "alpha" in p
    if isotropic_metal or kind in ("plastic", "layered"):
        for angles in STEEP[::2]:
            albedo = b.albedo(direction(angles)) if hasattr(b, "albedo") else None
            if albedo is not None:
                yield "albedo\t" + numbers(angles) + "\t" + numbers([albedo])


def main():
    check_facets()
    out = sys.stdout
    out.write("# By bsdfs.py. A case has the XML of a BSDF; below it, at angles in degrees (from the normal, "
              "azimuth):\n"
              "# eval: wo wi, f. pdf: wo wi, of sampling. mirror: wo, share mirrored. albedo: wo, share of red "
              "that eval scatters.\n"
              "# reflection, refraction: wo, direction, probability, weight of radiance, of importance, index\n"
              "# entered / left.\n")
    for kind, p, *base in CASES:
        p_numbers = {k: NAMED.get(v, v) if isinstance(v, str) else v for k, v in p.items()}
        if base:
            b, text = Layered(p_numbers, KINDS[base[0]], base[1]), xml(kind, p, xml(*base))
        else:
            b, text = KINDS[kind](p_numbers), xml(kind, p)
        out.write("case\t" + text + "\n")
        out.writelines(line + "\n" for line in rows(kind, p, b))


if __name__ == "__main__":
    main()
