// NumPy's arrays and images. Arrays that come in are single precision, row-major and of shape (height, width, 3), as
// the package's own converter makes them (photonproof/_arrays.py).
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/map.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>

#include <map>
#include <optional>
#include <string>

#include "harness/pixels/row_source.h"
#include "scenes/images/image.h"

namespace photonproof::inline harness_python {

/// Linear Rec. 709 RGB, row 0 on top.
using Pixels = nanobind::ndarray<const float, nanobind::shape<-1, -1, 3>, nanobind::c_contig, nanobind::device::cpu>;
using Array = nanobind::ndarray<nanobind::numpy, float>;
using Metadata = std::map<std::string, std::string>;

/// The rows of an array, which is not copied and must outlive it.
class ArrayRows : public RowSource {
 public:
  explicit ArrayRows(const Pixels& pixels)
      : width_(static_cast<int>(pixels.shape(1))), height_(static_cast<int>(pixels.shape(0))), rgb_(pixels.data()) {}
  int width() const override { return width_; }
  int height() const override { return height_; }
  void read(int begin, int end, float* rgb) override;
  const float* in_memory() const override { return rgb_; }

 private:
  int width_, height_;
  const float* rgb_;
};

/// A copy.
Image image_of(const Pixels& pixels);
/// Copies of mean and variance.
Rendering rendering_of(const Pixels& mean, const std::optional<Pixels>& variance, const Metadata& metadata);

/// Takes the pixels over, without a copy: shape (height, width, 3).
Array array_of(Image image);
/// The same, or None without an image.
nanobind::object array_of(std::optional<Image> image);
/// Takes the values over, as shape (height, width); None where there are no values.
nanobind::object array_of(std::vector<float> values, int width, int height);
/// mean, variance or None, alpha or None, metadata.
nanobind::tuple arrays_of(Rendering rendering);

}  // namespace photonproof::inline harness_python
