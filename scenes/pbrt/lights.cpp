#include "scenes/pbrt/lights.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scenes/base/text_numbers.h"
#include "scenes/pbrt/octahedral.h"

namespace photonproof::inline scenes_pbrt {
namespace {

constexpr double kPi = std::numbers::pi;

void add(PbrtContext& context, decltype(EmitterDescription::light) light) {
  context.scene.emitters.push_back({{}, "", std::move(light)});
}

/// "scale" and, where it is given, the power or illuminance, of which 1 / `unit` is the light's factor.
double factor_of(const PbrtContext& context, const PbrtParameters& p, const char* total, double unit) {
  const double scale = p.number("scale", 1, 0, 1e30) * context.exposure, given = p.number(total, -1);
  return given > 0 ? scale * given / unit : scale;
}

void add_point(PbrtContext& context, const PbrtEntity& light) {
  const PbrtParameters& p = light.parameters;
  const Vec3d from = (context.to_ours * light.ctm).point(p.point("from", {0, 0, 0}));
  const double factor = factor_of(context, p, "power", 4 * kPi);
  add(context, PointLightDescription{from, context.spectra.light(p, "I") * factor});
}

void add_spot(PbrtContext& context, const PbrtEntity& light) {
  const PbrtParameters& p = light.parameters;
  const Transform to_ours = context.to_ours * light.ctm;
  const Vec3d from = p.point("from", {0, 0, 0}), to = p.point("to", {0, 0, 1});
  const Vec3d origin = to_ours.point(from), along = to_ours.vector(to - from);
  if (!(length(along) > 0)) p.fail("shines from a point to itself");
  const double cone = p.number("coneangle", 30, 0.01, 89.99), width = p.number("conedeltaangle", 5, 0, 90);
  SpotLightDescription spot;
  spot.cutoff_degrees = cone;
  spot.beam_degrees = std::max(0.0, cone - width);
  const Vec3d d = normalize(along);
  spot.to_world = Transform::look_at(origin, origin + d, std::abs(d.y) < 0.9 ? Vec3d(0, 1, 0) : Vec3d(1, 0, 0));
  const double start = std::cos(spot.beam_degrees * kPi / 180), end = std::cos(cone * kPi / 180);
  const double factor = factor_of(context, p, "power", 2 * kPi * ((1 - start) + (start - end) / 2));
  spot.intensity = context.spectra.light(p, "I") * factor;
  if (width > 0)
    context.log.note(p.at(), "the edge of a spot falls off linearly in the angle, not smoothly in its cosine");
  add(context, spot);
}

void add_distant(PbrtContext& context, const PbrtEntity& light) {
  const PbrtParameters& p = light.parameters;
  const Vec3d along = p.point("to", {0, 0, 1}) - p.point("from", {0, 0, 0});
  const Vec3d direction = (context.to_ours * light.ctm).vector(along);
  if (!(length(direction) > 0)) p.fail("shines from a point to itself");
  const double factor = factor_of(context, p, "illuminance", 1);
  add(context, DirectionalLightDescription{normalize(direction), context.spectra.light(p, "L") * factor});
}

/// pbrt's illuminance of a square image on a plane that faces +z: the sum over the upper half's pixels divided by the
/// number of all pixels, times 2 pi. That is half the true one.
double illuminance_of(const Image& square) {
  double sum = 0;
  for (int y = 0; y < square.height; ++y)
    for (int x = 0; x < square.width; ++x) {
      const double u = std::abs(2 * (x + 0.5) / square.width - 1), v = std::abs(2 * (y + 0.5) / square.height - 1);
      if (u + v >= 1) continue;  // below the horizon
      const float* c = square.pixel(x, y);
      const double cosine = 1 - (u + v) * (u + v);
      sum += cosine * (0.212671 * double{c[0]} + 0.715160 * double{c[1]} + 0.072169 * double{c[2]});
    }
  return sum * 2 * kPi / static_cast<double>(square.pixels());
}

void add_infinite(PbrtContext& context, const PbrtEntity& light) {
  const PbrtParameters& p = light.parameters;
  for (const EmitterDescription& other : context.scene.emitters)
    if (std::holds_alternative<ConstantLightDescription>(other.light) ||
        std::holds_alternative<EnvmapDescription>(other.light))
      p.fail("is a second infinite light, expected one");
  if (p.find("portal", {"point3"}) != nullptr)
    context.log.note(p.at(), "the portal of an infinite light is left out: its light comes from all around");
  const PbrtParameter* file = p.find("filename", {"string"});
  if (file == nullptr) {
    const double factor = factor_of(context, p, "illuminance", kPi);
    return add(context, ConstantLightDescription{context.spectra.light(p, "L") * factor});
  }
  if (p.has("L")) p.fail(*file, "is given beside L");
  Image square;
  try {
    square = read_texture_image(context.files.find(p.text("filename", ""), file->at).string(), false);
  } catch (const InputError& error) {
    if (error.line() != 0) throw;
    p.fail(*file, "cannot be used: " + error.summary());
  }
  if (square.width != square.height) p.fail(*file, "names an image that is not square: it is no equal-area map");
  const auto to_light = (context.to_ours * light.ctm).inverse();
  if (!to_light) p.fail("is flattened by its transform");
  Rendering map;
  map.mean = latitude_longitude(square, *to_light);
  EnvmapDescription environment;
  environment.scale = factor_of(context, p, "illuminance", std::max(1e-30, illuminance_of(square)));
  environment.filename = context.files.write(map, "environment");
  add(context, environment);
}

}  // namespace

void add_pbrt_light(PbrtContext& context, const PbrtEntity& light) {
  const PbrtParameters& p = light.parameters;
  const std::size_t before = context.scene.emitters.size();
  if (light.type == "point")
    add_point(context, light);
  else if (light.type == "spot")
    add_spot(context, light);
  else if (light.type == "distant")
    add_distant(context, light);
  else if (light.type == "infinite")
    add_infinite(context, light);
  else
    p.fail("is not supported, expected point, spot, distant or infinite");
  try {
    p.finish();
  } catch (const InputError&) {
    context.scene.emitters.resize(before);
    throw;
  }
}

}  // namespace photonproof::inline scenes_pbrt
