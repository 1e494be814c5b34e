#include "scenes/generators/showcase_pictures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "scenes/base/vec.h"
#include "scenes/generators/gradient_noise.h"

namespace photonproof::inline scenes_generators {
namespace {

using std::numbers::pi;

/// A picture of colour(u, v), v upwards, at the middle of each pixel.
template <class Colour>
Image painted(int width, int height, const Colour& colour) {
  Image image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const RgbD c = colour((x + 0.5) / width, 1 - (y + 0.5) / height);
      float* pixel = image.pixel(x, y);
      pixel[0] = static_cast<float>(c.x);
      pixel[1] = static_cast<float>(c.y);
      pixel[2] = static_cast<float>(c.z);
    }
  return image;
}

RgbD mix(const RgbD& a, const RgbD& b, double t) { return a + (b - a) * std::clamp(t, 0.0, 1.0); }

/// 0 below `low`, 1 above `high`.
double ramp(double low, double high, double v) { return std::clamp((v - low) / (high - low), 0.0, 1.0); }

/// The numbers that write_png encodes to the bytes of `value`.
double number_in_png(double value) { return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4); }

constexpr int kBoards = 8;
constexpr double kBoardLength = 0.5;  ///< of the picture

struct Board {
  double along, across;  ///< from 0 to 1 on the board
  std::uint32_t number;
};

Board board_at(double u, double v) {
  const double row = std::floor(v * kBoards);
  const auto r = static_cast<std::uint32_t>(row);
  const double x = u / kBoardLength + (r % 2 == 0 ? 0 : 0.5);
  const auto column = static_cast<std::uint32_t>(std::floor(x)) % 2;
  return {x - std::floor(x), v * kBoards - row, 2 * r + column};
}

/// 1 on a board, 0 in the joint about it.
double on_board(const Board& board) {
  const double edge = std::min(std::min(board.along, 1 - board.along) * kBoardLength * kBoards,
                               std::min(board.across, 1 - board.across));
  return ramp(0.01, 0.05, edge);
}

double grain(const Board& board) {
  return fractal_noise({board.along * 3 + 7.3 * board.number, board.across * 5 + 3.1 * board.number, 0.5}, 4, 77);
}

/// Three discs with soft edges side by side.
Image gobo(const std::array<RgbD, 3>& colours) {
  return painted(96, 96, [&](double u, double v) {
    RgbD sum(0.0);
    for (std::size_t i = 0; i < 3; ++i) {
      const double across = u - 0.18 - 0.32 * static_cast<double>(i), up = v - (i == 1 ? 0.36 : 0.58);
      sum = sum + colours[i] * ramp(0.155, 0.12, std::hypot(across, up));
    }
    return sum;
  });
}

}  // namespace

Image sunset_picture() {
  return painted(192, 144, [](double u, double v) {
    const double horizon = 0.36, x = (u - 0.62) * 4 / 3, y = v - 0.5;
    if (v > horizon) {
      const RgbD sky = mix({0.95, 0.42, 0.08}, {0.08, 0.10, 0.33}, (v - horizon) / 0.64);
      const double glow = std::exp(-12 * (x * x + y * y));
      return mix(mix(sky, {1.0, 0.62, 0.15}, glow), {1.0, 0.9, 0.55}, ramp(0.115, 0.105, std::hypot(x, y)));
    }
    const double depth = (horizon - v) / horizon;
    const double chop = fractal_noise({u * 6 / (0.25 + depth), 22 * std::sqrt(depth), 0}, 3, 5);
    const double glitter = ramp(0.14 + 0.25 * depth, 0, std::abs(x)) * ramp(-0.1, 0.35, chop);
    return mix(mix({0.30, 0.16, 0.12}, {0.02, 0.04, 0.10}, depth + 0.2 * chop), {1.0, 0.7, 0.3}, glitter);
  });
}

Image ranges_picture() {
  return painted(192, 144, [](double u, double v) {
    RgbD colour = mix({0.80, 0.62, 0.50}, {0.22, 0.38, 0.62}, (v - 0.45) * 1.9);
    for (int layer = 0; layer < 5; ++layer) {
      const double far = layer / 4.0, base = 0.70 - 0.14 * layer;
      const double crest = base + (0.16 - 0.03 * layer) * fractal_noise({u * (2.2 + layer), 9.7 * layer, 0.5}, 5, 31);
      if (v < crest) colour = mix({0.45, 0.50, 0.62}, {0.02, 0.06, 0.07}, far - 0.5 * (crest - v));
    }
    return colour;
  });
}

