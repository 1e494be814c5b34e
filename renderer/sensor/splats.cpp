#include "renderer/sensor/splats.h"

namespace photonproof::inline renderer_sensor {

SplatImage::SplatImage(const Tile& window, const ReconstructionFilter& filter, int film_width, int film_height)
    : SplatImage(window, filter) {
  for (int x = window.x0; x < window.x1; ++x) column_factors_.push_back(1 / filter_.integral_within(x, film_width));
  for (int y = window.y0; y < window.y1; ++y) row_factors_.push_back(1 / filter_.integral_within(y, film_height));
}

void SplatImage::add(const Splats& splats) {
  for (const Splat& s : splats)
    filter_.for_each_pixel(s.raster, window_.x1, window_.y1, [&](int x, int y, float weight) {
      if (!window_.contains(x, y)) return;
      const double factor = column_factors_.empty() ? 1
                                                    : column_factors_[std::size_t(x - window_.x0)] *
                                                          row_factors_[std::size_t(y - window_.y0)];
      sums_[index(x, y)] += RgbD(s.value) * (double{weight} * factor);
    });
}

}  // namespace photonproof::inline renderer_sensor
