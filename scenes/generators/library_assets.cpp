#include "scenes/generators/library_assets.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "scenes/files/atomic_file.h"
#include "scenes/generators/gradient_noise.h"
#include "scenes/images/image.h"
#include "scenes/meshes/mesh.h"
#include "scenes/meshes/ply.h"

namespace photonproof::inline scenes_generators {
namespace {

namespace fs = std::filesystem;
using std::numbers::pi;

/// The value that write_png encodes to the byte of `value`: it takes linear light, and these images hold plain numbers.
float linear_of_byte(double value) {
  return static_cast<float>(value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4));
}

template <class Colour>
Image picture(int width, int height, const Colour& colour) {
  Image image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const RgbD c = colour(x, y);
      float* pixel = image.pixel(x, y);
      pixel[0] = static_cast<float>(c.x);
      pixel[1] = static_cast<float>(c.y);
      pixel[2] = static_cast<float>(c.z);
    }
  return image;
}

constexpr int kBumpSize = 64;

/// Waves that meet at the picture's edges, 0 to 1: eight along u, four along v.
double bump_height(double u, double v) { return 0.5 + 0.25 * (std::sin(16 * pi * u) + std::sin(8 * pi * v)); }

void write_bumps(const fs::path& target) {
  write_png(target.string(), picture(kBumpSize, kBumpSize, [](int x, int y) {
              return RgbD(linear_of_byte(bump_height((x + 0.5) / kBumpSize, 1 - (y + 0.5) / kBumpSize)));
            }));
}

/// The normals of heights 0.02 times the bumps', n = 2 rgb - 1.
void write_normals(const fs::path& target) {
  write_png(target.string(), picture(kBumpSize, kBumpSize, [](int x, int y) {
              const double u = (x + 0.5) / kBumpSize, v = 1 - (y + 0.5) / kBumpSize;
              const double du = 0.02 * 4 * pi * std::cos(16 * pi * u), dv = 0.02 * 2 * pi * std::cos(8 * pi * v);
              const Vec3d n = normalize(Vec3d{-du, -dv, 1});
              return RgbD(linear_of_byte(0.5 + n.x / 2), linear_of_byte(0.5 + n.y / 2), linear_of_byte(0.5 + n.z / 2));
            }));
}

/// One tile of the ground, mottled, with its joint along two edges.
void write_tiles(const fs::path& target) {
  constexpr int size = 128, joint = 4;
  write_png(target.string(), picture(size, size, [](int x, int y) {
              if (x < joint || y < joint) return RgbD{0.12, 0.11, 0.1};
              const double mottled = fractal_noise({x * 0.06, y * 0.06, 0}, 4, 7);
              return RgbD{0.36, 0.31, 0.25} * (1 + 0.25 * mottled);
            }));
}

/// Radiance 0.5 + cos^2 of the angle from the zenith and a soft sun, below the horizon 0.1; +y up, its middle to -z.
void write_sky(const fs::path& target) {
  constexpr int width = 128, height = 64;
  const double elevation = 50 * pi / 180, azimuth = 30 * pi / 180;
  const Vec3d sun{std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
                  -std::cos(elevation) * std::cos(azimuth)};
  write_exr(
      target.string(),
      {picture(width, height,
               [&](int x, int y) {
                 const double theta = pi * (y + 0.5) / height;
                 const double phi = 2 * pi * (x + 0.5) / width - pi;  // 0 in the middle
                 const Vec3d d{std::sin(theta) * std::sin(phi), std::cos(theta), -std::sin(theta) * std::cos(phi)};
                 if (d.y < 0) return RgbD(0.1);
                 const RgbD blue = RgbD{0.35, 0.5, 0.8} * (0.5 + d.y * d.y);
                 return blue + RgbD{6, 5.4, 4.5} * std::exp(60 * (dot(d, sun) - 1));
               }),
       std::nullopt,
       {}});
}

/// 8 x 4 texels without any symmetry. Their centres are 45 degrees apart; between them only the interpolation is
/// visible.
void write_coarse_sky(const fs::path& target) {
  write_exr(target.string(),
            {picture(8, 4,
                     [](int x, int y) {
                       return RgbD{0.1 + (5 * x + 7 * y + 3 * x * y) % 11 / 10.0, 0.2 + 0.1 * x, 0.9 - 0.2 * y};
                     }),
             std::nullopt,
             {}});
}

/// A pyramid upside down: base [-0.3,0.3]^2 at y = 2.5, tip at (0,2.25,0), faces outward.
void write_light_mesh(const fs::path& target) {
  write_file_atomically(target,
                        "# A pyramid upside down, made by `photonproof generate assets`.\n"
                        "v -0.3 2.5 -0.3\nv 0.3 2.5 -0.3\nv 0.3 2.5 0.3\nv -0.3 2.5 0.3\nv 0 2.25 0\n"
                        "f 1 4 3 2\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n");
}

std::string hundredths(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.2f", value);
  return text.data();
}

/// LM-63-2002, rotationally symmetric: 1000 cos^2 of the angle from the nadir, in steps of 5 degrees to 90.
void write_light_profile(const fs::path& target) {
  std::string angles, candela;
  for (int degrees = 0; degrees <= 90; degrees += 5) {
    const char* end = degrees == 45 ? "\n" : " ";
    angles += std::to_string(degrees) + end;
    candela += hundredths(1000 * std::pow(std::cos(degrees * pi / 180), 2)) + end;
  }
  angles.back() = candela.back() = '\n';
  write_file_atomically(target,
                        "IESNA:LM-63-2002\n[TEST] made by photonproof generate assets\n[MANUFAC] photonproof\n"
                        "TILT=NONE\n1 1000 1 19 1 1 2 0 0 0\n1 1 10\n" +
                            angles + "0\n" + candela);
}

