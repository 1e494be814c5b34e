#include "harness/diagnosis/breakage.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <string>
#include <utility>

#include "harness/diagnosis/black_lines.h"
#include "harness/diagnosis/pictures/luminance.h"
#include "harness/diagnosis/places.h"
#include "harness/pixels/middle_of.h"
#include "scenes/base/text_numbers.h"

namespace photonproof::inline harness_diagnosis {
namespace {

std::size_t pixel_index(int x, int y, int width) {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
}

void find_not_finite(const Image& image, const SceneKnowledge& knowledge, Breakage& breakage) {
  std::vector<double> weight(image.pixels());
  std::size_t count = 0;
  for (std::size_t i = 0; i < image.pixels(); ++i)
    for (std::size_t c = 0; c < 3; ++c)
      if (!std::isfinite(image.rgb[3 * i + c])) weight[i] = 1;
  for (std::size_t i = 0; i < weight.size(); ++i)
    if (weight[i] > 0) {
      breakage.ignored[i] = 1;
      ++count;
    }
  if (count == 0) return;
  const std::string place = place_of(weight, image.width, image.height, knowledge);
  breakage.findings.push_back({"not-finite",
                               std::to_string(count) + (count == 1 ? " pixel is" : " pixels are") +
                                   " not a number (NaN or infinite)" + (place.empty() ? "" : " " + place),
                               "a division by zero or the square root of a negative number",
                               region_of(weight, image.width, image.height), 1});
  breakage.hopeless = count > image.pixels() / 2;
}

std::string percent_text_of(double share) {
  const int percent = static_cast<int>(share * 100 + 0.5);
  return std::to_string(percent) + " %";
}

void find_one_colour(const Image& image, const Image& reference, Breakage& breakage) {
  float low[3] = {1e30f, 1e30f, 1e30f}, high[3] = {-1e30f, -1e30f, -1e30f};
  float span = 0, darkest = 1e30f, brightest = 0;
  for (std::size_t i = 0; i < image.pixels(); ++i) {
    if (breakage.ignored[i]) continue;
    for (std::size_t c = 0; c < 3; ++c) {
      low[c] = std::min(low[c], image.rgb[3 * i + c]);
      high[c] = std::max(high[c], image.rgb[3 * i + c]);
    }
  }
  for (std::size_t c = 0; c < 3; ++c) span = std::max(span, high[c] - low[c]);
  for (const float v : reference.rgb) {
    darkest = std::min(darkest, v);
    brightest = std::max(brightest, v);
  }
  if (span > 0.003f || brightest - darkest < 0.05f) return;
  const PixelRegion whole{0, 0, image.width, image.height};
  if (high[0] < 0.003f && high[1] < 0.003f && high[2] < 0.003f)
    breakage.findings.push_back(
        {"black", "the image is black", "nothing was rendered, or values are written unscaled", whole, 1});
  else
    breakage.findings.push_back({"one-colour", "the whole image has one colour",
                                 "nothing was rendered, or values are far above white", whole, 1});
  breakage.hopeless = true;
}

bool is_black(const Image& image, std::size_t pixel) {
  for (std::size_t c = 0; c < 3; ++c)
    if (image.rgb[3 * pixel + c] > 1.5f / 255) return false;
  return true;
}

struct Patch {
  std::vector<std::size_t> pixels;
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;  ///< inclusive
  bool is_rectangle() const {
    const double box = static_cast<double>(x1 - x0 + 1) * (y1 - y0 + 1);
    return static_cast<double>(pixels.size()) > 0.92 * box && x1 - x0 >= 3 && y1 - y0 >= 3;
  }
};

/// Connected pixels that are black and not yet ignored.
std::vector<Patch> black_patches(const Image& image, const Breakage& breakage) {
  std::vector<std::uint8_t> done(image.pixels());
  std::vector<Patch> patches;
  for (std::size_t start = 0; start < image.pixels(); ++start) {
    if (done[start] || breakage.ignored[start] || !is_black(image, start)) continue;
    Patch patch{{}, image.width, image.height, 0, 0};
    std::vector<std::size_t> open{start};
    done[start] = 1;
    while (!open.empty()) {
      const std::size_t at = open.back();
      open.pop_back();
      patch.pixels.push_back(at);
      const int x = static_cast<int>(at % static_cast<std::size_t>(image.width)),
                y = static_cast<int>(at / static_cast<std::size_t>(image.width));
      patch.x0 = std::min(patch.x0, x);
      patch.x1 = std::max(patch.x1, x);
      patch.y0 = std::min(patch.y0, y);
      patch.y1 = std::max(patch.y1, y);
      const int nexts[4][2] = {{x + 1, y}, {x - 1, y}, {x, y + 1}, {x, y - 1}};
      for (const auto& [nx, ny] : nexts) {
        if (nx < 0 || ny < 0 || nx >= image.width || ny >= image.height) continue;
        const std::size_t next = pixel_index(nx, ny, image.width);
        if (done[next] || breakage.ignored[next] || !is_black(image, next)) continue;
        done[next] = 1;
        open.push_back(next);
      }
    }
    patches.push_back(std::move(patch));
  }
  return patches;
}

/// Whether the patch is the visible part of one object, which then is black for its own reason.
bool is_an_object(const Patch& patch, const SceneKnowledge& knowledge) {
  if (knowledge.seen.empty()) return false;
  std::vector<double> inside(knowledge.landmarks.size() + 1), all(knowledge.landmarks.size() + 1);
  for (const std::size_t i : patch.pixels) inside[knowledge.seen[i]] += 1;
  for (const std::uint16_t mark : knowledge.seen) all[mark] += 1;
  for (std::size_t k = 1; k < all.size(); ++k)
    if (inside[k] > 0.85 * static_cast<double>(patch.pixels.size()) && inside[k] > 0.85 * all[k]) return true;
  return false;
}

std::string patch_sentence(const Patch& patch, const Image& image) {
  const int width = patch.x1 - patch.x0 + 1, height = patch.y1 - patch.y0 + 1;
  if (width == image.width) {
    const std::string rows = std::to_string(height) + " rows";
    if (patch.y1 == image.height - 1) return "the lowest " + rows + " are black";
    if (patch.y0 == 0) return "the uppermost " + rows + " are black";
    return rows + " from the " + std::to_string(patch.y0 + 1) + "th on are black";
  }
  if (height == image.height) {
    const std::string columns = std::to_string(width) + " columns";
    if (patch.x1 == image.width - 1) return "the rightmost " + columns + " are black";
    if (patch.x0 == 0) return "the leftmost " + columns + " are black";
    return columns + " from the " + std::to_string(patch.x0 + 1) + "th on are black";
  }
  return "a tile of " + std::to_string(width) + " x " + std::to_string(height) + " pixels is black in the " +
         part_of_image((patch.x0 + patch.x1 + 1) / 2.0, (patch.y0 + patch.y1 + 1) / 2.0, image.width, image.height);
}

/// Bars of one width at opposite sides: they show the scene's surroundings in too wide a view, and were rendered.
bool is_frame(const std::vector<Patch>& holes, const Image& image) {
  for (const Patch& a : holes)
    for (const Patch& b : holes) {
      const bool beside = a.x0 == 0 && b.x1 == image.width - 1 && std::abs(a.x1 - (image.width - 1 - b.x0)) <= 1;
      const bool above = a.y0 == 0 && b.y1 == image.height - 1 && std::abs(a.y1 - (image.height - 1 - b.y0)) <= 1;
      if (&a != &b && (beside || above)) return true;
    }
  return false;
}

void find_holes(const Image& image, const SceneKnowledge& knowledge, Breakage& breakage) {
  std::vector<Patch> holes;
  std::size_t pixels = 0;
  for (Patch& patch : black_patches(image, breakage)) {
    double expected = 0;
    for (const std::size_t i : patch.pixels)
      for (std::size_t c = 0; c < 3; ++c) expected += std::min(1.0f, knowledge.reference.rgb[3 * i + c]);
    const bool stands_out = expected > 0.06 * static_cast<double>(patch.pixels.size());
    if (!stands_out || !patch.is_rectangle() || is_an_object(patch, knowledge)) continue;
    if (patch.pixels.size() < std::max<std::size_t>(16, image.pixels() / 1000)) continue;
    pixels += patch.pixels.size();
    holes.push_back(std::move(patch));
  }
  if (holes.empty() || is_frame(holes, image)) return;
  std::sort(holes.begin(), holes.end(),
            [](const Patch& a, const Patch& b) { return a.pixels.size() > b.pixels.size(); });
  const Patch& largest = holes.front();
  std::string sentence = patch_sentence(largest, image);
  if (holes.size() > 1) sentence = std::to_string(holes.size()) + " parts are black; the largest: " + sentence;
  for (const Patch& hole : holes)
    for (const std::size_t i : hole.pixels) breakage.ignored[i] = 1;
  const double share = static_cast<double>(pixels) / static_cast<double>(image.pixels());
  breakage.findings.push_back({"unrendered",
                               sentence + " (" + percent_text_of(share) + " of the image)",
                               "they were never rendered: work was divided wrongly, or threads ended too early",
                               {largest.x0, largest.y0, largest.x1 - largest.x0 + 1, largest.y1 - largest.y0 + 1},
                               share});
}

float middle_of_neighbours(const Image& image, int x, int y, const std::vector<std::uint8_t>& ignored) {
  std::vector<float> around;
  for (int dy = -1; dy <= 1; ++dy)
    for (int dx = -1; dx <= 1; ++dx) {
      const int nx = x + dx, ny = y + dy;
      if ((dx == 0 && dy == 0) || nx < 0 || ny < 0 || nx >= image.width || ny >= image.height) continue;
      if (ignored[pixel_index(nx, ny, image.width)]) continue;
      const float* p = image.pixel(nx, ny);
      around.push_back(std::min(1.0f, luminance_of_pixel(p)));
    }
  return middle_of(std::move(around));
}

/// The brightest value within two pixels, so that an edge at another place does not count as a firefly.
float brightest_near(const Image& image, int x, int y) {
  float most = 0;
  for (int ny = std::max(0, y - 2); ny <= std::min(image.height - 1, y + 2); ++ny)
    for (int nx = std::max(0, x - 2); nx <= std::min(image.width - 1, x + 2); ++nx)
      most = std::max(most, std::min(1.0f, luminance_of_pixel(image.pixel(nx, ny))));
  return most;
}

/// Finds single pixels far brighter than their neighbours, unless the reference's are, too; ignores them without a
/// finding.
void find_fireflies(const Image& image, const SceneKnowledge& knowledge, Breakage& breakage) {
  std::vector<double> bright(image.pixels());
  std::vector<float> spread;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const std::size_t i = pixel_index(x, y, image.width);
      if (breakage.ignored[i]) continue;
      const float value = std::min(1.0f, luminance_of_pixel(image.pixel(x, y)));
      const float around = middle_of_neighbours(image, x, y, breakage.ignored);
      if (around > 0.02f) spread.push_back(std::abs(value - around) / around);
      if (value > 2 * around + 0.1f && value > 1.4f * brightest_near(knowledge.reference, x, y) + 0.05f) bright[i] = 1;
    }
  if (spread.empty()) return;
  const double usual = middle_of(std::move(spread));  // half of all pixels differ less from their neighbours
  const double share =
      static_cast<double>(std::count(bright.begin(), bright.end(), 1.0)) / static_cast<double>(bright.size());
  if (share <= 0.004 || usual >= 0.15) return;
  breakage.has_fireflies = true;
  for (std::size_t i = 0; i < bright.size(); ++i)
    if (bright[i] > 0) breakage.ignored[i] = 1;
}

/// The image clamped, and rounded as bytes are.
Image as_shown(Image image) {
  for (float& v : image.rgb) v = std::round(std::clamp(v, 0.0f, 1.0f) * 255) / 255;
  return image;
}

bool has_one_value(const Image& image, int left, int top, int side) {
  for (int y = top; y < top + side; ++y)
    for (int x = left; x < left + side; ++x)
      for (int c = 0; c < 3; ++c)
        if (std::abs(image.pixel(x, y)[c] - image.pixel(left, top)[c]) > 1e-6f) return false;
  return true;
}

/// Black or white: light is missing or too bright there at any resolution.
bool is_at_an_end(const Image& image, int x, int y) {
  const float* rgb = image.pixel(x, y);
  return std::all_of(rgb, rgb + 3, [](float v) { return v <= 0 || v >= 1; });
}

/// Squares of one value each, among those in which the expected picture has several values.
struct CoarseSquares {
  int alike = 0, all = 0;
  std::vector<double> pixels;  ///< 1 where such squares are
  double share() const { return all < 16 ? 0 : static_cast<double>(alike) / all; }
};

CoarseSquares coarse_squares(const Image& image, const Image& expected, int side, int first) {
  CoarseSquares found{0, 0, std::vector<double>(image.pixels())};
  for (int y = first; y + side <= image.height; y += side)
    for (int x = first; x + side <= image.width; x += side) {
      if (has_one_value(expected, x, y, side)) continue;
      const bool is_alike = has_one_value(image, x, y, side);
      if (is_alike && is_at_an_end(image, x, y)) continue;
      ++found.all;
      if (!is_alike) continue;
      ++found.alike;
      for (int dy = 0; dy < side; ++dy)
        for (int dx = 0; dx < side; ++dx) found.pixels[pixel_index(x + dx, y + dy, image.width)] = 1;
    }
  return found;
}

/// Compares with squares that start elsewhere: in a coarse picture these hardly ever have one value. In dark and even
/// places squares have one value wherever they start.
void find_coarse(const Image& image, const SceneKnowledge& knowledge, Breakage& breakage) {
  const Image expected = as_shown(knowledge.reference);
  for (int side = 16; side >= 2; --side) {
    const CoarseSquares found = coarse_squares(image, expected, side, 0);
    constexpr double least_share = 0.25;  // few levels of grey make squares alike, too
    if (found.share() < least_share) continue;
    if (found.share() < 2 * coarse_squares(image, expected, side, side / 2).share() + 0.05) continue;
    const bool everywhere = found.share() > 0.9;
    const std::string words = std::to_string(side);
    const PixelRegion where =
        everywhere ? PixelRegion{0, 0, image.width, image.height} : region_of(found.pixels, image.width, image.height);
    breakage.findings.push_back(
        {"coarse",
         "the resolution is too low" + (everywhere ? "" : " in " + percent_text_of(found.share()) + " of the image") +
             ": " + words + " x " + words + " pixels share one value",
         everywhere ? "rendered smaller and enlarged, or only one pixel in " + words + " is computed"
                    : "part of it is rendered smaller and enlarged, as when time or work is saved",
         where, found.share()});
    // The squares may have the values of their corners, as if shifted: the rest, if there is any, shows more.
    if (!everywhere)
      for (std::size_t i = 0; i < found.pixels.size(); ++i)
        if (found.pixels[i] > 0) breakage.ignored[i] = 1;
    return;
  }
}

}  // namespace

Breakage find_breakage(const Image& submitted, const SceneKnowledge& knowledge) {
  Breakage breakage;
  breakage.ignored.assign(submitted.pixels(), 0);
  find_not_finite(submitted, knowledge, breakage);
  if (breakage.hopeless) return breakage;
  find_one_colour(submitted, knowledge.reference, breakage);
  if (breakage.hopeless) return breakage;
  if (std::optional<Finding> lines = find_lines(submitted, knowledge.reference, breakage.ignored))
    breakage.findings.push_back(*lines);
  find_holes(submitted, knowledge, breakage);
  find_coarse(submitted, knowledge, breakage);
  find_fireflies(submitted, knowledge, breakage);
  return breakage;
}

}  // namespace photonproof::inline harness_diagnosis
