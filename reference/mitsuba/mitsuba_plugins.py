"""Kinds of plugin that Mitsuba 3 lacks, written for its Python API. They follow docs/formats/scene.md."""


def register_plugins(mi, dr, names):
    """Registers the named ones. Call it after the variant is chosen."""
    for name in names:
        PLUGINS[name](mi, dr)


def register_fisheye(mi, dr):
    class Fisheye(mi.Sensor):
        """The angle from local +z is proportional to the distance from the image's middle; +y is up, +x is left."""

        def __init__(self, props):
            super().__init__(props)
            self.half_angle = dr.deg2rad(props["fov"]) / 2
            self.near, self.far = props["near_clip"], props["far_clip"]
            self.place = mi.Transform4f(props["to_world"].matrix if "to_world" in props else mi.ScalarTransform4f().matrix)

        def sample_ray(self, time, wavelength_sample, position_sample, aperture_sample, active=True):
            width, height = self.film().size()
            shorter = min(width, height)
            x = (position_sample.x - 0.5) * (2 * width / shorter)
            y = (position_sample.y - 0.5) * (2 * height / shorter)
            r = dr.sqrt(x * x + y * y)
            theta = r * self.half_angle
            across = dr.select(r > 0, dr.sin(theta) / dr.select(r > 0, r, 1), 0)
            ray = dr.zeros(mi.RayDifferential3f)
            direction = self.place @ mi.Vector3f(-x * across, -y * across, dr.cos(theta))
            ray.d = dr.normalize(direction)
            ray.o = (self.place @ mi.Point3f(0, 0, 0)) + ray.d * self.near
            ray.maxt = mi.Float(self.far - self.near)
            ray.time = time
            return ray, mi.Spectrum(dr.select(r <= 1, mi.Float(1), mi.Float(0)))

        def sample_ray_differential(self, time, wavelength_sample, position_sample, aperture_sample, active=True):
            return self.sample_ray(time, wavelength_sample, position_sample, aperture_sample, active)

    mi.register_sensor("fisheye", Fisheye)


def register_ies(mi, dr):
    class Ies(mi.Emitter):
        """A point light whose candela an image gives: its columns go around z from x towards y, its rows from -z up."""

        def __init__(self, props):
            super().__init__(props)
            place = props["to_world"] if "to_world" in props else mi.ScalarTransform4f()
            self.place = mi.Transform4f(place.matrix)
            self.intensity = mi.Spectrum(props["intensity"])
            bitmap = mi.Bitmap(props["filename"]).convert(mi.Bitmap.PixelFormat.Y, mi.Struct.Type.Float32, srgb_gamma=False)
            self.width, self.height = bitmap.size()
            self.candela = mi.Texture2f(mi.TensorXf(bitmap), wrap_mode=dr.WrapMode.Repeat)
            self.m_flags = mi.EmitterFlags.DeltaPosition

        def intensity_towards(self, direction, active):
            local = dr.normalize(self.place.inverse() @ direction)
            u = dr.atan2(local.y, local.x) / (2 * dr.pi) + 0.5 / self.width
            rise = dr.atan2(local.z, dr.sqrt(local.x * local.x + local.y * local.y)) / dr.pi + 0.5
            v = (rise * (self.height - 1) + 0.5) / self.height
            return self.intensity * self.candela.eval(mi.Point2f(u, v), active)[0]

        def sample_direction(self, it, sample, active=True):
            ds = mi.DirectionSample3f()
            ds.p = self.place @ mi.Point3f(0, 0, 0)
            ds.n, ds.uv, ds.time = mi.Normal3f(0), mi.Point2f(0), it.time
            ds.pdf, ds.delta = mi.Float(1), mi.Bool(True)
            ds.emitter = mi.EmitterPtr(self) if dr.is_jit_v(mi.Float) else self
            ds.d = ds.p - it.p
            ds.dist = dr.norm(ds.d)
            ds.d /= ds.dist
            return ds, self.intensity_towards(-ds.d, active) / (ds.dist * ds.dist)

        def pdf_direction(self, it, ds, active=True):
            return mi.Float(0)

        def eval_direction(self, it, ds, active=True):
            return mi.Spectrum(0)

        def eval(self, si, active=True):
            return mi.Spectrum(0)

        def bbox(self):
            return mi.ScalarBoundingBox3f()

    mi.register_emitter("ies", Ies)


