#include "harness/diagnosis/pictures/arranged_totals.h"

#include "harness/diagnosis/pictures/luminance.h"
#include "harness/diagnosis/pictures/picture_changes.h"

namespace photonproof::inline harness_diagnosis_pictures {

void ArrangedTotals::encode(std::size_t tone) {
  const auto encoded = [&](const Image& image) {
    return comparison_.shown_of(tone == 0 ? image : toned(image, tone_rows()[tone], comparison_.white()));
  };
  colours_ = encoded(picture_);
  Image greys(static_cast<int>((picture_.pixels() + 2) / 3), 1);  // three to a pixel
  for (std::size_t pixel = 0; pixel < picture_.pixels(); ++pixel)
    greys.rgb[pixel] = luminance_of_pixel(&picture_.rgb[3 * pixel]);
  greys_ = encoded(greys);
  black_ = encoded(Image(1, 1)).front();
}

double ArrangedTotals::total(std::size_t turn, std::size_t channels, double most) const {
  const std::array<int, 6>& m = turn_rows()[turn].matrix;
  const std::array<int, 3>& order = channel_rows()[channels].order;
  const std::ptrdiff_t width = picture_.width, height = picture_.height;
  const Comparison::Rows rows = [&](int y, float* values) {
    std::ptrdiff_t pixel = m[1] * y + m[2] * (width - 1) + (m[4] * y + m[5] * (height - 1)) * width;
    for (std::ptrdiff_t x = 0; x < width; ++x, pixel += m[0] + m[3] * width)
      for (const int from : order) {
        const auto at = static_cast<std::size_t>(pixel);
        *values++ = from == -1 ? black_ : from == -2 ? greys_[at] : colours_[3 * at + static_cast<std::size_t>(from)];
      }
  };
  return comparison_.total_by_rows(rows, most);
}

}  // namespace photonproof::inline harness_diagnosis_pictures
