// The parameters of one plugin, checked against what the plugin knows and read with their types. Every parameter must
// be read: what a plugin leaves unread has no effect, and is an error rather than a silent surprise.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "scenes/transform.h"
#include "scenes/vec.h"
#include "scenes/xml_source.h"

namespace photonproof::scene_xml {

enum class ParamType { boolean, integer, number, string, ior, colour, point, transform };

struct ParamSpec {
  std::string name;
  ParamType type;
};

/// True for <float>, <rgb>, <transform> and the other tags that set a parameter.
bool is_parameter_tag(std::string_view tag);

class Params {
 public:
  /// Reads the parameter children of `object`, called `title` in messages ("bsdf 'diffuse'"). Throws on an unknown
  /// name, a repeated one, or a tag of the wrong type.
  Params(const Sources& sources, const Element& object, std::string title, const std::vector<ParamSpec>& specs);

  bool has(std::string_view name) const { return given_.count(name) != 0; }

  bool boolean(const std::string& name, bool fallback);
  std::int64_t integer(const std::string& name, std::int64_t fallback, std::int64_t low, std::int64_t high);
  /// Any finite number; callers state their range with expect().
  double number(const std::string& name, double fallback);
  /// A number above 0, also after rounding to float.
  double positive(const std::string& name, double fallback);
  std::string string(const std::string& name, const std::string& fallback);
  /// <rgb>, a constant <spectrum> or <float>; components from `low` to `high`.
  RgbD colour(const std::string& name, const RgbD& fallback, double low, double high);
  Vec3d point(const std::string& name, const Vec3d& fallback);
  Transform transform(const std::string& name);
  /// The attribute that sets `name`, which must be given.
  const Attribute& value_of(const std::string& name) const { return require(sources_, *given_.at(name), "value"); }
  /// The tag that sets `name`, empty when none does.
  std::string tag(const std::string& name) const;

  /// Throws "<name> of <title> <message>" at the parameter, or at the plugin when it is not given.
  [[noreturn]] void fail(const std::string& name, const std::string& message) const;
  void expect(bool holds, const std::string& name, const std::string& message) const {
    if (!holds) fail(name, message);
  }
  /// Throws unless every given parameter was read; `why` completes "parameter 'x' of <title> ...".
  void finish() const;

  const std::string& title() const { return title_; }
  const Element& object() const { return object_; }
  const Sources& sources() const { return sources_; }

 private:
  const Element* read(const std::string& name);
  void add(const Element& parameter, const std::vector<ParamSpec>& specs);

  const Sources& sources_;
  const Element& object_;
  std::string title_;
  std::map<std::string, const Element*, std::less<>> given_;
  std::set<std::string> read_;
};

}  // namespace photonproof::scene_xml
