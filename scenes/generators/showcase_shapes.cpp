#include "scenes/generators/showcase_shapes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scenes/generators/gradient_noise.h"

namespace photonproof::inline scenes_generators {
namespace {

using std::numbers::pi;

struct Outline {
  double radius, height;
};

TriangleMesh turned(const Fineness& fine, const std::vector<Outline>& outline, Ends ends, int per_span, int segments) {
  std::vector<Vec3d> controls;
  for (const auto& [radius, height] : outline) controls.push_back({radius, height, 0});
  return lathe(smooth_curve(controls, fine.steps(per_span), ends), ends, fine.segments(segments));
}

/// A tube whose radius changes evenly from `first` to `last`.
TriangleMesh bent_tube(const Fineness& fine, const std::vector<Vec3d>& controls, double first, double last,
                       int per_span, int segments) {
  const auto curve = smooth_curve(controls, fine.steps(per_span), Ends::open);
  std::vector<double> radii;
  for (std::size_t i = 0; i < curve.size(); ++i)
    radii.push_back(first + (last - first) * static_cast<double>(i) / static_cast<double>(curve.size() - 1));
  return tube(curve, radii, Ends::open, fine.segments(segments));
}

}  // namespace

Fineness::Fineness(double detail) : factor(std::sqrt(detail)) {}

int Fineness::steps(int at_detail_1) const { return std::max(1, static_cast<int>(std::lround(at_detail_1 * factor))); }

std::uint32_t Fineness::segments(int at_detail_1) const {
  return static_cast<std::uint32_t>(std::max(6L, std::lround(at_detail_1 * factor)));
}

TriangleMesh wine_glass(const Fineness& fine) {
  return turned(
      fine, {{0, 0},          {0.020, 0.0003}, {0.034, 0.0006}, {0.0365, 0.0022}, {0.034, 0.0040},  {0.018, 0.0065},
             {0.0075, 0.012}, {0.0042, 0.030}, {0.0036, 0.055}, {0.0045, 0.078},  {0.010, 0.088},   {0.026, 0.103},
             {0.037, 0.125},  {0.0395, 0.148}, {0.036, 0.175},  {0.0315, 0.1985}, {0.0306, 0.2000}, {0.0297, 0.1985},
             {0.0342, 0.175}, {0.0377, 0.148}, {0.0352, 0.126}, {0.0245, 0.1055}, {0.010, 0.0935},  {0, 0.0905}},
      Ends::axis, 4, 56);
}

TriangleMesh tumbler(const Fineness& fine) {
  return turned(fine,
                {{0, 0},
                 {0.020, 0},
                 {0.030, 0.001},
                 {0.033, 0.004},
                 {0.0345, 0.020},
                 {0.037, 0.060},
                 {0.0395, 0.098},
                 {0.0388, 0.0995},
                 {0.0380, 0.098},
                 {0.0353, 0.060},
                 {0.0325, 0.020},
                 {0.029, 0.0125},
                 {0.015, 0.011},
                 {0, 0.0108}},
                Ends::axis, 4, 56);
}

TriangleMesh bottle(const Fineness& fine) {
  return turned(fine, {{0, 0.012},       {0.018, 0.008},  {0.030, 0.001},  {0.036, 0.003},  {0.0375, 0.012},
                       {0.0375, 0.060},  {0.0375, 0.160}, {0.036, 0.190},  {0.026, 0.215},  {0.0155, 0.235},
                       {0.0140, 0.260},  {0.0140, 0.285}, {0.0155, 0.287}, {0.0157, 0.296}, {0.0140, 0.3005},
                       {0.0108, 0.2985}, {0.0105, 0.260}, {0.0120, 0.236}, {0.0225, 0.213}, {0.0330, 0.188},
                       {0.0345, 0.160},  {0.0345, 0.060}, {0.0340, 0.018}, {0.020, 0.0155}, {0, 0.0185}},
                Ends::axis, 4, 48);
}

TriangleMesh vase(const Fineness& fine) {
  return turned(fine,
                {{0, 0},          {0.035, 0},      {0.047, 0.002},  {0.052, 0.010},  {0.066, 0.050}, {0.072, 0.085},
                 {0.060, 0.130},  {0.036, 0.170},  {0.030, 0.200},  {0.042, 0.240},  {0.048, 0.250}, {0.0468, 0.2515},
                 {0.0455, 0.250}, {0.0392, 0.240}, {0.0270, 0.200}, {0.0330, 0.170}, {0.057, 0.130}, {0.069, 0.085},
                 {0.063, 0.050},  {0.047, 0.016},  {0.030, 0.0105}, {0, 0.010}},
                Ends::axis, 4, 56);
}

TriangleMesh bowl(const Fineness& fine) {
  return turned(fine,
                {{0, 0},
                 {0.040, 0},
                 {0.050, 0.002},
                 {0.052, 0.008},
                 {0.085, 0.030},
                 {0.115, 0.065},
                 {0.125, 0.090},
                 {0.1235, 0.0925},
                 {0.1215, 0.090},
                 {0.1115, 0.066},
                 {0.082, 0.034},
                 {0.045, 0.014},
                 {0, 0.011}},
                Ends::axis, 4, 64);
}

TriangleMesh teapot(const Fineness& fine) {
  TriangleMesh pot = turned(fine,
                            {{0, 0},
                             {0.050, 0},
                             {0.062, 0.004},
                             {0.085, 0.030},
                             {0.098, 0.070},
                             {0.092, 0.105},
                             {0.070, 0.128},
                             {0.060, 0.133},
                             {0.0575, 0.136},
                             {0.056, 0.1365},
                             {0.0545, 0.1390},
                             {0.050, 0.143},
                             {0.030, 0.154},
                             {0.012, 0.160},
                             {0.009, 0.166},
                             {0.014, 0.174},
                             {0.012, 0.184},
                             {0, 0.188}},
                            Ends::axis, 4, 52);
  const Vec3d here(0.0);
  add_part(pot,
           bent_tube(fine, {{0.065, 0.045, 0}, {0.110, 0.058, 0}, {0.140, 0.100, 0}, {0.172, 0.142, 0}}, 0.028, 0.011,
                     7, 28),
           0, here);
  add_part(pot,
           bent_tube(fine,
                     {{-0.080, 0.112, 0},
                      {-0.120, 0.124, 0},
                      {-0.152, 0.104, 0},
                      {-0.145, 0.066, 0},
                      {-0.115, 0.044, 0},
                      {-0.083, 0.038, 0}},
                     0.009, 0.009, 7, 20),
           0, here);
  return pot;
}

TriangleMesh table(const Fineness& fine) {
  return turned(
      fine, {{0, 0},         {0.22, 0},     {0.30, 0.005},  {0.315, 0.02}, {0.29, 0.04},  {0.12, 0.07},  {0.05, 0.14},
             {0.04, 0.30},   {0.055, 0.42}, {0.038, 0.52},  {0.06, 0.66},  {0.11, 0.695}, {0.40, 0.699}, {0.68, 0.70},
             {0.71, 0.7035}, {0.72, 0.72},  {0.71, 0.7365}, {0.68, 0.74},  {0.40, 0.74},  {0, 0.74}},
      Ends::axis, 2, 96);
}

TriangleMesh door_knob(const Fineness& fine) {
  return turned(fine,
                {{0, 0},
                 {0.026, 0},
                 {0.0285, 0.002},
                 {0.026, 0.005},
                 {0.012, 0.008},
                 {0.010, 0.025},
                 {0.014, 0.038},
                 {0.027, 0.050},
                 {0.025, 0.064},
                 {0, 0.070}},
                Ends::axis, 3, 32);
}

TriangleMesh candle(const Fineness& fine) {
  return turned(fine,
                {{0, 0},
                 {0.045, 0},
                 {0.048, 0.004},
                 {0.045, 0.008},
                 {0.020, 0.010},
                 {0.0135, 0.014},
                 {0.0115, 0.022},
                 {0.0110, 0.080},
                 {0.0105, 0.150},
                 {0.0095, 0.154},
                 {0.006, 0.152},
                 {0, 0.151}},
                Ends::axis, 3, 32);
}

TriangleMesh flame(const Fineness& fine) {
  return turned(
      fine, {{0, 0}, {0.0035, 0.001}, {0.0060, 0.007}, {0.0055, 0.014}, {0.0030, 0.024}, {0.0012, 0.031}, {0, 0.034}},
      Ends::axis, 2, 10);
}

TriangleMesh lamp_shade(const Fineness& fine) {
  return turned(
      fine,
      {{0.020, 0.165}, {0.030, 0.160}, {0.045, 0.145}, {0.085, 0.115}, {0.135, 0.065}, {0.165, 0.020}, {0.172, 0}},
      Ends::open, 3, 64);
}

TriangleMesh hoops(const Fineness& fine) {
  TriangleMesh whole;
  constexpr int count = 9;
  for (int i = 1; i < count; ++i) {
    const double along = pi * i / count;
    add_part(whole, torus(std::sin(along), 0.012, fine.segments(48), fine.segments(6)), 0, {0, -std::cos(along), 0});
  }
  return whole;
}

TriangleMesh pedestal(const Fineness& fine) {
  return turned(fine,
                {{0, 0},
                 {0.26, 0},
                 {0.285, 0.004},
                 {0.29, 0.03},
                 {0.285, 0.056},
                 {0.25, 0.065},
                 {0.215, 0.085},
                 {0.20, 0.13},
                 {0.185, 0.45},
                 {0.19, 0.76},
                 {0.205, 0.80},
                 {0.24, 0.82},
                 {0.265, 0.835},
                 {0.27, 0.865},
                 {0.265, 0.895},
                 {0.245, 0.90},
                 {0.12, 0.90},
                 {0, 0.90}},
                Ends::axis, 3, 48);
}

TriangleMesh figure(const Fineness& fine) {
  return turned(fine,
                {{0, 0},
                 {0.13, 0},
                 {0.155, 0.01},
                 {0.16, 0.04},
                 {0.145, 0.07},
                 {0.12, 0.085},
                 {0.125, 0.11},
                 {0.10, 0.14},
                 {0.065, 0.23},
                 {0.05, 0.34},
                 {0.055, 0.37},
                 {0.095, 0.385},
                 {0.10, 0.40},
                 {0.06, 0.415},
                 {0.065, 0.44},
                 {0.10, 0.49},
                 {0.095, 0.55},
                 {0.05, 0.595},
                 {0, 0.605}},
                Ends::axis, 4, 56);
}

TriangleMesh lamp_can(const Fineness& fine) {
  return turned(fine, {{0, 0}, {0.06, 0}, {0.085, 0.01}, {0.095, 0.05}, {0.105, 0.2}, {0.115, 0.35}}, Ends::open, 4,
                40);
}

TriangleMesh ring(const Fineness& fine) {
  return turned(fine,
                {{1.075, -0.14},
                 {1.085, 0},
                 {1.075, 0.14},
                 {1.05, 0.195},
                 {1.0, 0.215},
                 {0.965, 0.195},
                 {0.955, 0.14},
                 {0.955, 0},
                 {0.955, -0.14},
                 {0.965, -0.195},
                 {1.0, -0.215},
                 {1.05, -0.195}},
                Ends::loop, 4, 150);
}

TriangleMesh knot(const Fineness& fine) {
  std::vector<Vec3d> controls;
  constexpr int count = 36;
  for (int i = 0; i < count; ++i) {
    const double t = 2 * pi * i / count, r = 0.30 + 0.13 * std::cos(3 * t);
    controls.push_back({r * std::cos(2 * t), r * std::sin(2 * t), 0.16 * std::sin(3 * t)});
  }
  const auto curve = smooth_curve(controls, fine.steps(6), Ends::loop);
  return tube(curve, std::vector<double>(curve.size(), 0.07), Ends::loop, fine.segments(28));
}

TriangleMesh ladder(const Fineness& fine) {
  TriangleMesh whole;
  for (const double x : {-0.25, 0.25})
    add_part(whole,
             bent_tube(fine,
                       {{x, -0.1, -0.55},
                        {x, 0.45, -0.53},
                        {x, 0.66, -0.42},
                        {x, 0.72, -0.22},
                        {x, 0.66, -0.02},
                        {x, 0.45, 0.08},
                        {x, -0.1, 0.1},
                        {x, -0.6, 0.1},
                        {x, -1.2, 0.1}},
                       0.025, 0.025, 5, 12),
             0, Vec3d(0.0));
  for (const double y : {-0.35, -0.65, -0.95})
    add_part(whole, bent_tube(fine, {{-0.25, y, 0.1}, {0, y, 0.1}, {0.25, y, 0.1}}, 0.022, 0.022, 4, 12), 0,
             Vec3d(0.0));
  return whole;
}

TriangleMesh prism() {
  TriangleMesh mesh;
  const double half = 0.2, top = 0.2 * std::sqrt(3.0);
  const std::vector<Vec3d> corners = {{-0.5, 0, half}, {-0.5, 0, -half}, {-0.5, top, 0},
                                      {0.5, 0, half},  {0.5, 0, -half},  {0.5, top, 0}};
  mesh.resize_positions(corners.size());
  for (std::size_t i = 0; i < corners.size(); ++i) mesh.positions[i] = Vec3f(corners[i]);
  mesh.triangles = {{0, 2, 1}, {3, 4, 5}, {0, 1, 4}, {0, 4, 3}, {0, 3, 5}, {0, 5, 2}, {1, 2, 5}, {1, 5, 4}};
  return mesh;
}

TriangleMesh ripples(const Fineness& fine) {
  constexpr std::uint32_t waves = 14, seed = 40001;
  return sheet(3.05, 2.25, fine.segments(96), fine.segments(72), [](double x, double z) {
    HeightAt sum{0, 0, 0};
    for (std::uint32_t wave = 0; wave < waves; ++wave) {
      const double angle = 2 * pi * unit_hash(wave, 0, 0, seed), k = 3.5 * std::pow(1.16, wave);
      const double kx = k * std::cos(angle), kz = k * std::sin(angle), amplitude = 0.030 / k;
      const double phase = kx * x + kz * z + 2 * pi * unit_hash(wave, 1, 0, seed);
      sum.y += amplitude * std::sin(phase);
      sum.along_x += amplitude * kx * std::cos(phase);
      sum.along_z += amplitude * kz * std::cos(phase);
    }
    return sum;
  });
}

TriangleMesh curtain(const Fineness& fine) {
  return sheet(5, 2.5, fine.segments(280), fine.segments(16), [](double x, double z) {
    const double wander = 0.35 * std::sin(0.9 * x + 0.5 * z), wander_x = 0.315 * std::cos(0.9 * x + 0.5 * z),
                 wander_z = 0.175 * std::cos(0.9 * x + 0.5 * z);
    const double phase = 11 * (x + wander * 0.5) + 0.3 * z, c = std::cos(phase);
    return HeightAt{0.09 * std::sin(phase), 0.09 * c * 11 * (1 + wander_x * 0.5), 0.09 * c * (0.3 + 5.5 * wander_z)};
  });
}

}  // namespace photonproof::inline scenes_generators
