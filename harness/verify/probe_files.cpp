// Probes with files of lights and textures, and with the clear sky. Under a sky half of the floor is diffuse, to
// measure its light, and half a mirror, to see it.

#include <algorithm>
#include <array>
#include <cmath>

#include "harness/verify/probe_scenes.h"
#include "reference/closed_forms/closed_forms_lights.h"
#include "scenes/sky/clear_sky.h"

namespace photonproof::inline harness_verify {
namespace {

using namespace probe_scenes;

// A luminaire in candela: every 15 degrees of the angle from the nadir, every 90 degrees about it, linear in between.
constexpr std::array<std::array<double, 7>, 5> kCandela{{{10, 12, 16, 11, 6, 2, 0},
                                                         {10, 9, 7, 6, 4, 1, 0},
                                                         {10, 8, 5, 3, 2, 1, 0},
                                                         {10, 11, 13, 8, 5, 2, 0},
                                                         {10, 12, 16, 11, 6, 2, 0}}};
constexpr double kLuminaireHeight = 1.5;

std::string ies_text() {
  std::string text =
      "IESNA:LM-63-2002\nTILT=NONE\n1 1000 1 7 5 1 2 0 0 0\n1 1 10\n0 15 30 45 60 75 90\n0 90 180 270 360\n";
  for (const auto& plane : kCandela) {
    for (const double candela : plane) text += std::to_string(candela) + " ";
    text += "\n";
  }
  return text;
}

RgbD by_luminaire(double x, double y) {
  const double from_nadir = std::atan2(std::hypot(x, y), kLuminaireHeight) * 180 / kPi / 15;
  const double turned = std::atan2(y, x) * 180 / kPi, about = (turned < 0 ? turned + 360 : turned) / 90;
  const auto t = std::min<std::size_t>(static_cast<std::size_t>(from_nadir), 5);
  const auto p = std::min<std::size_t>(static_cast<std::size_t>(about), 3);
  const auto in_plane = [&](std::size_t plane) {
    return std::lerp(kCandela[plane][t], kCandela[plane][t + 1], from_nadir - static_cast<double>(t));
  };
  const double candela = std::lerp(in_plane(p), in_plane(p + 1), about - static_cast<double>(p));
  return lit(irradiance_of_point(candela, {0, 0, kLuminaireHeight}, {{x, y, 0}, {0, 0, 1}}));
}

/// The half of y > 0 is diffuse, the other a mirror.
std::string split_floor() {
  const auto half = [](const std::string& y, const std::string& bsdf) {
    return R"(<shape type="rectangle"><transform name="to_world"><scale x="4" y="2"/><translate y=")" + y +
           R"("/></transform>)" + bsdf + "</shape>";
  };
  return half("2", diffuse("0.5")) + half("-2", mirror("1"));
}

Vec3d mirrored_view(double x, double y) { return normalize(Vec3d{x, y, 4}); }

// A sky with radiance 1 + (x, y, z) / 2 in its own direction (x, y, z), so that a surface facing y has irradiance pi +
// pi y / 3. It is turned so that its y is up.
Image linear_sky() {
  constexpr int width = 512, height = 257;
  Image image(width, height);
  for (int row = 0; row < height; ++row)
    for (int column = 0; column < width; ++column) {
      const double down = kPi * row / (height - 1), about = 2 * kPi * (column + 0.5) / width;
      float* pixel = image.pixel(column, row);
      pixel[0] = static_cast<float>(1 + std::sin(down) * std::sin(about) / 2);
      pixel[1] = static_cast<float>(1 + std::cos(down) / 2);
      pixel[2] = static_cast<float>(1 - std::sin(down) * std::cos(about) / 2);
    }
  return image;
}

RgbD under_image_sky(double x, double y) {
  if (y > 0) return RgbD{1, 1 + 1.0 / 3, 1} * kAlbedo;
  const Vec3d seen = mirrored_view(x, y);
  return RgbD{1 + seen.x / 2, 1 + seen.z / 2, 1 - seen.y / 2};
}

const Vec3d kSun = normalize(Vec3d{1, 0.5, 2});
constexpr double kTurbidity = 4, kGroundAlbedo = 0.2;

