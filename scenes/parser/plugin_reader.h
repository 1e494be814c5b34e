// The visitor by which `describe` functions read (scenes/description/description.h). A member that the file does not
// set keeps its default.
#pragma once

#include <algorithm>
#include <initializer_list>
#include <string>
#include <type_traits>
#include <vector>

#include "scenes/parser/plugin_rows.h"
#include "scenes/parser/plugins.h"

namespace photonproof::scene_xml {

class PluginReader {
 public:
  explicit PluginReader(Params& params) : params_(params) {}

  void plugin(const char*, const char*) {}
  void boolean(const char* name, bool& v, const char*) { v = params_.boolean(name, v); }
  template <class Integer>
  void integer(const char* name, Integer& v, std::int64_t low, std::int64_t high, const char*) {
    v = static_cast<Integer>(params_.integer(name, v, low, high));
  }
  void optional_integer(const char* name, std::optional<int>& v, std::int64_t low, std::int64_t high, const char*) {
    if (params_.has(name)) v = static_cast<int>(params_.integer(name, 0, low, high));
  }
  void number(const char* name, double& v, const Range& range, const char*);
  void optional_number(const char* name, std::optional<double>& v, const Range& range, const char* what) {
    if (params_.has(name)) number(name, v.emplace(), range, what);
  }
  void number_after(const char* name, double& v, double fallback, const char*, const char*) {
    v = params_.number(name, fallback);
  }
  void positive(const char* name, double& v, const char*, double most = kUnbounded, const char* unit = "");
  void ior(const char* name, double& v, const char*) { v = read_ior(params_, name, v); }
  void colour(const char* name, RgbD& v, const Range& range, const char*) {
    v = params_.colour(name, v, range.low, range.high);
  }
  void emission(const char* name, RgbD& v, const char*) { v = params_.colour(name, v, 0, kUnbounded); }
  void colour_map(const char* name, Colour& v, const Range& range, const char*) {
    v = params_.colour_map(name, constant(v), range.low, range.high);
  }
  void emission_map(const char* name, Colour& v, const char*) {
    v = params_.colour_map(name, constant(v), 0, kUnbounded);
  }
  void number_map(const char* name, Scalar& v, const Range& range, const char*) {
    v = params_.number_map(name, std::get<double>(v), range.low, range.high);
  }
  void volume(const char* name, VolumeColour& v, const Range& range, const char*) {
    v = params_.volume(name, std::get<RgbD>(v), range.low, range.high);
  }
  void volume_number(const char* name, VolumeNumber& v, const Range& range, const char*) {
    v = params_.volume_number(name, std::get<double>(v), range.low, range.high);
  }
  void texture(const char* name, TextureIndex& v, const char*) { v = *params_.texture(name); }
  void optional_texture(const char* name, std::optional<TextureIndex>& v, const char*) { v = params_.texture(name); }
  template <class Value>
  void choice(const char* name, Value& v, std::initializer_list<Word<std::type_identity_t<Value>>> words, const char*) {
    if (!params_.has(name)) return;
    const std::string given = params_.string(name, "");
    std::vector<std::string> known;
    for (const auto& word : words) {
      if (given == word.text) return void(v = word.value);
      known.emplace_back(word.text);
    }
    params_.fail(name, "is " + in_quotes(given) + ", expected " + join_or(known));
  }
  /// The file's name as written; the code that loads the file replaces it by the final one.
  void file(const char* name, std::string& v, const char* what) {
    require(name, what);
    v = params_.string(name, "");
  }
  void text(const char* name, std::string& v, const char* what) {
    require(name, what);
    v = params_.string(name, "");
  }
  void point(const char* name, Vec3d& v, const char*) { v = params_.point(name, v); }
  void direction(const char* name, Vec3d& v, const char*) { v = unit_vector(params_, name, v); }
  void transform(const char* name, Transform& v, const char*) { v = params_.transform(name); }
  void metal(std::optional<ComplexIor>& v) { v = read_conductor_ior(params_); }
  void roughness(Scalar& alpha_u, Scalar& alpha_v);
  void eta_or_specular(std::optional<double>& eta, double& specular);
  void sun(Vec3d& direction, const Transform&, const char*);

  template <class Describe>
  void field_of_view(double& degrees, FovAxis& axis, Describe&& read_axis) {
    params_.expect(!(params_.has("fov") && params_.has("focal_length")), "focal_length",
                   "is given beside fov, expected one or the other");
    if (params_.has("fov")) {
      degrees = params_.number("fov", degrees);
      read_axis();
    } else {
      degrees = diagonal_fov();
      axis = FovAxis::diagonal;
    }
    params_.expect(
        degrees > 0 && degrees < 180, params_.has("fov") ? "fov" : "focal_length",
        "makes the field of view " + format_number(degrees) + " degrees, expected more than 0 and less than 180");
  }
  void crop(FilmDescription& film);
  void word(const char* name, std::initializer_list<const char*> words, bool, const char*);
  template <class Value, class Describe>
  void texture_or(const char* name, std::variant<Value, TextureIndex>& v, const char*, Describe&& other) {
    if (const auto texture = params_.texture(name))
      v = *texture;
    else
      other(std::get<Value>(v));
  }

  void shape_group(ShapeGroupIndex& v, const char*);
  void bsdf(BsdfIndex& v, const char*) { v = params_.objects().bsdf(params_.only_nested("bsdf")); }
  void two_bsdfs(BsdfIndex& a, BsdfIndex& b, const char*);
  void one_or_two_bsdfs(BsdfIndex& front, BsdfIndex& back, const char*);
  void nested_texture(TextureIndex& v, const char*) { v = params_.objects().texture(params_.only_nested("texture")); }

  void require(const char* name, const char* what) { params_.expect_given(name, what); }
  // Read by other functions.
  template <class... Rest>
  void also(const char*, ParamType, const Rest&...) {}
  void nested(const char*, std::size_t, const char*) {}

 private:
  BsdfIndex nested_bsdf(std::size_t i) { return params_.objects().bsdf(*params_.nested("bsdf")[i]); }
  double diagonal_fov();
  Scalar read_roughness(const char* name, const Scalar& fallback);

  Params& params_;
};

/// The row of a plugin that `build` reads.
template <class Result, class Description>
Plugin<Result> plugin_of(Description description, std::function<Result(Params&)> build) {
  PluginRows rows;
  describe(rows, description);
  return {rows.type, rows.specs(), rows.nested_specs, std::move(build)};
}

/// The row of a plugin whose parameters start as `defaults`. `complete` then checks the value, or loads its file.
template <class Result, class Complete, class Description>
Plugin<Result> described_plugin(const Description& defaults) {
  return plugin_of<Result>(defaults, [defaults](Params& params) {
    Description read = defaults;
    PluginReader reader(params);
    describe(reader, read);
    Complete{params}(read);
    return Result(std::move(read));
  });
}

/// One row a kind of the variant, in the order of their names.
template <class Variant, class Complete>
std::vector<Plugin<Variant>> described_plugins() {
  return []<class... Kinds>(const std::variant<Kinds...>*) {
    std::vector<Plugin<Variant>> rows = {described_plugin<Variant, Complete>(Kinds{})...};
    sort_by_name(rows);
    return rows;
  }(static_cast<const Variant*>(nullptr));
}

}  // namespace photonproof::scene_xml
