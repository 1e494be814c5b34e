// Changes that programs make to whole pictures: turns, exchanged channels, encodings. Each is a change of the expected
// picture, with its sentence and cause.
#pragma once

#include <array>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "scenes/images/image.h"

namespace photonproof::inline harness_diagnosis_pictures {

struct TurnRow {
  const char* kind;
  const char* sentence;
  const char* cause;
  bool swaps_sides;           ///< only for square pictures
  std::array<int, 6> matrix;  ///< for the guess's pixel (x, y), from 0: x' = m0 x + m1 y + m2 (w-1), y' likewise
};
/// The first changes nothing.
std::span<const TurnRow> turn_rows();
Image turned(const Image& image, const TurnRow& row);

struct ChannelRow {
  std::array<int, 3> order;  ///< -1: none, black; -2: luminance
  const char* kind;
  const char* sentence;
  const char* cause;
};
std::span<const ChannelRow> channel_rows();
Image with_channels(const Image& image, const ChannelRow& row);

struct ToneRow {
  const char* kind;
  const char* sentence;
  const char* cause;
  double (*encode)(double value, double white);
};
std::span<const ToneRow> tone_rows();
Image toned(const Image& image, const ToneRow& row, double white);

/// The difference `to` - `from` of two images of one size.
Image change_of(const Image& to, const Image& from);

/// Shifted by dx, dy pixels and enlarged about the middle; NaN where nothing is known.
Image viewed(const Image& image, double dx, double dy, double zoom);
/// The image read in rows that are `longer` pixels longer than stored. The first or the last row stays. NaN where there
/// is nothing.
Image restrided(const Image& image, int longer, bool from_last);
/// Blurred by a Gaussian of this deviation in pixels.
Image blurred(const Image& image, double deviation);
/// Replaces every block of this many pixels a side by its mean.
Image coarse(const Image& image, int side);
/// Resized, by means over the area of each new pixel, or by interpolation where it is enlarged.
Image resized(const Image& image, int width, int height);

}  // namespace photonproof::inline harness_diagnosis_pictures
