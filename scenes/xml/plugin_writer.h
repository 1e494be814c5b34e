// The visitor by which `describe` functions write every parameter of a plugin (scenes/description/description.h).
#pragma once

#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <type_traits>
#include <variant>

#include "scenes/description/description.h"
#include "scenes/description/param_type.h"
#include "scenes/xml/material_writer.h"
#include "scenes/xml/xml_writer.h"

namespace photonproof::inline scenes_xml {

class PluginWriter {
 public:
  /// `tag`, `id` and `name` are the element's.
  PluginWriter(MaterialWriter& materials, XmlWriter& xml, const char* tag, const std::string& id,
               const std::string& name = "")
      : materials_(materials), xml_(xml), tag_(tag), id_(id), name_(name) {}

  void plugin(const char* type, const char*) { xml_.open_plugin(tag_, type, id_, name_); }

  void boolean(const char* name, bool v, const char*) { xml_.boolean(name, v); }
  template <class Integer>
  void integer(const char* name, Integer v, std::int64_t, std::int64_t, const char*) {
    xml_.integer(name, v);
  }
  void optional_integer(const char* name, const std::optional<int>& v, std::int64_t, std::int64_t, const char*) {
    if (v) xml_.integer(name, *v);
  }
  void number(const char* name, double v, const scene_xml::Range&, const char*) { xml_.number(name, v); }
  void optional_number(const char* name, const std::optional<double>& v, const scene_xml::Range&, const char*) {
    if (v) xml_.number(name, *v);
  }
  void number_after(const char* name, double v, double, const char*, const char*) { xml_.number(name, v); }
  void positive(const char* name, double v, const char*, double = 0, const char* = "") { xml_.number(name, v); }
  void ior(const char* name, double v, const char*) { xml_.number(name, v); }
  void colour(const char* name, const RgbD& v, const scene_xml::Range&, const char*) { xml_.rgb(name, v); }
  void emission(const char* name, const RgbD& v, const char*) { xml_.rgb(name, v); }
  void colour_map(const char* name, const Colour& v, const scene_xml::Range&, const char*) { materials_.use(name, v); }
  void emission_map(const char* name, const Colour& v, const char*) { materials_.use(name, v); }
  void number_map(const char* name, const Scalar& v, const scene_xml::Range&, const char*) { materials_.use(name, v); }
  void volume(const char* name, const VolumeColour& v, const scene_xml::Range&, const char*) {
    materials_.use(name, v);
  }
  void volume_number(const char* name, const VolumeNumber& v, const scene_xml::Range&, const char*) {
    materials_.use(name, v);
  }
  void texture(const char* name, TextureIndex v, const char*) { materials_.use(name, v); }
  void optional_texture(const char* name, const std::optional<TextureIndex>& v, const char*) {
    if (v) materials_.use(name, *v);
  }
  template <class Value>
  void choice(const char* name, Value v, std::initializer_list<scene_xml::Word<std::type_identity_t<Value>>> words,
              const char*) {
    for (const auto& word : words)
      if (word.value == v) xml_.string(name, word.text);
  }
  void file(const char* name, const std::string& v, const char*) { xml_.string(name, v); }
  void text(const char* name, const std::string& v, const char*) { xml_.string(name, v); }
  void point(const char* name, const Vec3d& v, const char*) { xml_.point(name, v); }
  void direction(const char* name, const Vec3d& v, const char*) { xml_.point(name, v); }
  void transform(const char* name, const Transform& v, const char*) { xml_.transform(name, v); }

  void metal(const std::optional<ComplexIor>& ior) {
    if (!ior) return xml_.string("material", "none");
    xml_.rgb("eta", ior->eta);
    xml_.rgb("k", ior->k);
  }
  /// One `alpha` where both are the same: else a texture without an id would be written, and read, twice.
  void roughness(const Scalar& alpha_u, const Scalar& alpha_v) {
    if (alpha_u == alpha_v) return materials_.use("alpha", alpha_u);
    materials_.use("alpha_u", alpha_u);
    materials_.use("alpha_v", alpha_v);
  }
  void eta_or_specular(const std::optional<double>& eta, double specular) {
    xml_.number(eta ? "eta" : "specular", eta.value_or(specular));
  }
  void sun(const Vec3d& direction, const Transform& to_world, const char*) {
    xml_.point("sun_direction", to_world.vector(direction) / to_world.similarity_scale());
  }

  template <class Describe>
  void field_of_view(double degrees, FovAxis, Describe&& axis) {
    xml_.number("fov", degrees);
    axis();
  }
  void crop(const FilmDescription& film) {
    if (!film.crop) return;
    xml_.integer("crop_offset_x", film.crop->x);
    xml_.integer("crop_offset_y", film.crop->y);
    xml_.integer("crop_width", film.crop->width);
    xml_.integer("crop_height", film.crop->height);
  }
  /// Writes the first of the words where `written` is true.
  void word(const char* name, std::initializer_list<const char*> words, bool written, const char*) {
    if (written) xml_.string(name, *words.begin());
  }
  template <class Value, class Describe>
  void texture_or(const char* name, std::variant<Value, TextureIndex>& v, const char*, Describe&& other) {
    if (const auto* texture = std::get_if<TextureIndex>(&v)) return materials_.use(name, *texture);
    other(std::get<Value>(v));
  }

  void shape_group(ShapeGroupIndex v, const char*) { materials_.use(v); }
  void bsdf(BsdfIndex v, const char*) { materials_.use(v); }
  void two_bsdfs(BsdfIndex a, BsdfIndex b, const char*) {
    materials_.use(a);
    materials_.use(b);
  }
  void one_or_two_bsdfs(BsdfIndex front, BsdfIndex back, const char*) {
    materials_.use(front);
    if (back != front) materials_.use(back);
  }
  void nested_texture(TextureIndex v, const char*) { materials_.use("", v); }

  // Calls that serve readers only, and parameters that other functions write.
  void require(const char*, const char*) {}
  template <class... Rest>
  void also(const char*, scene_xml::ParamType, const Rest&...) {}
  void nested(const char*, std::size_t, const char*) {}

 private:
  MaterialWriter& materials_;
  XmlWriter& xml_;
  const char* tag_;
  std::string id_, name_;
};

}  // namespace photonproof::inline scenes_xml
