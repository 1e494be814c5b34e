#include "reference/engines/heightfield_mesh.h"

#include <algorithm>
#include <cmath>

#include "reference/engines/not_representable.h"
#include "scenes/generators/gradient_noise.h"

namespace photonproof::inline reference_engines {
namespace {

/// Interpolates between the centres of four texels of an image that repeats; mean of the channels.
double mean_channel(const Image& image, double u, double v) {
  const double x = u * image.width - 0.5, y = v * image.height - 0.5;
  const double left = std::floor(x), top = std::floor(y);
  double sum = 0;
  for (const int j : {0, 1})
    for (const int i : {0, 1}) {
      const auto wrapped = [](double at, int n) { return ((static_cast<int>(at) % n) + n) % n; };
      const float* rgb = image.pixel(wrapped(left + i, image.width), wrapped(top + j, image.height));
      const double weight = (i == 1 ? x - left : 1 - x + left) * (j == 1 ? y - top : 1 - y + top);
      sum += weight * (double{rgb[0]} + double{rgb[1]} + double{rgb[2]}) / 3;
    }
  return sum;
}

double height_at(const SceneDescription& scene, const HeightfieldDescription& field, double u, double v,
                 const std::string& engine) {
  if (const auto* noise = std::get_if<HeightfieldNoise>(&field.height)) {
    double greatest = 0;  // 1 + 1/2 + 1/4 ...
    for (int octave = 0; octave < noise->octaves; ++octave) greatest += std::ldexp(1.0, -octave);
    const Vec3d p{(2 * u - 1) * noise->frequency_x, (2 * v - 1) * noise->frequency_y, 0};
    return field.amplitude * fractal_noise(p, noise->octaves, noise->seed) / greatest;
  }
  const TextureDescription& texture = scene.textures[std::get<TextureIndex>(field.height).value];
  const auto* bitmap = std::get_if<BitmapDescription>(&texture.pattern);
  if (!bitmap || bitmap->filter != TextureFilter::bilinear || bitmap->wrap != TextureWrap::repeat ||
      !(bitmap->to_uv == Transform()))
    throw NotRepresentable(engine, scene.where(texture.loc),
                           "a heightfield of another texture than a bilinear bitmap that repeats, without to_uv");
  return field.amplitude * mean_channel(*bitmap->image, u, v);
}

}  // namespace

std::shared_ptr<const TriangleMesh> heightfield_mesh(const SceneDescription& scene, const HeightfieldDescription& field,
                                                     const std::string& engine) {
  const auto columns = static_cast<std::uint32_t>(field.columns), rows = static_cast<std::uint32_t>(field.rows);
  auto mesh = std::make_shared<TriangleMesh>();
  mesh->resize_positions(std::size_t{columns + 1} * (rows + 1));
  for (std::uint32_t j = 0; j <= rows; ++j)
    for (std::uint32_t i = 0; i <= columns; ++i) {
      const double u = static_cast<double>(i) / columns, v = static_cast<double>(j) / rows;
      mesh->positions[std::size_t{j} * (columns + 1) + i] =
          Vec3f(Vec3d{2 * u - 1, 2 * v - 1, height_at(scene, field, u, v, engine)});
    }
  for (std::uint32_t j = 0; j < rows; ++j)
    for (std::uint32_t i = 0; i < columns; ++i) {
      const std::uint32_t at = j * (columns + 1) + i, above = at + columns + 1;
      mesh->triangles.push_back({at, at + 1, above + 1});
      mesh->triangles.push_back({at, above + 1, above});
    }
  return mesh;
}

}  // namespace photonproof::inline reference_engines
