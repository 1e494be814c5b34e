#include "reference/povray/povray_shades.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "reference/povray/povray_pigments.h"
#include "scenes/base/text_numbers.h"

namespace photonproof::inline reference_povray {
namespace {

// In POV-Ray's lengths: small against the scene, which is some 64 wide, and well above the tolerance of shadow rays.
constexpr double kRadius = 0.02;

/// A pigment that transmits a share of the light.
std::string passes(double share) { return "rgbt <0,0,0," + format_number(share) + ">"; }

std::string ball(const std::string& pigment, const Transform& to_world, double scale, double radius = kRadius) {
  Transform turn = to_world;
  for (const std::size_t i : {3u, 7u, 11u}) turn.m[i] = 0;
  const double unit = to_world.similarity_scale();
  Transform placed =
      Transform::translate(to_world.point({0, 0, 0}) * scale) * turn * Transform::scale(Vec3d(radius / unit));
  return "sphere{0,1 hollow texture{" + pigment + " finish{ambient 0 diffuse 0}}" + matrix_sdl(placed) +
         " no_image no_reflection no_radiosity}";
}

/// The angle from local z over half a turn, or its supplement.
std::string by_angle(const std::string& cosine, const std::string& entries) {
  return "function{acos(max(-1,min(1," + cosine + "/sqrt(x*x+y*y+z*z))))/pi} color_map{" + entries + "}";
}

std::string entry(double at, double share) { return "[" + format_number(at) + " " + passes(share) + "]"; }

/// The entries of a pigment for one plane of the table, from the nadir at 0 to the zenith at 1.
std::string plane_pigment(const IesProfile& profile, std::size_t plane, double greatest) {
  const std::vector<double>& angles = profile.vertical_degrees;
  std::string entries;
  if (angles.front() > 0) entries += entry(0, 0) + entry(angles.front() / 180, 0);
  for (std::size_t i = 0; i < angles.size(); ++i)
    entries += entry(angles[i] / 180, profile.candela[plane * angles.size() + i] / greatest);
  if (angles.back() < 180) entries += entry(angles.back() / 180, 0) + entry(1, 0);
  return by_angle("-z", entries);
}

}  // namespace

std::string spot_shade(const SpotLightDescription& light, double scale) {
  const double beam = light.beam_degrees / 180, cutoff = light.cutoff_degrees / 180;
  return ball("pigment{" + by_angle("z", entry(0, 1) + entry(beam, 1) + entry(cutoff, 0) + entry(1, 0)) + "}",
              light.to_world, scale);
}

std::string slide_shade(const SpotLightDescription& light, double greatest, double scale) {
  // Local +x is to the left of a viewer along +z, as with cameras; behind the light it is dark anyway.
  const std::string per_width = format_number(0.5 / std::tan(light.cutoff_degrees * std::numbers::pi / 180));
  const auto along = [&](const std::string& axis) { return "0.5+" + per_width + "*" + axis + "/max(z,0.001)"; };
  return ball(mapped_pigment(*light.texture, along("x"), along("y"), greatest, true), light.to_world, scale,
              2 * kRadius);
}

double greatest_candela(const IesProfile& profile) {
  const double greatest = *std::max_element(profile.candela.begin(), profile.candela.end());
  return greatest > 0 ? greatest : 1;
}

std::string ies_shade(const IesLightDescription& light, double scale) {
  const IesProfile& profile = *light.profile;
  const double greatest = greatest_candela(profile);
  const std::vector<double>& planes = profile.horizontal_degrees;
  if (planes.size() == 1) return ball("pigment{" + plane_pigment(profile, 0, greatest) + "}", light.to_world, scale);
  // A file that ends at 90 or 180 degrees is mirrored there.
  const double last = planes.back();
  std::string entries;
  for (std::size_t i = 0; i < planes.size(); ++i)
    entries += "[" + format_number(planes[i] / last) + " " + plane_pigment(profile, i, greatest) + "]";
  std::string around = "mod(atan2(y,x)*180/pi+360,360)";
  if (last == 180 || last == 90) around = "acos(cos(atan2(y,x)))*180/pi";
  if (last == 90) around = "(90-abs(90-" + around + "))";
  return ball("pigment{function{" + around + "/" + format_number(last) + "} pigment_map{" + entries + "}}",
              light.to_world, scale);
}

}  // namespace photonproof::inline reference_povray
