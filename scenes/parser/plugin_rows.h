// The visitor by which `describe` functions list a plugin's parameters (scenes/description/description.h): names,
// types, defaults, values and meanings. Used for the parser's checks and for the page of the format.
#pragma once

#include <initializer_list>
#include <string>
#include <type_traits>
#include <vector>

#include "scenes/base/edit_distance.h"
#include "scenes/description/description.h"
#include "scenes/parser/params.h"

namespace photonproof::scene_xml {

struct ParamRow {
  std::string name;
  ParamType type;
  std::string fallback, values, meaning;
};

class PluginRows {
 public:
  std::string type, meaning;
  std::vector<ParamRow> rows;
  std::vector<NestedSpec> nested_specs;

  void plugin(const char* name, const char* what) {
    type = name;
    meaning = what;
  }
  void boolean(const char* name, bool v, const char* what);
  void integer(const char* name, std::int64_t v, std::int64_t low, std::int64_t high, const char* what);
  void optional_integer(const char* name, const std::optional<int>& v, std::int64_t low, std::int64_t high,
                        const char* what);
  void number(const char* name, double v, const Range& range, const char* what);
  void optional_number(const char* name, const std::optional<double>& v, const Range& range, const char* what);
  void number_after(const char* name, double v, double fallback, const char* fallback_text, const char* what);
  void positive(const char* name, double v, const char* what, double most = kUnbounded, const char* unit = "");
  void ior(const char* name, double v, const char* what);
  void colour(const char* name, const RgbD& v, const Range& range, const char* what);
  void emission(const char* name, const RgbD& v, const char* what);
  void colour_map(const char* name, const Colour& v, const Range& range, const char* what);
  void emission_map(const char* name, const Colour& v, const char* what);
  void number_map(const char* name, const Scalar& v, const Range& range, const char* what);
  void volume(const char* name, const VolumeColour& v, const Range& range, const char* what);
  void volume_number(const char* name, const VolumeNumber& v, const Range& range, const char* what);
  void texture(const char* name, TextureIndex, const char* what);
  void optional_texture(const char* name, const std::optional<TextureIndex>&, const char* what);
  template <class Value>
  void choice(const char* name, Value v, std::initializer_list<Word<std::type_identity_t<Value>>> words,
              const char* what) {
    std::vector<std::string> texts;
    std::string fallback;
    for (const auto& word : words) {
      texts.emplace_back(word.text);
      if (word.value == v) fallback = word.text;
    }
    add(name, ParamType::string, fallback, join_or(texts), what);
  }
  void file(const char* name, const std::string&, const char* what);
  void text(const char* name, const std::string&, const char* what);
  void point(const char* name, const Vec3d& v, const char* what);
  void direction(const char* name, const Vec3d& v, const char* what);
  void transform(const char* name, const Transform&, const char* what);
  void metal(const std::optional<ComplexIor>&);
  void roughness(const Scalar& alpha_u, const Scalar& alpha_v);
  void eta_or_specular(const std::optional<double>& eta, double specular);
  void sun(const Vec3d& direction, const Transform&, const char* what);

  template <class Describe>
  void field_of_view(double, FovAxis, Describe&& axis) {
    add("fov", ParamType::number, "", "more than 0 and less than 180 degrees", "in place of `focal_length`");
    axis();
    add("focal_length", ParamType::string, "50mm", "", "behind it a film of 36 x 24 mm, `fov` its diagonal");
  }
  void crop(const FilmDescription&);
  void word(const char* name, std::initializer_list<const char*> words, bool, const char* what) {
    add(name, ParamType::string, *words.begin(), join_or({words.begin(), words.end()}), what);
  }
  template <class Value, class Describe>
  void texture_or(const char* name, std::variant<Value, TextureIndex>& v, const char* what, Describe&& other) {
    add(name, ParamType::texture, "none", "a texture", what);
    other(std::get<Value>(v));
  }

  void shape_group(ShapeGroupIndex, const char* what) { nested("shape", 1, what); }
  void bsdf(BsdfIndex, const char* what) { nested("bsdf", 1, what); }
  void two_bsdfs(BsdfIndex, BsdfIndex, const char* what) { nested("bsdf", 2, what); }
  void one_or_two_bsdfs(BsdfIndex, BsdfIndex, const char* what) { nested("bsdf", 2, what); }
  void nested_texture(TextureIndex, const char* what) { nested("texture", 1, what); }
  void nested(const char* tag, std::size_t most, const char* what);

  /// Marks the parameter that comes next.
  void require(const char*, const char*) { required_ = true; }
  /// A parameter without a member, read by a function of its own.
  void also(const char* name, ParamType as, const std::string& fallback, const char* what) {
    add(name, as, fallback, "", what);
  }

  std::vector<ParamSpec> specs() const;

 private:
  void add(const char* name, ParamType as, const std::string& fallback, const std::string& values, const char* what);
  bool required_ = false;
};

}  // namespace photonproof::scene_xml
