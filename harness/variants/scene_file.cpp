#include "harness/variants/scene_file.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <kainjow/mustache.hpp>
#include <string>
#include <variant>

#include "harness/variants/plain_objects.h"
#include "scenes/base/text_numbers.h"

namespace photonproof::inline harness_variants {
namespace {

using kainjow::mustache::data;

void set_number(data& object, const std::string& name, double value) {
  object.set(name, format_number(value == 0 ? 0 : value));  // no -0
}

void set_vector(data& object, const std::string& prefix, const Vec3d& v) {
  set_number(object, prefix + "x", v.x);
  set_number(object, prefix + "y", v.y);
  set_number(object, prefix + "z", v.z);
}

void set_colour(data& object, const std::string& prefix, const RgbD& c) {
  set_number(object, prefix + "r", c.x);
  set_number(object, prefix + "g", c.y);
  set_number(object, prefix + "b", c.z);
}

std::string plain_name(const std::string& name) {
  std::string plain = name;
  const auto keeps = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
  };
  for (char& c : plain)
    if (!keeps(c)) c = '_';
  return plain;
}

data object_data(const PlainObject& plain, std::size_t index, std::size_t count) {
  data object;
  object.set("index", std::to_string(index));
  object.set("name", plain.name.empty() ? "object-" + std::to_string(index) : plain_name(plain.name));
  object.set("last", index + 1 == count);
  for (const PlainKind kind : {PlainKind::sphere, PlainKind::rectangle, PlainKind::box, PlainKind::water})
    object.set(std::string("kind_") + word_of(kind), plain.kind == kind);
  for (const PlainMaterial material :
       {PlainMaterial::diffuse, PlainMaterial::mirror, PlainMaterial::glass, PlainMaterial::light})
    object.set(std::string("material_") + word_of(material), plain.material == material);
  set_vector(object, "", plain.middle);
  set_number(object, "radius", plain.radius);
  set_vector(object, "a", plain.a);
  set_vector(object, "b", plain.b);
  set_vector(object, "c", plain.c);
  set_colour(object, "", plain.colour);
  set_number(object, "ior", plain.ior);
  set_colour(object, "e", plain.radiance);
  object.set("columns", std::to_string(plain.columns));
  object.set("rows", std::to_string(plain.rows));
  set_number(object, "frequency_x", plain.frequency_x);
  set_number(object, "frequency_y", plain.frequency_y);
  object.set("noise_seed", std::to_string(plain.noise_seed));
  return object;
}

data camera_data(const PlainCamera& plain) {
  data camera;
  set_vector(camera, "", plain.eye);
  set_vector(camera, "d", plain.direction);
  set_vector(camera, "u", plain.up);
  set_number(camera, "fov", plain.vertical_fov_degrees);
  set_number(camera, "near", plain.near);
  return camera;
}

/// Throws for a name of the template without a value, which mustache would silently leave out.
class StrictContext : public kainjow::mustache::context<std::string> {
 public:
  explicit StrictContext(const data* page) : context(page) {}
  const data* get(const std::string& name) const override {
    const data* found = context::get(name);
    if (!found && unknown_.empty()) unknown_ = name;
    return found;
  }
  const data* get_partial(const std::string& name) const override { return get(name); }
  const std::string& unknown() const { return unknown_; }

 private:
  mutable std::string unknown_;
};

}  // namespace

std::string scene_file_text(const SceneDescription& scene, int width, int height, const std::string& mustache_template,
                            const std::string& template_file) {
  kainjow::mustache::mustache page{mustache_template};
  if (!page.is_valid()) throw InputError(template_file, page.error_message());
  page.set_custom_escape([](const std::string& text) { return text; });  // not HTML
  data context;
  context.set("width", std::to_string(width));
  context.set("height", std::to_string(height));
  const PlainCamera camera = plain_camera(scene, width, height);
  context.set("camera", camera_data(camera));
  context.set("shift_x", std::to_string(camera.shift_x));
  context.set("shift_y", std::to_string(camera.shift_y));
  data objects(data::type::list);
  const std::vector<PlainObject> plain = plain_objects(scene);
  for (std::size_t i = 0; i < plain.size(); ++i) objects.push_back(object_data(plain[i], i, plain.size()));
  context.set("objects", objects);
  StrictContext strict(&context);
  std::string text = page.render(strict);
  if (!page.is_valid()) throw InputError(template_file, page.error_message());
  if (!strict.unknown().empty())
    throw InputError(template_file, "it names " + in_quotes(strict.unknown()) + ", which no scene has");
  return text;
}

}  // namespace photonproof::inline harness_variants
