#include "harness/pixels/data_windows.h"

#include <algorithm>

namespace photonproof::inline harness_pixels {
namespace {

struct StoredPart {
  PixelRegion stored;
  int width, height;  ///< of the image
};

StoredPart stored_part(const std::string& path, const std::string& layer) {
  const ImageRows rows(path, layer, ImageWindow::stored);
  const ImagePlace place = rows.place().value_or(ImagePlace{0, 0, rows.width(), rows.height()});
  return {{place.x, place.y, rows.width(), rows.height()}, place.width, place.height};
}

bool same_part(const PixelRegion& a, const PixelRegion& b) {
  return a.x == b.x && a.y == b.y && a.width == b.width && a.height == b.height;
}

/// The region that both have; empty where they share no pixel.
std::optional<PixelRegion> shared_part(const PixelRegion& a, const PixelRegion& b) {
  const int x = std::max(a.x, b.x), y = std::max(a.y, b.y);
  const int x_end = std::min(a.x + a.width, b.x + b.width), y_end = std::min(a.y + a.height, b.y + b.height);
  if (x >= x_end || y >= y_end) return std::nullopt;
  return PixelRegion{x, y, x_end - x, y_end - y};
}

}  // namespace

ComparedPart compared_part(const std::string& reference, const std::string& test, const std::string& layer) {
  const StoredPart a = stored_part(reference, layer), b = stored_part(test, layer);
  const auto is_whole = [](const StoredPart& p) { return p.stored.width == p.width && p.stored.height == p.height; };
  if (is_whole(a) && is_whole(b)) return {};
  if (a.width != b.width || a.height != b.height) {
    const bool equal = a.stored.width == b.stored.width && a.stored.height == b.stored.height;
    return {equal ? ImageWindow::stored : ImageWindow::displayed, {}, {}};
  }
  if (same_part(a.stored, b.stored)) return {ImageWindow::displayed, a.stored, {}};
  ComparedPart whole;
  whole.note = "the reference stores the pixels " + a.stored.text() + " (x y width height), the test image " +
               b.stored.text() + "; others count as black";
  if (const auto both = shared_part(a.stored, b.stored))
    whole.note += "; --region " + both->text() + " compares the part that both store";
  return whole;
}

}  // namespace photonproof::inline harness_pixels