/// 24 x 16 cells without any symmetry: red jumps from cell to cell, green grows with u, blue with v.
void write_chart(const fs::path& target) {
  constexpr int width = 24, height = 16;
  write_png(target.string(), picture(width, height, [](int x, int y) {
              return RgbD(linear_of_byte((7 * x + 13 * y + 5 * x * y) % 11 / 10.0),
                          linear_of_byte((x + 1) / double{width}), linear_of_byte((y + 1) / double{height}));
            }));
}

/// An octahedron with six unlike half-axes, smooth normals and uvs, faces outward.
void write_gem(const fs::path& target) {
  write_file_atomically(target,
                        "# An irregular octahedron, made by `photonproof generate assets`.\n"
                        "v 1 0 0\nv -0.8 0.1 0\nv 0 1.2 0.1\nv 0.1 -1 0\nv 0 0.1 0.9\nv -0.1 0 -1\n"
                        "vt 1 0.5\nvt 0 0.5\nvt 0.5 1\nvt 0.5 0\nvt 0.6 0.5\nvt 0.4 0.4\n"
                        "vn 1 0 0\nvn -1 0 0\nvn 0 1 0\nvn 0 -1 0\nvn 0 0 1\nvn 0 0 -1\n"
                        "f 1/1/1 3/3/3 5/5/5\nf 3/3/3 2/2/2 5/5/5\nf 2/2/2 4/4/4 5/5/5\nf 4/4/4 1/1/1 5/5/5\n"
                        "f 3/3/3 1/1/1 6/6/6\nf 2/2/2 3/3/3 6/6/6\nf 4/4/4 2/2/2 6/6/6\nf 1/1/1 4/4/4 6/6/6\n");
}

/// LM-63-2002, the whole circle: candela that differ in each of the eight planes, twice the tabulated by the
/// multiplier.
void write_lopsided_profile(const fs::path& target) {
  std::string text =
      "IESNA:LM-63-2002\n[TEST] made by photonproof generate assets\n[MANUFAC] photonproof\n"
      "TILT=NONE\n1 1000 2 7 9 1 2 0 0 0\n1 1 10\n0 15 30 45 60 75 90\n0 45 90 135 180 225 270 315 360\n";
  for (int horizontal = 0; horizontal <= 360; horizontal += 45)
    for (int vertical = 0; vertical <= 90; vertical += 15) {
      const double c = std::cos(vertical * pi / 180), h = horizontal * pi / 180;
      const double lean = 1 + std::sin(vertical * pi / 180) * (0.5 * std::cos(h) + 0.4 * std::sin(h));
      text += hundredths(250 * c * lean) + (vertical == 90 ? "\n" : " ");
    }
  write_file_atomically(target, text);
}

/// y = 1 + 0.03 cos(2 pi x / 0.5) over [-2,2]^2, 64 strips a wave, with the curve's normals.
void write_waves(const fs::path& target) {
  constexpr double amplitude = 0.03, wavelength = 0.5, half = 2;
  constexpr std::uint32_t strips = 512;
  TriangleMesh mesh;
  mesh.resize_positions(2 * (strips + 1));
  for (std::uint32_t i = 0; i <= strips; ++i) {
    const double x = -half + 2 * half * i / strips, k = 2 * pi / wavelength;
    const Vec3f normal(normalize(Vec3d{amplitude * k * std::sin(k * x), 1, 0}));
    for (const std::uint32_t side : {0u, 1u}) {
      mesh.positions[2 * i + side] = Vec3f(Vec3d{x, 1 + amplitude * std::cos(k * x), side == 0 ? half : -half});
      mesh.normals.push_back(normal);
    }
  }
  for (std::uint32_t i = 0; i < strips; ++i) {
    const std::uint32_t a = 2 * i, b = a + 2;  // the strip's left and right ends at +z; those at -z are one further
    mesh.triangles.push_back({a, b, b + 1});
    mesh.triangles.push_back({a, b + 1, a + 1});
  }
  write_ply(target, mesh);
}

}  // namespace

const std::vector<LibraryAsset>& library_assets() {
  static const std::vector<LibraryAsset> assets = {
      {"chart/chart.png", true, write_chart},
      {"chart-fisheye/chart.png", true, write_chart},
      {"chart-lens/chart.png", true, write_chart},
      {"chart-orthographic/chart.png", true, write_chart},
      {"chart-sky/sky.exr", true, write_coarse_sky},
      {"daylight/tiles.png", true, write_tiles},
      {"forms/chart.png", true, write_chart},
      {"forms/gem.obj", false, write_gem},
      {"furnace-bumpmap/bumps.png", true, write_bumps},
      {"furnace-normalmap/normals.png", true, write_normals},
      {"lamps/chart.png", true, write_chart},
      {"lamps/gem.obj", false, write_gem},
      {"lamps/lamp.ies", false, write_lopsided_profile},
      {"light-envmap/sky.exr", true, write_sky},
      {"light-ies/lamp.ies", false, write_light_profile},
      {"light-mesh/lamp.obj", false, write_light_mesh},
      {"maps/chart.png", true, write_chart},
      {"maps/normals.png", true, write_normals},
      {"materials/sky.exr", true, write_sky},
      {"water-caustic/waves.ply", false, write_waves},
  };
  return assets;
}

}  // namespace photonproof::inline scenes_generators
