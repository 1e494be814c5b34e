#include "harness/pixels/row_source.h"

#include <algorithm>

#include "scenes/base/input_error.h"
#include "scenes/base/size_text.h"

namespace photonproof::inline harness_pixels {

void ImageRowSource::read(int begin, int end, float* rgb) {
  const std::size_t row = 3 * static_cast<std::size_t>(image_.width);
  const float* from = image_.rgb.data() + static_cast<std::size_t>(begin) * row;
  std::copy_n(from, static_cast<std::size_t>(end - begin) * row, rgb);
}

RegionSource::RegionSource(RowSource& whole, const PixelRegion& region) : whole_(whole), region_(region) {
  const bool inside = region.x >= 0 && region.y >= 0 && region.width > 0 && region.height > 0 &&
                      region.width <= whole.width() - region.x && region.height <= whole.height() - region.y;
  if (!inside)
    throw InputError("--region", region.text() + " is no part of the image of " +
                                     size_text(whole.width(), whole.height()) + " pixels");
}

void RegionSource::read(int begin, int end, float* rgb) {
  const auto whole_row = 3 * static_cast<std::size_t>(whole_.width());
  const auto row = 3 * static_cast<std::size_t>(region_.width);
  rows_.resize(static_cast<std::size_t>(end - begin) * whole_row);
  whole_.read(region_.y + begin, region_.y + end, rows_.data());
  const float* from = rows_.data() + 3 * static_cast<std::size_t>(region_.x);
  for (int y = begin; y < end; ++y, from += whole_row, rgb += row) std::copy_n(from, row, rgb);
}

}  // namespace photonproof::inline harness_pixels