Image blocks_picture() {
  static constexpr std::array<double, 5> columns = {0.0, 0.22, 0.62, 0.86, 1.0}, rows = {0.0, 0.18, 0.55, 0.80, 1.0};
  static constexpr std::array<int, 16> fields = {1, 0, 0, 3, 0, 0, 2, 0, 2, 2, 2, 0, 0, 0, 0, 1};
  return painted(144, 192, [](double u, double v) {
    const std::array<RgbD, 4> colours = {RgbD{0.84, 0.82, 0.76}, RgbD{0.04, 0.10, 0.45}, RgbD{0.68, 0.04, 0.02},
                                         RgbD{0.88, 0.62, 0.04}};
    std::size_t i = 0, j = 0;
    while (u > columns[i + 1]) ++i;
    while (v > rows[j + 1]) ++j;
    for (const double line : columns)
      if (std::abs(u - line) < 0.016) return RgbD(0.015);
    for (const double line : rows)
      if (std::abs(v - line) < 0.012) return RgbD(0.015);
    // The large red field spans two columns of two rows.
    return colours[static_cast<std::size_t>(fields[4 * j + i])];
  });
}

Image waves_picture() {
  return painted(192, 192, [](double u, double v) {
    const double bend = 0.10 * std::sin(2 * pi * v) + 0.05 * std::sin(4 * pi * v + 3 * u);
    const double squeeze = u + bend + 0.06 * std::sin(2 * pi * u);
    const double stripe = std::sin(2 * pi * 13 * squeeze);
    return mix({0.01, 0.02, 0.06}, mix({0.90, 0.88, 0.80}, {0.85, 0.35, 0.25}, v), ramp(-0.25, 0.25, stripe));
  });
}

Image julia_picture() {
  return painted(192, 144, [](double u, double v) {
    double x = (u - 0.5) * 3.2, y = (v - 0.5) * 2.4, squared = 0, steps = 0;
    for (; steps < 160 && squared < 256; ++steps) {
      const double next = x * x - y * y - 0.8;
      y = 2 * x * y + 0.156;
      x = next;
      squared = x * x + y * y;
    }
    const double smooth = squared < 256 ? steps : steps + 1 - std::log2(std::log(squared) / 2);
    const double t = std::clamp(std::sqrt(std::max(0.0, smooth) / 160), 0.0, 1.0);
    const RgbD low = mix({0.01, 0.02, 0.09}, {0.06, 0.42, 0.60}, t * 2.6);
    return mix(mix(low, {0.95, 0.80, 0.45}, (t - 0.38) * 3), {0.80, 0.16, 0.05}, (t - 0.72) * 4);
  });
}

Image circles_picture() {
  return painted(192, 144, [](double u, double v) {
    const double x = u * 4, y = v * 3;
    const auto i = static_cast<std::uint32_t>(x), j = static_cast<std::uint32_t>(y);
    const double r = std::hypot(x - i - 0.5, (y - j - 0.5)) + 0.03 * fractal_noise({x * 2, y * 2, 0}, 3, 9);
    const auto band = static_cast<std::uint32_t>(std::min(4.0, r / 0.115));
    const auto hue = [&](std::uint32_t channel) { return unit_hash(4 * j + i, band, channel, 2026); };
    const double warm = hue(0), light = 0.15 + 0.75 * hue(1);
    return mix(RgbD{0.10, 0.35, 0.75}, RgbD{0.90, 0.30, 0.06}, ramp(0.35, 0.65, warm)) * light +
           RgbD{0.02, 0.08, 0.0} * hue(2);
  });
}

Image night_picture() {
  constexpr int width = 256, height = 160;
  return painted(width, height, [](double u, double v) {
    const auto px = static_cast<std::uint32_t>(u * width), py = static_cast<std::uint32_t>(v * height);
    RgbD colour = mix({0.030, 0.036, 0.075}, {0.003, 0.005, 0.018}, v * 1.3);
    if (unit_hash(px, py, 0, 99) > 0.9965) colour = colour + RgbD{0.30, 0.32, 0.38} * unit_hash(px, py, 1, 99);
    const double moon = std::hypot((u - 0.73) * 1.6, v - 0.76);
    colour = colour + RgbD{0.10, 0.11, 0.14} * std::exp(-14 * moon);
    const double mottled = 0.85 + 0.2 * fractal_noise({u * 40, v * 25, 0}, 3, 3);
    colour = mix(colour, RgbD{0.85, 0.82, 0.70} * mottled, ramp(0.062, 0.055, moon));
    for (std::uint32_t row = 0; row < 2; ++row) {
      const double wide = row == 0 ? 14 : 9;
      const auto house = static_cast<std::uint32_t>(u * wide);
      const double roof = (row == 0 ? 0.28 : 0.12) + 0.22 * unit_hash(house, row, 2, 99);
      if (v > roof) continue;
      colour = row == 0 ? RgbD{0.006, 0.007, 0.014} : RgbD{0.002, 0.002, 0.004};
      const std::uint32_t cell_x = px / 4, cell_y = py / 5;
      const bool pane = px % 4 > 0 && px % 4 < 3 && py % 5 > 1 && v < roof - 0.02;
      if (pane && unit_hash(cell_x, cell_y, 3 + row, 99) > 0.8)
        colour = RgbD{0.75, 0.45, 0.14} * (0.3 + 0.7 * unit_hash(cell_x, cell_y, 5, 99));
    }
    return colour;
  });
}

