#include "scenes/parser/plugin_rows.h"

#include "scenes/base/text_numbers.h"
#include "scenes/description/named_ior.h"

namespace photonproof::scene_xml {
namespace {

std::string text_of(const Range& range) {
  if (range.words != nullptr) return range.words;
  if (range.low == -kUnbounded) return "";
  if (range.high == kUnbounded) return "at least " + format_number(range.low);
  return format_number(range.low) + " to " + format_number(range.high);
}

std::string text_of(const Vec3d& v) {
  if (v.x == v.y && v.y == v.z) return format_number(v.x);
  return "(" + format_number(v.x) + ", " + format_number(v.y) + ", " + format_number(v.z) + ")";
}

/// The name of an index, the last one where several fit.
std::string ior_text(double ior) {
  std::string text = format_number(ior);
  for (const std::string& name : ior_names())
    if (*ior_named(name) == ior) text = name;
  return text;
}

std::string with_texture(const std::string& values) { return values + (values.empty() ? "" : ", ") + "or a texture"; }

}  // namespace

void PluginRows::add(const char* name, ParamType as, const std::string& fallback, const std::string& values,
                     const char* what) {
  rows.push_back({name, as, required_ ? "required" : fallback, values, what});
  required_ = false;
}

void PluginRows::boolean(const char* name, bool v, const char* what) {
  add(name, ParamType::boolean, v ? "true" : "false", "", what);
}

void PluginRows::integer(const char* name, std::int64_t v, std::int64_t low, std::int64_t high, const char* what) {
  add(name, ParamType::integer, std::to_string(v), std::to_string(low) + " to " + std::to_string(high), what);
}

void PluginRows::optional_integer(const char* name, const std::optional<int>&, std::int64_t low, std::int64_t high,
                                  const char* what) {
  add(name, ParamType::integer, "none", std::to_string(low) + " to " + std::to_string(high), what);
}

void PluginRows::number(const char* name, double v, const Range& range, const char* what) {
  add(name, ParamType::number, format_number(v), text_of(range), what);
}

void PluginRows::optional_number(const char* name, const std::optional<double>&, const Range& range, const char* what) {
  add(name, ParamType::number, "none", text_of(range), what);
}

void PluginRows::number_after(const char* name, double, double, const char* fallback_text, const char* what) {
  add(name, ParamType::number, fallback_text, "", what);
}

void PluginRows::positive(const char* name, double v, const char* what, double most, const char* unit) {
  const std::string end = most < kUnbounded ? " and at most " + format_number(most) + " " + unit : "";
  add(name, ParamType::number, format_number(v), "more than 0" + end, what);
}

void PluginRows::ior(const char* name, double v, const char* what) {
  add(name, ParamType::ior, ior_text(v), "0.001 to 1000, or a name", what);
}

void PluginRows::colour(const char* name, const RgbD& v, const Range& range, const char* what) {
  add(name, ParamType::colour, text_of(v), text_of(range), what);
}

void PluginRows::emission(const char* name, const RgbD& v, const char* what) {
  add(name, ParamType::emission, text_of(v), text_of(kNotNegative), what);
}

void PluginRows::colour_map(const char* name, const Colour& v, const Range& range, const char* what) {
  add(name, ParamType::colour_map, text_of(constant(v)), with_texture(text_of(range)), what);
}

void PluginRows::emission_map(const char* name, const Colour& v, const char* what) {
  add(name, ParamType::emission_map, text_of(constant(v)), with_texture(text_of(kNotNegative)), what);
}

void PluginRows::number_map(const char* name, const Scalar& v, const Range& range, const char* what) {
  add(name, ParamType::number_map, format_number(std::get<double>(v)), with_texture(text_of(range)), what);
}

void PluginRows::volume(const char* name, const VolumeColour& v, const Range& range, const char* what) {
  add(name, ParamType::volume, text_of(std::get<RgbD>(v)), text_of(range) + ", or a volume", what);
}

void PluginRows::volume_number(const char* name, const VolumeNumber& v, const Range& range, const char* what) {
  add(name, ParamType::volume, format_number(std::get<double>(v)), text_of(range) + ", or a volume", what);
}

void PluginRows::texture(const char* name, TextureIndex, const char* what) {
  add(name, ParamType::texture, "", "a texture", what);
}

void PluginRows::optional_texture(const char* name, const std::optional<TextureIndex>&, const char* what) {
  add(name, ParamType::texture, "none", "a texture", what);
}

void PluginRows::file(const char* name, const std::string&, const char* what) {
  required_ = true;
  add(name, ParamType::string, "", "", what);
}

void PluginRows::text(const char* name, const std::string& v, const char* what) { file(name, v, what); }

void PluginRows::point(const char* name, const Vec3d& v, const char* what) {
  add(name, ParamType::point, text_of(v), "", what);
}

void PluginRows::direction(const char* name, const Vec3d& v, const char* what) {
  add(name, ParamType::point, text_of(v), "not 0", what);
}

void PluginRows::transform(const char* name, const Transform&, const char* what) {
  add(name, ParamType::transform, "", "", what);
}

void PluginRows::metal(const std::optional<ComplexIor>&) {
  add("material", ParamType::string, "none", "none or a name", "`none` mirrors all light alike");
  add("eta", ParamType::colour, "0", text_of(kNotNegative), "in place of `material`: index of refraction");
  add("k", ParamType::colour, "1", text_of(kNotNegative), "in place of `material`: extinction");
  add("ext_eta", ParamType::ior, "1", "0.001 to 1000, or a name", "Mitsuba 0.6's index of refraction before the metal");
}

void PluginRows::roughness(const Scalar& alpha_u, const Scalar&) {
  const std::string fallback = format_number(std::get<double>(alpha_u)), values = with_texture("more than 0");
  add("alpha", ParamType::number_map, fallback, values, "roughness");
  add("alpha_u", ParamType::number_map, "`alpha`", values, "in place of `alpha`: along dp/du");
  add("alpha_v", ParamType::number_map, "`alpha`", values, "in place of `alpha`: along dp/dv");
}

void PluginRows::eta_or_specular(const std::optional<double>&, double specular) {
  add("eta", ParamType::number, "", "0.001 to 1000", "in place of `specular`: index inside / outside");
  add("specular", ParamType::number, format_number(specular), "0 to 1", "0.08 of it is reflected at normal incidence");
}

void PluginRows::sun(const Vec3d&, const Transform&, const char* what) {
  add("sun_direction", ParamType::point, "", "not 0", what);
  PlaceAndTime when;
  describe(*this, when);
}

void PluginRows::crop(const FilmDescription&) {
  for (const char* name : {"crop_offset_x", "crop_offset_y"})
    add(name, ParamType::integer, "0", "", "part of the film that is rendered");
  add("crop_width", ParamType::integer, "`width`", "", "part of the film that is rendered");
  add("crop_height", ParamType::integer, "`height`", "", "part of the film that is rendered");
}

void PluginRows::nested(const char* tag, std::size_t most, const char* what) {
  const NestedSpec spec{tag, most, what};
  // BSDFs are what messages name first.
  nested_specs.insert(spec.tag == "bsdf" ? nested_specs.begin() : nested_specs.end(), spec);
}

std::vector<ParamSpec> PluginRows::specs() const {
  std::vector<ParamSpec> specs;
  specs.reserve(rows.size());
  for (const ParamRow& row : rows) specs.push_back({row.name, row.type});
  return specs;
}

}  // namespace photonproof::scene_xml
