#include "scenes/parser/plugin_reader.h"

#include <cmath>
#include <numbers>

namespace photonproof::scene_xml {
namespace {

/// Rounds to multiples of 2^-30, so that writing and reading, by world space and back, change nothing.
Vec3d rounded(const Vec3d& v) {
  constexpr double kUnit = 1 << 30;
  return {std::round(v.x * kUnit) / kUnit, std::round(v.y * kUnit) / kUnit, std::round(v.z * kUnit) / kUnit};
}

}  // namespace

void PluginReader::number(const char* name, double& v, const Range& range, const char*) {
  if (range.words == nullptr && range.low > -kUnbounded) {
    v = params_.number_in(name, v, range.low, range.high);
    return;
  }
  v = params_.number(name, v);
  if (!range.holds(v)) params_.fail(name, "is " + format_number(v) + ", expected " + range.words);
}

void PluginReader::positive(const char* name, double& v, const char*, double most, const char* unit) {
  v = params_.positive(name, v);
  params_.expect(v <= most, name, "is " + format_number(v) + ", expected at most " + format_number(most) + " " + unit);
}

/// A number must be above 0; the texels of a texture may be 0.
Scalar PluginReader::read_roughness(const char* name, const Scalar& fallback) {
  const double least = std::get<double>(fallback);
  const Scalar alpha = params_.number_map(name, least, 0, kUnbounded);
  if (std::holds_alternative<double>(alpha)) params_.positive(name, least);
  return alpha;
}

void PluginReader::roughness(Scalar& alpha_u, Scalar& alpha_v) {
  if (!params_.has("alpha_u") && !params_.has("alpha_v")) {
    alpha_u = alpha_v = read_roughness("alpha", alpha_u);
    return;
  }
  params_.expect(!params_.has("alpha"), "alpha", "is given beside alpha_u and alpha_v, expected one or the other");
  for (const char* name : {"alpha_u", "alpha_v"})
    params_.expect(params_.has(name), name, "is missing: alpha_u and alpha_v go together");
  alpha_u = read_roughness("alpha_u", alpha_u);
  alpha_v = read_roughness("alpha_v", alpha_v);
}

void PluginReader::eta_or_specular(std::optional<double>& eta, double& specular) {
  params_.expect(!(params_.has("eta") && params_.has("specular")), "specular",
                 "is given beside eta, expected one or the other");
  if (params_.has("eta")) eta = params_.number_in("eta", 0, 1e-3, 1e3);
  specular = params_.number_in("specular", specular, 0, 1);
}

void PluginReader::sun(Vec3d& direction, const Transform&, const char*) {
  expect_similarity(params_, "the sky");
  PlaceAndTime when;
  if (!params_.has("sun_direction")) {
    describe(*this, when);
    direction = rounded(sun_direction(when));
    return;
  }
  PluginRows place_and_time;
  describe(place_and_time, when);
  for (const ParamRow& row : place_and_time.rows) expect_alone(params_, row.name, "sun_direction");
  const Transform to_world = params_.transform("to_world");
  direction = rounded(to_world.inverse()->vector(unit_vector(params_, "sun_direction", {0, 0, 1})) *
                      to_world.similarity_scale());
}

/// The diagonal field of view of a 36 x 24 mm film behind a lens of this focal length ("50mm", Mitsuba's default).
double PluginReader::diagonal_fov() {
  std::string text = params_.string("focal_length", "50mm");
  if (text.size() > 2 && text.ends_with("mm")) text.resize(text.size() - 2);
  const auto millimetres = parse_number(text);
  params_.expect(millimetres.value && *millimetres.value > 0, "focal_length",
                 "is " + in_quotes(params_.string("focal_length", "")) + ", expected a positive length such as 50mm");
  return 2 * std::atan(std::hypot(36.0, 24.0) / (2 * *millimetres.value)) * (180 / std::numbers::pi);
}

void PluginReader::crop(FilmDescription& film) {
  const bool given = params_.has("crop_offset_x") || params_.has("crop_offset_y") || params_.has("crop_width") ||
                     params_.has("crop_height");
  if (!given) return;
  FilmDescription::Crop crop{0, 0, film.width, film.height};
  crop.width = static_cast<int>(params_.integer("crop_width", crop.width, 1, film.width));
  crop.height = static_cast<int>(params_.integer("crop_height", crop.height, 1, film.height));
  crop.x = static_cast<int>(params_.integer("crop_offset_x", 0, 0, film.width - crop.width));
  crop.y = static_cast<int>(params_.integer("crop_offset_y", 0, 0, film.height - crop.height));
  film.crop = crop;
}

void PluginReader::word(const char* name, std::initializer_list<const char*> words, bool, const char*) {
  const std::string value = params_.string(name, *words.begin());
  params_.expect(std::find(words.begin(), words.end(), value) != words.end(), name,
                 "is " + in_quotes(value) + ", expected " + join_or({words.begin(), words.end()}));
}

void PluginReader::shape_group(ShapeGroupIndex& v, const char*) {
  const Element& group = params_.only_nested("shape");
  if (group.tag != "ref")
    params_.sources().fail(group.at, "a shape inside an instance, expected a <ref> to a shapegroup of the scene");
  v = params_.objects().shape_group(group);
}

void PluginReader::two_bsdfs(BsdfIndex& a, BsdfIndex& b, const char*) {
  const std::size_t count = params_.nested("bsdf").size();
  if (count != 2)
    params_.sources().fail(params_.object().at,
                           params_.title() + " has " + std::to_string(count) + " of <bsdf>, expected two");
  a = nested_bsdf(0);
  b = nested_bsdf(1);
}

void PluginReader::one_or_two_bsdfs(BsdfIndex& front, BsdfIndex& back, const char*) {
  params_.only_nested("bsdf");
  front = nested_bsdf(0);
  back = params_.nested("bsdf").size() == 2 ? nested_bsdf(1) : front;
}

}  // namespace photonproof::scene_xml
