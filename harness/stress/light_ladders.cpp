#include <cmath>
#include <numbers>

#include "harness/stress/ladder_rows.h"
#include "harness/stress/stage.h"

namespace photonproof {
namespace {

using std::numbers::pi;

double power(double k) { return std::pow(10.0, k); }

const Vec3d above{1, 5, -1};
constexpr double intensity = 20;

/// Straight down: what a flat lamp's cosine makes of its light differs from a point's, so that only balls are compared
/// with one; the others with themselves, a thousandth as large as they are far.
Ladder tiny(const char* shape, const Geometry& geometry, double area, bool is_ball) {
  const auto lamp = [=](double k) {
    const double size = power(-k);
    return StressScene{stage_under_shape(geometry, is_ball ? standing(above, size) : hanging(above, size),
                                         intensity / (area * size * size))};
  };
  Ladder ladder{"light " + std::string(shape), "tiny", "a size of 10^-k, the same power",
                {4, 6, 9, 12, 15, 19},         9,      lamp};
  if (is_ball)
    ladder.alike = [](double) { return StressScene{stage_under(PointLightDescription{above, RgbD(intensity)})}; };
  else
    ladder.alike = [=](double) { return lamp(3); };
  return ladder;
}

const Vec3d towards{0.36, 0.8, -0.48};
constexpr double irradiance = 2;

/// 10^k away, a hundredth as large as it is far: the beam of a lamp without end.
Ladder far(const char* shape, const Geometry& geometry, double area) {
  const auto lamp = [=](double k) {
    const double size = 0.003 * power(k);
    const Transform place =
        Transform::look_at(towards * power(k), {0, 0, 0}, {0, 1, 0}) * Transform::scale(Vec3d(size));
    return StressScene{stage_under_shape(geometry, place, irradiance / (area * 0.003 * 0.003))};
  };
  return {"light " + std::string(shape),
          "far",
          "10^k away, irradiance as of a beam",
          {4, 6, 9, 12, 15, 19},
          9,
          lamp,
          [](double) {
            return StressScene{stage_under(DirectionalLightDescription{towards * -1.0, RgbD(irradiance)})};
          }};
}

std::vector<Ladder> point_lights() {
  const auto far_point = [](double k) {
    return StressScene{stage_under(PointLightDescription{towards * power(k), RgbD(irradiance * power(2 * k))})};
  };
  const auto beam = [](double) {
    return StressScene{stage_under(DirectionalLightDescription{towards * -1.0, RgbD(irradiance)})};
  };
  const auto far_spot = [](double k) {
    SpotLightDescription spot;
    spot.to_world = Transform::look_at(towards * power(k), {0, 0, 0}, {0, 1, 0});
    spot.intensity = RgbD(irradiance * power(2 * k));
    spot.beam_degrees = 5;
    spot.cutoff_degrees = 10;
    return StressScene{stage_under(spot)};
  };
  // The lamp at the height 10^-k sin a; cosine over square of the distance stay.
  const auto grazing = [](double k) {
    SceneDescription scene = stage_floor();
    const double sine = power(-k);
    scene.emitters.push_back(
        {{}, "", DirectionalLightDescription{{std::sqrt(1 - sine * sine), -sine, 0}, RgbD(irradiance / sine)}});
    return StressScene{scene};
  };
  Ladder flat{"light directional",          "grazing", "at a sine of 10^-k above the floor",
              {1, 2, 3, 4, 5, 6, 7, 9, 12}, 6,         grazing};
  flat.radiance = irradiance * 0.5 / pi;
  return {{"light point", "far", "10^k away, irradiance as of a beam", {4, 6, 9, 12, 15, 18}, 9, far_point, beam},
          {"light spot", "far", "10^k away, irradiance as of a beam", {4, 6, 9, 12, 15, 18}, 9, far_spot, beam},
          flat};
}

/// A ball of radius 10^k whose nearest point is 12 above the floor, over the camera is a sky.
Ladder huge_ball() {
  return {"light sphere",
          "huge",
          "a radius of 10^k, as a sky",
          {7, 9, 11, 13, 15},
          9,
          [](double k) {
            return StressScene{stage_under_shape(SphereDescription{}, standing({0, power(k) + 12, 0}, power(k)), 1)};
          },
          [](double) { return StressScene{stage_under(ConstantLightDescription{})}; }};
}

Ladder dark_among_bright() {
  return {"light point",
          "beside a dim one",
          "one lamp 10^k times as bright as another",
          {2, 6, 12, 20, 30},
          30,
          [](double k) {
            SceneDescription scene = stage_under(PointLightDescription{above, RgbD(intensity)});
            scene.emitters.push_back({{}, "", PointLightDescription{{-2, 4, 1}, RgbD(intensity * power(-k) * 1e-2)}});
            return StressScene{scene};
          },
          [](double) {
            return StressScene{stage_under(PointLightDescription{above, RgbD(intensity)})};
          }};
}

}  // namespace

std::vector<Ladder> light_ladders(const std::filesystem::path&) {
  std::vector<Ladder> ladders{tiny("sphere", SphereDescription{}, pi, true),
                              tiny("disk", DiskDescription{}, pi, false),
                              tiny("rectangle", RectangleDescription{}, 4, false),
                              tiny("cylinder", CylinderDescription{}, 2, false),
                              far("sphere", SphereDescription{}, pi),
                              far("disk", DiskDescription{}, pi),
                              far("rectangle", RectangleDescription{}, 4),
                              huge_ball(),
                              dark_among_bright()};
  for (const Ladder& ladder : point_lights()) ladders.push_back(ladder);
  return ladders;
}

}  // namespace photonproof
