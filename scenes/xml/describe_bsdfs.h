// BSDFs as a scene file has them: one function a plugin, which says its name and its parameters, in the order they are
// written in. `p` is who asks: PluginWriter, PluginReader, which gets the defaults and leaves what the file gives, or
// PluginRows, the list of names and meanings. Defaults are those of the descriptions.
#pragma once

#include "scenes/description/material_description.h"
#include "scenes/xml/param_type.h"

namespace photonproof {

template <class P, class Interface>
void describe_iors(P& p, Interface& d) {
  p.ior("int_ior", d.int_ior, "index of refraction behind the surface");
  p.ior("ext_ior", d.ext_ior, "index of refraction before it");
}

template <class P>
void describe_specular(P& p, Colour& reflectance) {
  p.colour_map("specular_reflectance", reflectance, scene_xml::kShare, "factor of what is mirrored");
}

template <class P>
void describe_transmitted(P& p, Colour& transmittance) {
  p.colour_map("specular_transmittance", transmittance, scene_xml::kShare, "factor of what is refracted");
}

template <class P, class Rough>
void describe_facets(P& p, Rough& d) {
  p.choice("distribution", d.distribution,
           {{"beckmann", MicrofacetDistribution::beckmann}, {"ggx", MicrofacetDistribution::ggx}},
           "of the microfacets' normals");
  p.boolean("sample_visible", d.sample_visible, "draws the normals that are seen");
}

template <class P>
void describe_maps(P& p, MappedNormalsDescription& d) {
  p.boolean("flip_invalid_normals", d.flip_invalid_normals, "mirrors normals that are turned away from the viewer");
  p.boolean("use_shadowing_function", d.use_shadowing_function, "bumps shadow each other");
}

template <class P>
void describe(P& p, DiffuseDescription& d) {
  p.plugin("diffuse", "Lambertian, black from behind");
  p.colour_map("reflectance", d.reflectance, scene_xml::kShare, "albedo");
}

template <class P>
void describe(P& p, ConductorDescription& d) {
  p.plugin("conductor", "smooth metal, black from behind");
  p.metal(d.ior);
  describe_specular(p, d.specular_reflectance);
}

template <class P>
void describe(P& p, RoughConductorDescription& d) {
  p.plugin("roughconductor", "rough metal, black from behind");
  describe_facets(p, d);
  p.roughness(d.alpha_u, d.alpha_v);
  p.metal(d.ior);
  describe_specular(p, d.specular_reflectance);
}

template <class P>
void describe(P& p, DielectricDescription& d) {
  p.plugin("dielectric", "smooth glass; normals point outside");
  describe_iors(p, d);
  describe_specular(p, d.specular_reflectance);
  describe_transmitted(p, d.specular_transmittance);
  p.optional_integer("priority", d.priority, 0, 1'000'000, "extension: where bodies overlap, the highest counts");
}

template <class P>
void describe(P& p, ThinDielectricDescription& d) {
  p.plugin("thindielectric", "a pane: both sides at once");
  describe_iors(p, d);
  describe_specular(p, d.specular_reflectance);
  describe_transmitted(p, d.specular_transmittance);
}

template <class P>
void describe(P& p, RoughDielectricDescription& d) {
  p.plugin("roughdielectric", "rough glass; normals point outside");
  describe_facets(p, d);
  p.roughness(d.alpha_u, d.alpha_v);
  describe_iors(p, d);
  describe_specular(p, d.specular_reflectance);
  describe_transmitted(p, d.specular_transmittance);
}

template <class P, class Plastic>
void describe_plastic(P& p, Plastic& d) {
  describe_iors(p, d);
  p.colour_map("diffuse_reflectance", d.diffuse_reflectance, scene_xml::kShare, "albedo below the coat");
  describe_specular(p, d.specular_reflectance);
  p.boolean("nonlinear", d.nonlinear, "colours shift with every reflection inside");
}

template <class P>
void describe(P& p, PlasticDescription& d) {
  p.plugin("plastic", "diffuse below a smooth clear coat");
  describe_plastic(p, d);
}

template <class P>
void describe(P& p, RoughPlasticDescription& d) {
  p.plugin("roughplastic", "diffuse below a rough clear coat");
  describe_facets(p, d);
  p.positive("alpha", d.alpha, "roughness");
  describe_plastic(p, d);
}

template <class P>
void describe(P& p, PhongDescription& d) {
  p.plugin("phong", "extension: modified Phong, parameters of Mitsuba 0.6");
  p.number_map("exponent", d.exponent, scene_xml::kNotNegative, "of the cosine to the mirror direction");
  p.colour_map("diffuse_reflectance", d.diffuse_reflectance, scene_xml::kShare, "albedo of the diffuse part");
  p.colour_map("specular_reflectance", d.specular_reflectance, scene_xml::kShare, "albedo of the glossy part");
}

template <class P>
void describe(P& p, LayeredDescription& d) {
  p.plugin("layered", "extension: a lacquer; `eta` and `k` of a metal below are its own, seen through the lacquer");
  describe_iors(p, d);
  p.colour("sigma_a", d.sigma_a, scene_xml::kNotNegative, "absorption of the lacquer, per scene unit");
  p.number("thickness", d.thickness, scene_xml::kNotNegative, "scene units");
  describe_specular(p, d.specular_reflectance);
  p.bsdf(d.base, "a BSDF that neither transmits nor nests");
}

template <class P>
void describe(P& p, TwoSidedDescription& d) {
  p.plugin("twosided", "shows itself, or the second, behind too");
  p.one_or_two_bsdfs(d.front, d.back, "one or two BSDFs that do not transmit");
}

template <class P>
void describe(P& p, MaskDescription& d) {
  p.plugin("mask", "holes");
  p.number_map("opacity", d.opacity, scene_xml::kShare, "share of the surface that is there");
  p.bsdf(d.nested, "a BSDF");
}

template <class P>
void describe(P& p, BlendDescription& d) {
  p.plugin("blendbsdf", "a mixture");
  p.require("weight", "a number or a texture");
  p.number_map("weight", d.weight, scene_xml::kShare, "share of the second");
  p.two_bsdfs(d.first, d.second, "two BSDFs");
}

template <class P>
void describe(P& p, NullDescription&) {
  p.plugin("null", "no surface, a border between media");
}

template <class P>
void describe(P& p, BumpMapDescription& d) {
  p.plugin("bumpmap", "normals of the surface that a texture displaces");
  p.nested_texture(d.height, "a texture");
  p.number("scale", d.scale, scene_xml::kAny, "factor of the texture's heights");
  describe_maps(p, d.normal_options);
  p.bsdf(d.nested, "a BSDF");
}

template <class P>
void describe(P& p, NormalMapDescription& d) {
  p.plugin("normalmap", "normals from a texture");
  p.require("normalmap", "a texture");
  p.texture("normalmap", d.normals, "n = 2 rgb - 1 in the frame of dp/du");
  describe_maps(p, d.normal_options);
  p.bsdf(d.nested, "a BSDF");
}

}  // namespace photonproof