/// Irradiance of the upper half, by the midpoint rule.
RgbD irradiance_of_clear_sky(const ClearSky& sky) {
  constexpr int steps = 400;
  RgbD sum(0.0);
  for (int i = 0; i < steps * steps; ++i) {
    // Samples at the middles of equal parts of the floor's projected solid angle.
    const double sine = std::sqrt((i / steps + 0.5) / steps), about = 2 * kPi * (i % steps + 0.5) / steps;
    sum += sky.radiance({sine * std::cos(about), sine * std::sin(about), std::sqrt(1 - sine * sine)});
  }
  return sum * (kPi / (steps * steps));
}

RgbD under_clear_sky(double x, double y) {
  static const ClearSky sky(kTurbidity, RgbD(kGroundAlbedo), kSun, 1);
  static const RgbD irradiance = irradiance_of_clear_sky(sky) + sun_radiance(kSun.z, kTurbidity, 0.5358 * kPi / 180) *
                                                                    (cone_solid_angle(0.5358 * kPi / 180) * kSun.z);
  return y > 0 ? irradiance * (kAlbedo / kPi) : sky.radiance(mirrored_view(x, y));
}

// Four by four fields of colour over the floor. The first row is at v = 0, the floor's lower edge.
Image fields() {
  Image image(4, 4);
  for (int i = 0; i < 16; ++i) {
    float* pixel = image.pixel(i % 4, i / 4);
    pixel[0] = static_cast<float>(0.1 + 0.05 * i);
    pixel[1] = static_cast<float>(0.8 - 0.15 * (i % 4));
    pixel[2] = static_cast<float>(0.2 + 0.15 * (i / 4));
  }
  return image;
}

RgbD of_fields(double x, double y) {
  const auto field = [](double t) { return std::clamp(static_cast<int>((t + 1) * 2), 0, 3); };
  const int column = field(x), row = field(y);
  return {0.1 + 0.05 * (4 * row + column), 0.8 - 0.15 * column, 0.2 + 0.15 * row};
}

// Normals of a map in four fields over the floor, whose borders meet in the middle of the view. A slanting beam lights
// it.
const std::array<Vec3d, 4> kNormals{normalize(Vec3d{0.2, 0.1, 1}), normalize(Vec3d{-0.3, 0.1, 1}),
                                    normalize(Vec3d{0.2, -0.4, 1}), normalize(Vec3d{-0.3, -0.2, 1})};

Image normal_map() {
  Image image(2, 2);
  for (std::size_t i = 0; i < 4; ++i) {
    const double values[] = {kNormals[i].x, kNormals[i].y, kNormals[i].z};
    for (std::size_t c = 0; c < 3; ++c)
      image.pixel(static_cast<int>(i % 2), static_cast<int>(i / 2))[c] = static_cast<float>((1 + values[c]) / 2);
  }
  return image;
}

/// Radiance of a floor whose normals are bent to `n`. Bumps shadow each other by 2 / (1 + sqrt(1 + a^2 tan^2)). Here
/// a^2 is an eighth of the bend's squared tangent, tan^2 that of the light's slant (Estevez et al. 2019).
RgbD of_bent(const Vec3d& n) {
  const Vec3d to_light = normalize(Vec3d{-1, -1, 2});
  const auto squared_tangent = [](double cosine) { return 1 / (cosine * cosine) - 1; };
  const double shadow = 2 / (1 + std::sqrt(1 + squared_tangent(n.z) / 8 * squared_tangent(to_light.z)));
  return lit(2 * dot(n, to_light) * shadow);
}
RgbD of_normal_map(double x, double y) { return of_bent(kNormals[(y > 0 ? 2u : 0u) + (x > 0 ? 1u : 0u)]); }

// Heights of a map at the texels' middles, 4 units apart: the visible slope is 0.3 along x and -0.2 along y.
Image heights() {
  Image image(2, 2);
  for (int i = 0; i < 4; ++i)
    for (int c = 0; c < 3; ++c) image.pixel(i % 2, i / 2)[c] = static_cast<float>(1 + i % 2 * 1.2 - i / 2 * 0.8);
  return image;
}
RgbD of_heights(double, double) { return of_bent(normalize(Vec3d{-0.3, 0.2, 1})); }

