#include "harness/python/arrays.h"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace nb = nanobind;

namespace photonproof::inline harness_python {
namespace {

/// The values as an array that owns them.
Array owner_of(std::vector<float> values, std::initializer_list<std::size_t> shape) {
  auto kept = std::make_unique<std::vector<float>>(std::move(values));
  float* const data = kept->data();
  const nb::capsule owner(kept.get(), [](void* vector) noexcept { delete static_cast<std::vector<float>*>(vector); });
  kept.release();  // the capsule's now
  return Array(data, shape, owner);
}

}  // namespace

void ArrayRows::read(int begin, int end, float* rgb) {
  const std::size_t row = 3 * static_cast<std::size_t>(width_);
  std::copy(rgb_ + static_cast<std::size_t>(begin) * row, rgb_ + static_cast<std::size_t>(end) * row, rgb);
}

Image image_of(const Pixels& pixels) {
  Image image(static_cast<int>(pixels.shape(1)), static_cast<int>(pixels.shape(0)));
  std::copy_n(pixels.data(), image.rgb.size(), image.rgb.data());
  return image;
}

Rendering rendering_of(const Pixels& mean, const std::optional<Pixels>& variance, const Metadata& metadata) {
  Rendering rendering;
  rendering.mean = image_of(mean);
  if (variance) rendering.variance = image_of(*variance);
  rendering.metadata = metadata;
  return rendering;
}

Array array_of(Image image) {
  const auto height = static_cast<std::size_t>(image.height), width = static_cast<std::size_t>(image.width);
  return owner_of(std::move(image.rgb), {height, width, 3});
}

nb::object array_of(std::optional<Image> image) { return image ? nb::cast(array_of(std::move(*image))) : nb::none(); }

nb::object array_of(std::vector<float> values, int width, int height) {
  if (values.empty()) return nb::none();
  return nb::cast(owner_of(std::move(values), {static_cast<std::size_t>(height), static_cast<std::size_t>(width)}));
}

nb::tuple arrays_of(Rendering rendering) {
  const int width = rendering.mean.width, height = rendering.mean.height;
  return nb::make_tuple(array_of(std::move(rendering.mean)), array_of(std::move(rendering.variance)),
                        array_of(std::move(rendering.alpha), width, height), std::move(rendering.metadata));
}

}  // namespace photonproof::inline harness_python
