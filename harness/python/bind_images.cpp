#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "harness/python/arrays.h"
#include "harness/python/bindings.h"
#include "scenes/images/image.h"

namespace nb = nanobind;

namespace photonproof::inline harness_python {
namespace {

Parts read(const std::string& path, const std::string& layer) {
  Rendering rendering;
  {
    const nb::gil_scoped_release released;
    rendering = read_rendering(path, layer);
  }
  return arrays_of(std::move(rendering));
}

void write_whole_exr(const std::string& path, const Pixels& mean, const std::optional<Pixels>& variance,
                     const Metadata& metadata) {
  const Rendering rendering = rendering_of(mean, variance, metadata);
  const nb::gil_scoped_release released;
  write_exr(path, rendering);
}

void write_display(const std::string& path, const Pixels& mean, double exposure) {
  const Image image = image_of(mean);
  const nb::gil_scoped_release released;
  write_png(path, image, exposure);
}

/// Linear value of each sample from 0 to `greatest`, 255 or 65535: to the bit as image files are read.
nb::object srgb_table(int greatest) {
  std::vector<float> linear;
  linear.reserve(static_cast<std::size_t>(greatest) + 1);
  for (int sample = 0; sample <= greatest; ++sample) {
    const float v = static_cast<float>(sample) / static_cast<float>(greatest);
    linear.push_back(v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f));
  }
  return array_of(std::move(linear), greatest + 1, 1);
}

}  // namespace

void bind_images(nb::module_& module) {
  using namespace nb::literals;
  module.def("read", &read, "path"_a, "layer"_a);
  module.def("srgb_table", &srgb_table, "greatest"_a);
  module.def("write_exr", &write_whole_exr, "path"_a, "mean"_a, "variance"_a.none(), "metadata"_a);
  module.def("write_png", &write_display, "path"_a, "mean"_a, "exposure"_a);
}

}  // namespace photonproof::inline harness_python