def register_phong(mi, dr):
    class Phong(mi.BSDF):
        """Modified Phong, one-sided: diffuse / pi + specular (n + 2) / (2 pi) cos^n (Lafortune and Willems 1994)."""

        def __init__(self, props):
            super().__init__(props)
            self.diffuse = props.get_texture("diffuse_reflectance")
            self.specular = props.get_texture("specular_reflectance")
            self.exponent = props.get_unbounded_texture("exponent")
            self.m_components = [mi.BSDFFlags.GlossyReflection | mi.BSDFFlags.FrontSide,
                                 mi.BSDFFlags.DiffuseReflection | mi.BSDFFlags.FrontSide]
            self.m_flags = self.m_components[0] | self.m_components[1]

        def parts(self, si, active):
            """Both colours, whose sum is at most 1, the exponent, and the share of samples that are glossy."""
            diffuse, specular = self.diffuse.eval(si, active), self.specular.eval(si, active)
            scale = 1 / dr.maximum(dr.max(diffuse + specular), 1)
            gloss, base = dr.mean(specular), dr.mean(diffuse)
            share = dr.select(gloss + base > 0, gloss / dr.maximum(gloss + base, 1e-20), 0.5)
            return diffuse * scale, specular * scale, dr.clip(self.exponent.eval_1(si, active), 0, 1e7), share

        def lobe(self, wi, wo, exponent):
            """cos^n of the angle between wo and the mirror direction of wi."""
            cosine = dr.maximum(wo.z * wi.z - wo.x * wi.x - wo.y * wi.y, 0)
            return dr.select(cosine > 0, cosine ** exponent, dr.select(exponent == 0, 1, 0))

        def value_and_density(self, si, wo, active):
            diffuse, specular, n, share = self.parts(si, active)
            power = self.lobe(si.wi, wo, n)
            both = active & (si.wi.z > 0) & (wo.z > 0)
            value = (diffuse / dr.pi + specular * ((n + 2) / (2 * dr.pi) * power)) * wo.z
            density = share * (n + 1) / (2 * dr.pi) * power + (1 - share) * wo.z / dr.pi
            return dr.select(both, value, 0), dr.select(both, density, 0)

        def eval(self, ctx, si, wo, active=True):
            return self.value_and_density(si, wo, active)[0]

        def pdf(self, ctx, si, wo, active=True):
            return self.value_and_density(si, wo, active)[1]

        def eval_pdf(self, ctx, si, wo, active=True):
            return self.value_and_density(si, wo, active)

        def sample(self, ctx, si, sample1, sample2, active=True):
            _, _, n, share = self.parts(si, active)
            cosine = (1 - sample2.x) ** (1 / (n + 1))
            sine = dr.sqrt(dr.maximum(1 - cosine * cosine, 0))
            turn = 2 * dr.pi * sample2.y
            around = mi.Frame3f(mi.Vector3f(-si.wi.x, -si.wi.y, si.wi.z))
            glossy = around.to_world(mi.Vector3f(sine * dr.cos(turn), sine * dr.sin(turn), cosine))
            is_glossy = sample1 < share
            bs = dr.zeros(mi.BSDFSample3f)
            bs.wo = dr.select(is_glossy, glossy, mi.warp.square_to_cosine_hemisphere(sample2))
            value, bs.pdf = self.value_and_density(si, bs.wo, active)
            bs.eta = 1
            bs.sampled_type = dr.select(is_glossy, mi.UInt32(+mi.BSDFFlags.GlossyReflection),
                                        mi.UInt32(+mi.BSDFFlags.DiffuseReflection))
            bs.sampled_component = dr.select(is_glossy, mi.UInt32(0), mi.UInt32(1))
            found = bs.pdf > 0
            return bs, dr.select(found, value / dr.select(found, bs.pdf, 1), 0)

    mi.register_bsdf("phong", Phong)


def register_mixture(mi, dr):
    class Mixture(mi.BSDF):
        """The first BSDF times 1 - weight and the second times weight. A mirror's sample has the mirror's density alone."""

        def __init__(self, props):
            super().__init__(props)
            self.weight = props.get_texture("weight")
            self.nested = [value for value in props.objects().values() if isinstance(value, mi.BSDF)] if isinstance(
                props.objects(), dict) else [value for _, value in props.objects() if isinstance(value, mi.BSDF)]
            self.m_components = [bsdf.flags(i) for bsdf in self.nested for i in range(bsdf.component_count())]
            self.m_flags = 0
            for flags in self.m_components:
                self.m_flags |= flags

        def shares(self, si, active):
            weight = dr.clip(self.weight.eval_1(si, active), 0, 1)
            return 1 - weight, weight

        def eval(self, ctx, si, wo, active=True):
            return self.eval_pdf(ctx, si, wo, active)[0]

        def pdf(self, ctx, si, wo, active=True):
            return self.eval_pdf(ctx, si, wo, active)[1]

        def eval_pdf(self, ctx, si, wo, active=True):
            value, density = mi.Spectrum(0), mi.Float(0)
            for bsdf, share in zip(self.nested, self.shares(si, active)):
                f, p = bsdf.eval_pdf(ctx, si, wo, active)
                value += share * f
                density += share * p
            return value, density

        def sample(self, ctx, si, sample1, sample2, active=True):
            first, second = self.shares(si, active)
            picks_first = sample1 >= second
            bs_0, value_0 = self.nested[0].sample(ctx, si, (sample1 - second) / dr.maximum(first, 1e-20), sample2,
                                                  active & picks_first)
            bs_1, value_1 = self.nested[1].sample(ctx, si, sample1 / dr.maximum(second, 1e-20), sample2,
                                                  active & (sample1 < second))
            bs, value = dr.select(picks_first, bs_0, bs_1), dr.select(picks_first, value_0, value_1)
            is_delta = mi.has_flag(bs.sampled_type, mi.BSDFFlags.Delta)
            all_value, all_density = self.eval_pdf(ctx, si, bs.wo, active)
            found = all_density > 0
            mixed = dr.select(found, all_value / dr.select(found, all_density, 1), 0)
            bs.pdf = dr.select(is_delta, bs.pdf * dr.select(picks_first, first, second), all_density)
            return bs, dr.select(is_delta, value, mixed)

    mi.register_bsdf("mixture", Mixture)


PLUGINS = {"fisheye": register_fisheye, "ies": register_ies, "phong": register_phong, "mixture": register_mixture}
