#include "reports/page/reduced_image.h"

#include <algorithm>

namespace photonproof::reports::inline reports_page {

Image reduced_image(const Image& image, int factor) {
  Image out((image.width + factor - 1) / factor, (image.height + factor - 1) / factor);
  for (int y = 0; y < out.height; ++y) {
    for (int x = 0; x < out.width; ++x) {
      const int x_end = std::min(image.width, (x + 1) * factor), y_end = std::min(image.height, (y + 1) * factor);
      double sum[3] = {0, 0, 0};
      for (int v = y * factor; v < y_end; ++v) {
        for (int u = x * factor; u < x_end; ++u) {
          for (int c = 0; c < 3; ++c) sum[c] += image.pixel(u, v)[c];
        }
      }
      const double count = static_cast<double>(x_end - x * factor) * (y_end - y * factor);
      for (int c = 0; c < 3; ++c) out.pixel(x, y)[c] = static_cast<float>(sum[c] / count);
    }
  }
  return out;
}

}  // namespace photonproof::reports::inline reports_page
