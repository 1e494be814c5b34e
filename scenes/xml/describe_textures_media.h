// Textures, media and phase functions as a scene file has them (describe_bsdfs.h says how).
#pragma once

#include "scenes/description/description.h"
#include "scenes/xml/param_type.h"

namespace photonproof {

template <class P>
void describe(P& p, BitmapDescription& d) {
  p.plugin("bitmap", "an image over the unit square of uv, its first row at v = 0");
  p.file("filename", d.filename, "the name of an image");
  p.boolean("raw", d.raw, "8-bit values are numbers, not sRGB");
  p.choice("filter_type", d.filter, {{"bilinear", TextureFilter::bilinear}, {"nearest", TextureFilter::nearest}},
           "between texels");
  p.choice("wrap_mode", d.wrap,
           {{"repeat", TextureWrap::repeat}, {"mirror", TextureWrap::mirror}, {"clamp", TextureWrap::clamp}},
           "beyond the unit square");
  p.transform("to_uv", d.to_uv, "applied to uv before the look-up");
}

template <class P>
void describe(P& p, CheckerboardDescription& d) {
  p.plugin("checkerboard", "squares of half a unit of uv");
  p.colour_map("color0", d.color0, scene_xml::kNotNegative, "where both halves agree");
  p.colour_map("color1", d.color1, scene_xml::kNotNegative, "elsewhere");
  p.transform("to_uv", d.to_uv, "applied to uv before the look-up");
}

template <class P>
void describe(P& p, IsotropicDescription&) {
  p.plugin("isotropic", "the same in all directions; when none is named");
}

template <class P>
void describe(P& p, HenyeyGreensteinDescription& d) {
  p.plugin("hg", "Henyey and Greenstein 1941");
  p.number("g", d.g, {-1, 1, "more than -1 and less than 1", true, true}, "mean cosine, above 0 forward");
}

template <class P>
void describe(P& p, HomogeneousDescription& d) {
  p.plugin("homogeneous", "the same everywhere");
  p.colour("sigma_t", d.sigma_t, scene_xml::kNotNegative, "extinction per scene unit");
  p.colour("albedo", d.albedo, scene_xml::kShare, "share of it that scatters");
  p.number("scale", d.scale, scene_xml::kNotNegative, "factor of `sigma_t`");
  p.nested("phase", 1, "a phase function");
}

}  // namespace photonproof
