#include "renderer/shapes/heightfield.h"

#include <cmath>

#include "scenes/generators/gradient_noise.h"

namespace photonproof::inline renderer_shapes {
namespace {

double height(const HeightfieldDescription& d, const Textures& textures, const Vec2<double>& uv) {
  if (const auto* texture = std::get_if<TextureIndex>(&d.height)) {
    const Rgb rgb = textures.colour(texture->value, {static_cast<float>(uv.x), static_cast<float>(uv.y)});
    return d.amplitude * static_cast<double>(rgb.x + rgb.y + rgb.z) / 3;
  }
  const auto& noise = std::get<HeightfieldDescription::Noise>(d.height);
  const Vec3d p{(2 * uv.x - 1) * noise.frequency_x, (2 * uv.y - 1) * noise.frequency_y, 0};
  const double greatest = 2 - std::ldexp(1.0, 1 - noise.octaves);  // 1 + 1/2 + 1/4 ...
  return d.amplitude * fractal_noise(p, noise.octaves, noise.seed) / greatest;
}

}  // namespace

TriangleMesh make_heightfield(const HeightfieldDescription& d, const Textures& textures) {
  const auto columns = static_cast<std::uint32_t>(d.columns), rows = static_cast<std::uint32_t>(d.rows);
  TriangleMesh mesh;
  mesh.resize_positions(std::size_t{columns + 1} * (rows + 1));
  mesh.uvs.reserve(mesh.positions.size());
  mesh.triangles.reserve(2 * std::size_t{columns} * rows);
  for (std::uint32_t row = 0; row <= rows; ++row) {
    for (std::uint32_t column = 0; column <= columns; ++column) {
      const Vec2<double> uv{static_cast<double>(column) / columns, static_cast<double>(row) / rows};
      mesh.positions[mesh.uvs.size()] = Vec3f(Vec3d{2 * uv.x - 1, 2 * uv.y - 1, height(d, textures, uv)});
      mesh.uvs.push_back({static_cast<float>(uv.x), static_cast<float>(uv.y)});
      if (row == rows || column == columns) continue;
      const std::uint32_t here = row * (columns + 1) + column, above = here + columns + 1;
      mesh.triangles.push_back({here, here + 1, above + 1});
      mesh.triangles.push_back({here, above + 1, above});
    }
  }
  return mesh;
}

}  // namespace photonproof::inline renderer_shapes
