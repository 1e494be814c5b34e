#include "harness/statistics/gate_tiles.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace photonproof::inline harness_statistics {
namespace {

constexpr double carried = 4;          // standard errors from which a pixel is named as a source of a deviation
constexpr double carried_share = 0.8;  // share of the place's deviation that such pixels must explain to be named
                                       // instead

struct Place {
  std::vector<std::size_t> blocks;
  std::array<bool, 3> channels{};
  double score = 0;
  bool brighter = false;
};

/// The channel and sign by which a block belongs to a place.
struct Off {
  double score = 0;
  bool brighter = false;
  std::array<bool, 3> channels{};
};

Off block_off(const Deviations& d, const BlockScore& score, std::size_t block) {
  Off off;
  for (std::size_t c = 0; c < 3; ++c) {
    const double value = score(block, c);
    if (value <= 0) continue;
    off.channels[c] = true;
    if (value <= off.score) continue;
    off.score = value;
    off.brighter = d.blocks[c][block].difference > 0;
  }
  return off;
}

std::vector<Place> places_of(const Deviations& d, const std::vector<Off>& offs) {
  const auto columns = static_cast<std::size_t>((d.width + block_side - 1) / block_side);
  std::vector<Place> places;
  std::vector<bool> taken(offs.size());
  for (std::size_t first = 0; first < offs.size(); ++first) {
    if (taken[first] || offs[first].score <= 0) continue;
    Place place{{first}, {}, 0, offs[first].brighter};
    taken[first] = true;
    for (std::size_t i = 0; i < place.blocks.size(); ++i) {  // grows while it is walked
      const std::size_t b = place.blocks[i], x = b % columns;
      place.score = std::max(place.score, offs[b].score);
      for (std::size_t c = 0; c < 3; ++c) place.channels[c] = place.channels[c] || offs[b].channels[c];
      const auto visit = [&](bool inside, std::size_t other) {
        if (!inside || taken[other] || offs[other].score <= 0 || offs[other].brighter != place.brighter) return;
        taken[other] = true;
        place.blocks.push_back(other);
      };
      visit(x > 0, b - 1);
      visit(x + 1 < columns && b + 1 < offs.size(), b + 1);
      visit(b >= columns, b - columns);
      visit(b + columns < offs.size(), b + columns);
    }
    places.push_back(std::move(place));
  }
  return places;
}

/// Sums over some pixels of a place, over its channels, and their bounding box.
struct Extent {
  int x0 = 1 << 30, y0 = 1 << 30, x1 = 0, y1 = 0;
  std::size_t pixels = 0;
  double difference = 0, expected = 0;

  void add(int x, int y, double off, double reference) {
    x0 = std::min(x0, x), y0 = std::min(y0, y), x1 = std::max(x1, x + 1), y1 = std::max(y1, y + 1);
    ++pixels;
    difference += off;
    expected += reference;
  }
};

FailingTile tile_of(const Deviations& d, const Place& place) {
  Extent all, carriers;
  for (const std::size_t b : place.blocks)
    for_each_pixel(d.places[b], [&](int x, int y) {
      const auto i = static_cast<std::size_t>(y) * static_cast<std::size_t>(d.width) + static_cast<std::size_t>(x);
      double off = 0, reference = 0;
      bool carries = false;
      for (std::size_t c = 0; c < 3; ++c) {
        if (!place.channels[c]) continue;
        const Deviation& pixel = d.pixels[c][i];
        off += pixel.difference;
        reference += pixel.expected;
        const double errors = pixel.standard_error > 0 ? pixel.difference / pixel.standard_error : 0;
        carries = carries || (place.brighter ? errors : -errors) > carried;
      }
      all.add(x, y, off, reference);
      if (carries) carriers.add(x, y, off, reference);
    });
  const bool cut = carriers.pixels > 0 && carriers.difference / all.difference > carried_share;
  const Extent& extent = cut ? carriers : all;
  FailingTile tile{extent.x0, extent.y0, extent.x1 - extent.x0, extent.y1 - extent.y0, place.score, {}};
  const std::string names = channel_names(place.channels);
  tile.sentence = fmt::format("{} over {} px at ({}, {}){}", relative_text(extent.difference, extent.expected),
                              extent.pixels, extent.x0, extent.y0, names.empty() ? "" : ", " + names + " only");
  return tile;
}

}  // namespace

std::string channel_names(const std::array<bool, 3>& channels) {
  constexpr std::array names{"red", "green", "blue"};
  if (channels[0] && channels[1] && channels[2]) return "";
  std::string text;
  for (std::size_t c = 0; c < 3; ++c)
    if (channels[c]) text += (text.empty() ? "" : " and ") + std::string(names[c]);
  return text;
}

std::string relative_text(double difference, double expected) {
  if (expected == 0) return fmt::format("{:+.2g} (reference 0)", difference);
  const double percent = 100 * difference / std::abs(expected);
  return std::abs(percent) >= 100 && std::abs(percent) < 1e4 ? fmt::format("{:+.0f} %", percent)
                                                             : fmt::format("{:+.2g} %", percent);
}

std::vector<FailingTile> failing_tiles(const Deviations& deviations, const BlockScore& score) {
  std::vector<Off> offs;
  for (std::size_t b = 0; b < deviations.places.size(); ++b) offs.push_back(block_off(deviations, score, b));
  std::vector<FailingTile> tiles;
  for (const Place& place : places_of(deviations, offs)) tiles.push_back(tile_of(deviations, place));
  std::stable_sort(tiles.begin(), tiles.end(), [](const auto& a, const auto& b) { return a.score > b.score; });
  return tiles;
}

}  // namespace photonproof::inline harness_statistics
