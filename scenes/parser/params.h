// The parameters and nested objects of one plugin, checked against the plugin's own list and read with their types.
// Every parameter must be read: an unread one would have no effect, so it is an error instead of a silent surprise.
#pragma once

#include <cstdint>
#include <functional>
#include <initializer_list>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "scenes/description/description.h"
#include "scenes/description/param_type.h"
#include "scenes/description/spectrum.h"
#include "scenes/xml/xml_source.h"

namespace photonproof::scene_xml {

class SceneObjects;

struct ParamSpec {
  std::string name;
  ParamType type;
};

/// A kind of object that may be nested, directly or by <ref>, and how often at most.
struct NestedSpec {
  std::string tag;
  std::size_t most = 1;
  std::string meaning = {};
};

/// True for <float>, <rgb>, <transform> and the other tags that set a parameter.
bool is_parameter_tag(std::string_view tag);

class Params {
 public:
  /// Reads the children of `object`, called `title` in messages ("bsdf 'diffuse'"). Obstacles are an unknown name, a
  /// repeated one, a tag of the wrong type, and nested objects that are none of `nested`.
  Params(SceneObjects& objects, const Element& object, std::string title, const std::vector<ParamSpec>& specs,
         const std::vector<NestedSpec>& nested);

  bool has(std::string_view name) const { return given_.count(name) != 0; }

  bool boolean(const std::string& name, bool fallback);
  std::int64_t integer(const std::string& name, std::int64_t fallback, std::int64_t low, std::int64_t high);
  /// Any finite number; callers state their range with expect().
  double number(const std::string& name, double fallback);
  /// A number above 0, also after rounding to float.
  double positive(const std::string& name, double fallback);
  std::string string(const std::string& name, const std::string& fallback);
  /// A number from `low` to `high`.
  double number_in(const std::string& name, double fallback, double low, double high);
  /// <rgb>, <spectrum> or <float>; components from `low` to `high`.
  RgbD colour(const std::string& name, const RgbD& fallback, double low, double high);
  /// The same, or a texture, whose values are checked where it is read.
  Colour colour_map(const std::string& name, const RgbD& fallback, double low, double high);
  /// A number from `low` to `high`, the luminance of such a colour, or a texture.
  Scalar number_map(const std::string& name, double fallback, double low, double high);
  /// The texture `name`, empty when not given.
  std::optional<TextureIndex> texture(const std::string& name);
  /// A colour, or a volume, whose values are at least 0.
  VolumeColour volume(const std::string& name, const RgbD& fallback, double low, double high);
  /// A number, the luminance of a colour, or a volume of one channel, whose values are at least 0.
  VolumeNumber volume_number(const std::string& name, double fallback, double low, double high);
  Vec3d point(const std::string& name, const Vec3d& fallback);
  Transform transform(const std::string& name);
  /// The attribute that sets `name`, which must be given.
  const Attribute& value_of(const std::string& name) const;
  /// Throws "parameter <name> of <title> is missing, expected <what>" where it is, and its own error where it is
  /// refused.
  void expect_given(const std::string& name, const std::string& what) const;
  /// The tag that sets `name`, empty when none does.
  std::string tag(const std::string& name) const;

  /// Throws "<name> of <title> <message>" at the parameter, or at the plugin when it is not given.
  [[noreturn]] void fail(const std::string& name, const std::string& message) const;
  void expect(bool holds, const std::string& name, const std::string& message) const {
    if (!holds) fail(name, message);
  }
  /// A parameter that was given and not read becomes an obstacle.
  void finish() const;

  /// The nested objects of one kind in the order of the file, each an element of that kind or a <ref> to one.
  const std::vector<const Element*>& nested(const std::string& tag) { return nested_[tag]; }
  /// The only nested one; throws when there is none.
  const Element& only_nested(const std::string& tag);

  const std::string& title() const { return title_; }
  const Element& object() const { return object_; }
  const Sources& sources() const { return sources_; }
  SceneObjects& objects() { return objects_; }

 private:
  /// The value that `read_element` makes of the element that sets `name`. Without one, and where it throws, `fallback`.
  template <class Value, class Read>
  Value value_or(const std::string& name, Value fallback, Read read_element);
  double checked_number(const std::string& name, double fallback, const std::function<void(double value)>& check);
  bool given_twice(const Element& parameter) const;
  void refuse(const std::string& name, const InputError& error);
  TextureIndex texture_up_to(const std::string& name, double low, double high);
  bool is_texture(const std::string& name) const;
  bool is_volume(const std::string& name) const;
  double number_or_luminance(const std::string& name, double fallback, double low, double high);
  void add(const Element& parameter, const std::vector<ParamSpec>& specs);
  void add_nested(const Element& child, const std::vector<ParamSpec>& specs, const std::vector<NestedSpec>& nested);

  SceneObjects& objects_;
  const Sources& sources_;
  const Element& object_;
  std::string title_;
  std::map<std::string, const Element*, std::less<>> given_;
  std::map<std::string, InputError, std::less<>> refused_;  // given, and an obstacle
  std::set<std::string> read_;
  std::set<std::string> emissions_;  // parameters that are a light's colour
  std::map<std::string, std::vector<const Element*>> nested_;
};

}  // namespace photonproof::scene_xml
