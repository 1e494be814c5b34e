#include "scenes/dialect/bsdf_stand_ins.h"

#include <algorithm>
#include <cmath>

#include "scenes/base/edit_distance.h"
#include "scenes/dialect/hair_stand_in.h"

namespace photonproof::scene_xml {
namespace {

bool is_bsdf(const Element& element) {
  return element.tag == "bsdf" || (element.tag == "ref" && value_of(element, "name").empty());
}

/// The numbers of a `weights` parameter; empty where one is none.
std::vector<double> weights_of(const std::string& text) {
  std::vector<double> weights;
  for (const std::string_view word : split_list(text)) {
    const auto parsed = parse_number(word);
    if (!parsed.value || *parsed.value < 0) return {};
    weights.push_back(*parsed.value);
  }
  return weights;
}

/// A weighted sum of n BSDFs as n - 1 blends of two. Weights below a sum of 1 leave the rest black; above, they are
/// scaled to it, as in Mitsuba 0.6.
void replace_mixture(Element& bsdf) {
  std::vector<double> weights =
      weights_of(parameter_of(bsdf, "weights") ? value_of(*parameter_of(bsdf, "weights"), "value") : "");
  std::vector<Element> nested;
  for (const Element& child : bsdf.children)
    if (is_bsdf(child)) nested.push_back(child);
  if (weights.empty() || weights.size() != nested.size()) return;  // the reader tells that it does not know the plugin
  double sum = 0;
  for (const double weight : weights) sum += weight;
  if (!(sum > 0)) return;
  if (sum < 1) {
    Element black = new_element(bsdf, "bsdf", "diffuse");
    add_parameter(black, "rgb", "reflectance", "0");
    nested.push_back(black);
    weights.push_back(1 - sum);
    sum = 1;
  }
  Element mixed = nested[0];
  double so_far = weights[0];
  for (std::size_t i = 1; i < nested.size(); ++i) {
    so_far += weights[i];
    Element blend = new_element(bsdf, "bsdf", "blendbsdf");
    add_parameter(blend, "float", "weight", format_number(so_far > 0 ? weights[i] / so_far : 0.5));
    blend.children.push_back(std::move(mixed));
    blend.children.push_back(nested[i]);
    mixed = std::move(blend);
  }
  for (const Attribute& attribute : bsdf.attributes)
    if (attribute.name != "type") set_attribute(mixed, attribute.name, attribute.value);
  bsdf = std::move(mixed);
}

/// A rough coat over a diffuse BSDF is a rough plastic; over others the coat becomes smooth.
void replace_rough_coating(Element& bsdf, StandInNotes& notes) {
  const auto base = std::ranges::find_if(bsdf.children, is_bsdf);
  const bool over_diffuse = base != bsdf.children.end() && value_of(*base, "type") == "diffuse";
  if (!over_diffuse) {
    notes.add_stand_in(bsdf, "layered", "its coat is smooth");
    set_attribute(bsdf, "type", "layered");
    for (const char* name : {"alpha", "distribution"}) take_parameter(bsdf, name);
    return;
  }
  notes.add_stand_in(bsdf, "roughplastic", "the coat absorbs nothing");
  set_attribute(bsdf, "type", "roughplastic");
  const Element diffuse = *base;
  bsdf.children.erase(base);
  for (Element parameter : diffuse.children)
    if (value_of(parameter, "name") == "reflectance") {
      set_attribute(parameter, "name", "diffuse_reflectance");
      bsdf.children.push_back(std::move(parameter));
    }
  for (const char* name : {"thickness", "sigma_a", "specular_sampling_weight"}) take_parameter(bsdf, name);
}

/// Ward's lobe of width alpha about the half vector is near a Phong lobe of exponent 2 / alpha^2 - 2 about it, as
/// Walter et al. 2007 say of Beckmann's. About the mirror direction it is twice as wide: a fourth of the exponent.
void replace_ward(Element& bsdf, StandInNotes& notes) {
  notes.add_stand_in(bsdf, "phong", "its highlight is round and has no Fresnel edge");
  set_attribute(bsdf, "type", "phong");
  double alpha = 0.1;
  for (const char* name : {"alpha", "alpha_u", "alpha_v"}) {
    const Element given = take_parameter(bsdf, name);
    const auto parsed = given.tag.empty() ? parse_number("") : parse_number(value_of(given, "value"));
    if (parsed.value && *parsed.value > 0) alpha = *parsed.value;
  }
  take_parameter(bsdf, "variant");
  const double about_half_vector = std::max(0.0, 2 / (alpha * alpha) - 2);
  add_parameter(bsdf, "float", "exponent", format_number(std::min(about_half_vector / 4, 1e6)));
}

void replace_distribution(Element& bsdf, StandInNotes& notes) {
  Element* distribution = parameter_of(bsdf, "distribution");
  if (!distribution) return;
  const std::string name = value_of(*distribution, "value");
  if (name != "as" && name != "phong") return;
  notes.add(*distribution, "the microfacet distribution " + in_quotes(name) + " is rendered as 'beckmann'");
  set_attribute(*distribution, "value", "beckmann");
}

/// Unpolarised light: half of what passes, straight on.
void replace_polarizer(Element& bsdf, StandInNotes& notes) {
  notes.add_stand_in(bsdf, "blendbsdf", "it passes half of the light, without polarisation");
  Element sheet = new_element(bsdf, "bsdf", "thindielectric"), black = new_element(bsdf, "bsdf", "diffuse");
  add_parameter(sheet, "float", "int_ior", "1");
  add_parameter(sheet, "float", "ext_ior", "1");
  if (Element transmittance = take_parameter(bsdf, "transmittance"); !transmittance.tag.empty()) {
    set_attribute(transmittance, "name", "specular_transmittance");
    sheet.children.push_back(std::move(transmittance));
  }
  add_parameter(black, "rgb", "reflectance", "0");
  const bool polarizes = value_of(take_parameter(bsdf, "polarizing"), "value") != "false";
  set_attribute(bsdf, "type", "blendbsdf");
  bsdf.children.clear();
  add_parameter(bsdf, "float", "weight", polarizes ? "0.5" : "0");
  bsdf.children.push_back(std::move(sheet));
  bsdf.children.push_back(std::move(black));
}

/// A normal that is the same everywhere becomes a texture. A nested texture needs no name.
void replace_normal_map(Element& bsdf) {
  for (Element& child : bsdf.children)
    if (child.tag == "texture" && !child.find("name")) set_attribute(child, "name", "normalmap");
  Element* normal = parameter_of(bsdf, "normalmap");
  if (normal == nullptr || (normal->tag != "rgb" && value_of(*normal, "type") != "srgb")) return;
  const Element* colour = normal->tag == "rgb" ? normal : parameter_of(*normal, "color");
  if (colour == nullptr) return;
  Element board = new_element(*normal, "texture", "checkerboard");
  set_attribute(board, "name", "normalmap");
  for (const char* half : {"color0", "color1"}) add_parameter(board, "rgb", half, value_of(*colour, "value"));
  *normal = std::move(board);
}

}  // namespace

void replace_bsdf(Element& bsdf, StandInNotes& notes) {
  const std::string type = value_of(bsdf, "type");
  replace_distribution(bsdf, notes);
  if (type == "mixturebsdf") return replace_mixture(bsdf);
  if (type == "roughcoating") return replace_rough_coating(bsdf, notes);
  if (type == "ward") return replace_ward(bsdf, notes);
  if (type == "polarizer" || type == "circular") return replace_polarizer(bsdf, notes);
  if (type == "hair") return replace_hair(bsdf, notes);
  if (type == "pplastic") {
    take_parameter(bsdf, "alpha_v");
    rename_parameter(bsdf, "alpha_u", "alpha");
  }
  if (type == "coating") {
    notes.add_stand_in(bsdf, "layered", "light is also reflected several times below the coat");
    set_attribute(bsdf, "type", "layered");
    take_parameter(bsdf, "specular_sampling_weight");
  }
  if (type == "roughdiffuse") {
    notes.add_stand_in(bsdf, "diffuse", "without roughness");
    set_attribute(bsdf, "type", "diffuse");
    for (const char* name : {"alpha", "use_fast_approx"}) take_parameter(bsdf, name);
  }
  if (type == "normalmap") replace_normal_map(bsdf);
}

}  // namespace photonproof::scene_xml