Image tiles_picture() {
  constexpr int tiles = 4;
  return painted(128, 128, [](double u, double v) {
    const double x = u * tiles, y = v * tiles;
    const auto i = static_cast<std::uint32_t>(x), j = static_cast<std::uint32_t>(y);
    const double edge = std::min({x - i, 1 - (x - i), y - j, 1 - (y - j)});
    const double shade = 0.85 + 0.15 * unit_hash(i, j, 0, 55) + 0.05 * fractal_noise({x * 3, y * 3, 0}, 3, 8);
    return mix({0.55, 0.57, 0.56}, mix({0.42, 0.62, 0.70}, {0.60, 0.74, 0.76}, unit_hash(i, j, 1, 55)) * shade,
               ramp(0.03, 0.07, edge));
  });
}

Image boards_picture() {
  return painted(256, 256, [](double u, double v) {
    const Board board = board_at(u, v);
    const double veins = 0.5 + 0.5 * std::sin(26 * board.across + 9 * grain(board));
    const double tone = 0.70 + 0.45 * unit_hash(board.number, 0, 0, 66) - 0.18 * veins;
    return RgbD{0.36, 0.205, 0.105} * (tone * (0.12 + 0.88 * on_board(board)));
  });
}

Image boards_heights() {
  return painted(256, 256, [](double u, double v) {
    const Board board = board_at(u, v);
    return RgbD(number_in_png(on_board(board) * (0.86 + 0.10 * grain(board))));
  });
}

Image ball_picture() {
  return painted(192, 96, [](double u, double v) {
    const std::array<RgbD, 3> colours = {RgbD{0.85, 0.06, 0.04}, RgbD{0.90, 0.88, 0.82}, RgbD{0.95, 0.55, 0.02}};
    if (v < 0.06 || v > 0.94) return RgbD{0.90, 0.88, 0.82};
    return colours[static_cast<std::size_t>(u * 6) % 3];
  });
}

Image warm_gobo() { return gobo({RgbD{0.90, 0.12, 0.04}, RgbD{0.95, 0.50, 0.10}, RgbD{0.95, 0.85, 0.65}}); }

Image cold_gobo() { return gobo({RgbD{0.08, 0.20, 0.95}, RgbD{0.08, 0.75, 0.50}, RgbD{0.55, 0.12, 0.90}}); }

Image evening_sky() {
  const double elevation = 38 * pi / 180, azimuth = -125 * pi / 180;  // from -z towards +x
  const Vec3d sun{std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
                  -std::cos(elevation) * std::cos(azimuth)};
  return painted(128, 64, [&](double u, double v) {
    const double theta = pi * (1 - v), phi = 2 * pi * u - pi;
    const Vec3d d{std::sin(theta) * std::sin(phi), std::cos(theta), -std::sin(theta) * std::cos(phi)};
    if (d.y < 0) return RgbD{0.10, 0.10, 0.10};
    const RgbD sky = mix({0.75, 0.78, 0.82}, {0.16, 0.32, 0.70}, std::sqrt(d.y) * 1.1);
    const double cloud = ramp(0.05, 0.6, fractal_noise({d.x * 3 / (d.y + 0.3), d.z * 3 / (d.y + 0.3), 0.5}, 5, 14));
    const double near = dot(d, sun) - 1;
    return mix(sky, RgbD{0.9, 0.88, 0.85}, 0.7 * cloud) + RgbD{1.0, 0.9, 0.75} * (15 * std::exp(60 * near)) +
           RgbD{0.5, 0.42, 0.3} * std::exp(9 * near);
  });
}

}  // namespace photonproof::inline scenes_generators