// A tent of light: two slopes and two gables, open below. The front of a face is where its vertices run
// counter-clockwise.
constexpr std::array<Vec3d, 6> kTent{Vec3d{1.6, -0.4, 1.6}, {2.2, -0.4, 1.6}, {2.2, 0.4, 1.6},
                                     {1.6, 0.4, 1.6},       {1.9, -0.4, 1.2}, {1.9, 0.4, 1.2}};
constexpr std::array<std::array<std::size_t, 3>, 6> kTentFaces{
    {{0, 5, 4}, {0, 3, 5}, {2, 4, 5}, {2, 1, 4}, {1, 0, 4}, {3, 2, 5}}};
constexpr double kTentRadiance = 12;

std::string ply_text() {
  std::string text =
      "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 6\nproperty list uchar int vertex_indices\nend_header\n";
  for (const Vec3d& v : kTent)
    text += std::to_string(v.x) + " " + std::to_string(v.y) + " " + std::to_string(v.z) + "\n";
  for (const auto& f : kTentFaces)
    text += "3 " + std::to_string(f[0]) + " " + std::to_string(f[1]) + " " + std::to_string(f[2]) + "\n";
  return text;
}

RgbD by_tent(double x, double y) {
  double sum = 0;
  for (const auto& f : kTentFaces) {
    const std::array<Vec3d, 3> corners{kTent[f[0]], kTent[f[1]], kTent[f[2]]};
    sum += irradiance_of_polygon(kTentRadiance, corners, {{x, y, 0}, {0, 0, 1}});
  }
  return lit(sum);
}

}  // namespace

std::vector<Probe> probes_with_files() {
  const std::string grey = camera() + floor_of(diffuse("0.5"));
  const std::string slanting_beam = R"(<emitter type="directional"><vector name="direction" value="1,1,-2"/>
    <rgb name="irradiance" value="2"/></emitter></scene>)";
  return {
      {"light",
       "IES light",
       grey + R"(<emitter type="ies"><string name="filename" value="lamp.ies"/>
        <transform name="to_world"><translate z="1.5"/></transform></emitter></scene>)",
       by_luminaire,
       {{"lamp.ies", ies_text()}}},
      {"light",
       "mesh light",
       grey + light(R"(<shape type="ply"><string name="filename" value="tent.ply"/>)", kTentRadiance) + "</scene>",
       by_tent,
       {{"tent.ply", ply_text()}}},
      {"light",
       "image sky",
       camera() + split_floor() + R"(<emitter type="envmap"><string name="filename" value="sky.exr"/>
        <transform name="to_world"><rotate x="1" angle="90"/></transform></emitter></scene>)",
       under_image_sky,
       {{"sky.exr", linear_sky()}}},
      {"light",
       "sun and sky",
       camera() + split_floor() + R"(<emitter type="sunsky"><float name="turbidity" value="4"/>
        <rgb name="albedo" value="0.2"/><vector name="sun_direction" value="1,0.5,2"/></emitter></scene>)",
       under_clear_sky,
       {}},
      {"material",
       "bitmap",
       camera() + floor_of(R"(<bsdf type="diffuse"><texture type="bitmap" name="reflectance">
        <string name="filename" value="fields.exr"/><string name="filter_type" value="nearest"/>
        <transform name="to_uv"><scale value="4"/><translate x="-1.5" y="-1.5"/></transform></texture></bsdf>)") +
           sky("1") + "</scene>",
       of_fields,
       {{"fields.exr", fields()}}},
      {"material",
       "normal map",
       camera() +
           floor_of(R"(<bsdf type="normalmap"><texture type="bitmap" name="normalmap">
        <string name="filename" value="normals.exr"/><string name="filter_type" value="nearest"/></texture>)" +
                    diffuse("0.5") + "</bsdf>") +
           slanting_beam,
       of_normal_map,
       {{"normals.exr", normal_map()}}},
      {"material",
       "bump map",
       camera() +
           floor_of(R"(<bsdf type="bumpmap"><texture type="bitmap">
        <string name="filename" value="heights.exr"/></texture>)" +
                    diffuse("0.5") + "</bsdf>") +
           slanting_beam,
       of_heights,
       {{"heights.exr", heights()}}},
  };
}

}  // namespace photonproof::inline harness_verify
