#include "harness/diagnosis/pictures/picture_changes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "harness/diagnosis/pictures/luminance.h"
#include "harness/pixels/display.h"

namespace photonproof::inline harness_diagnosis_pictures {
namespace {

constexpr TurnRow turn_table[] = {
    {"", "", "", false, {1, 0, 0, 0, 1, 0}},
    {"upside-down",
     "the image is upside down",
     "rows are written from the bottom up, or y is not turned from world to image",
     false,
     {1, 0, 0, 0, -1, 1}},
    {"left-right",
     "the image is mirrored left to right",
     "the camera's x axis points the wrong way",
     false,
     {-1, 0, 1, 0, 1, 0}},
    {"rotated-180",
     "the image is turned by 180 degrees",
     "both image axes point the wrong way",
     false,
     {-1, 0, 1, 0, -1, 1}},
    {"transposed",
     "rows and columns are exchanged",
     "pixels are stored by x where they are read by y",
     true,
     {0, 1, 0, 1, 0, 0}},
    {"rotated-90",
     "the image is turned by 90 degrees clockwise",
     "rows and columns are exchanged, and one turned over",
     true,
     {0, 1, 0, -1, 0, 1}},
    {"rotated-270",
     "the image is turned by 90 degrees counter-clockwise",
     "rows and columns are exchanged, and one turned over",
     true,
     {0, -1, 1, 1, 0, 0}},
    {"anti-transposed",
     "rows and columns are exchanged, and both turned over",
     "pixels are stored by x where they are read by y",
     true,
     {0, -1, 1, -1, 0, 1}},
};

constexpr ChannelRow channel_table[] = {
    {{0, 1, 2}, "", "", ""},
    {{2, 1, 0}, "channels-swapped", "red and blue are exchanged", "BMP and TGA store blue first"},
    {{1, 0, 2}, "channels-swapped", "red and green are exchanged", "channels are stored in another order"},
    {{0, 2, 1}, "channels-swapped", "green and blue are exchanged", "channels are stored in another order"},
    {{1, 2, 0},
     "channels-swapped",
     "colours are exchanged: red shows green, green shows blue, blue shows red",
     "channels are stored in another order, or rows begin a byte late"},
    {{2, 0, 1},
     "channels-swapped",
     "colours are exchanged: red shows blue, green shows red, blue shows green",
     "channels are stored in another order, or rows begin a byte late"},
    {{-2, -2, -2}, "grey", "the image has no colours", "one value is computed for all channels"},
    {{-1, 1, 2}, "channel-missing", "the red channel is black", "a channel is never written"},
    {{0, -1, 2}, "channel-missing", "the green channel is black", "a channel is never written"},
    {{0, 1, -1}, "channel-missing", "the blue channel is black", "a channel is never written"},
};

double share_of(double v, double white) { return std::clamp(v / white, 0.0, 1.0); }

double wrapped(double v, double white) {
  const double bytes = std::floor(std::max(0.0, v / white) * 255 + 0.5);
  return white * std::fmod(bytes, 256) / 255;
}

constexpr ToneRow tone_table[] = {
    {"", "", "", [](double v, double) { return v; }},
    {"gamma-applied", "gamma applied where linear values are expected",
     "values are sRGB-encoded before they are written",
     [](double v, double white) { return white * encode_srgb(share_of(v, white)); }},
    {"gamma-applied", "gamma 2.2 applied where linear values are expected", "pow(v, 1/2.2) before values are written",
     [](double v, double white) { return white * std::pow(share_of(v, white), 1 / 2.2); }},
    {"gamma-twice", "gamma applied twice", "values are encoded by the program and again by its image writer",
     [](double v, double white) { return white * encode_srgb(encode_srgb(share_of(v, white))); }},
    {"gamma-missing", "gamma missing", "linear values are written where encoded ones are expected",
     [](double v, double white) { return white * decode_srgb(share_of(v, white)); }},
    {"gamma-missing", "gamma 2.2 undone once too often", "pow(v, 2.2) of values that are linear already",
     [](double v, double white) { return white * std::pow(share_of(v, white), 2.2); }},
    {"square-root", "the square root of the light is shown", "gamma 2 applied where linear values are expected",
     [](double v, double white) { return white * std::sqrt(share_of(v, white)); }},
    {"tone-mapped", "the image is tone-mapped, v / (1 + v)", "values are compressed where they should be clamped",
     [](double v, double white) { return white * std::max(0.0, v / white) / (1 + std::max(0.0, v / white)); }},
    {"wrap-around", "bright places wrap around to dark", "values above white are cut to 8 bits, not clamped", wrapped},
    {"negative", "the image is a negative", "white minus the value is written",
     [](double v, double white) { return white * (1 - share_of(v, white)); }},
};

float mean_over(const Image& image, double x0, double x1, double y0, double y1, std::size_t c) {
  double sum = 0, area = 0;
  for (int y = static_cast<int>(y0); y < std::min(image.height, static_cast<int>(std::ceil(y1))); ++y)
    for (int x = static_cast<int>(x0); x < std::min(image.width, static_cast<int>(std::ceil(x1))); ++x) {
      const double part =
          (std::min(x1, x + 1.0) - std::max(x0, double(x))) * (std::min(y1, y + 1.0) - std::max(y0, double(y)));
      sum += part * image.pixel(x, y)[c];
      area += part;
    }
  return static_cast<float>(area > 0 ? sum / area : 0);
}

/// Interpolates the four nearest pixels; (0.5, 0.5) is the first one's middle. Outside: NaN, or the nearest if `edge`.
float between(const Image& image, double x, double y, std::size_t c, bool edge) {
  if (!edge && (x < 0 || y < 0 || x > image.width || y > image.height)) return std::numeric_limits<float>::quiet_NaN();
  const double px = std::clamp(x - 0.5, 0.0, image.width - 1.0), py = std::clamp(y - 0.5, 0.0, image.height - 1.0);
  const int x0 = static_cast<int>(px), y0 = static_cast<int>(py);
  const int x1 = std::min(x0 + 1, image.width - 1), y1 = std::min(y0 + 1, image.height - 1);
  const double fx = px - x0, fy = py - y0;
  return static_cast<float>((image.pixel(x0, y0)[c] * (1 - fx) + image.pixel(x1, y0)[c] * fx) * (1 - fy) +
                            (image.pixel(x0, y1)[c] * (1 - fx) + image.pixel(x1, y1)[c] * fx) * fy);
}

template <class Value>
Image made(int width, int height, const Value& value) {
  Image image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (std::size_t c = 0; c < 3; ++c) image.pixel(x, y)[c] = value(x, y, c);
  return image;
}

}  // namespace

std::span<const TurnRow> turn_rows() { return turn_table; }
std::span<const ChannelRow> channel_rows() { return channel_table; }
std::span<const ToneRow> tone_rows() { return tone_table; }

Image turned(const Image& image, const TurnRow& row) {
  const std::array<int, 6>& m = row.matrix;
  return made(image.width, image.height, [&](int x, int y, std::size_t c) {
    return image.pixel(m[0] * x + m[1] * y + m[2] * (image.width - 1),
                       m[3] * x + m[4] * y + m[5] * (image.height - 1))[c];
  });
}

Image with_channels(const Image& image, const ChannelRow& row) {
  return made(image.width, image.height, [&](int x, int y, std::size_t c) {
    const float* p = image.pixel(x, y);
    const int from = row.order[c];
    if (from == -1) return 0.0f;
    return from == -2 ? luminance_of_pixel(p) : p[from];
  });
}

Image toned(const Image& image, const ToneRow& row, double white) {
  Image result = image;
  for (float& v : result.rgb)
    if (std::isfinite(v)) v = static_cast<float>(row.encode(v, white));
  return result;
}

Image viewed(const Image& image, double dx, double dy, double zoom) {
  const double mx = image.width / 2.0, my = image.height / 2.0;
  return made(image.width, image.height, [&](int x, int y, std::size_t c) {
    return between(image, mx + (x + 0.5 - dx - mx) / zoom, my + (y + 0.5 - dy - my) / zoom, c, false);
  });
}

Image restrided(const Image& image, int longer, bool from_last) {
  const int pixels = image.width * image.height;
  return made(image.width, image.height, [&](int x, int y, std::size_t c) {
    const int at = y * image.width + x + longer * (from_last ? y - (image.height - 1) : y);
    if (at < 0 || at >= pixels) return std::numeric_limits<float>::quiet_NaN();
    return image.pixel(at % image.width, at / image.width)[c];
  });
}

Image change_of(const Image& to, const Image& from) {
  Image change = to;
  for (std::size_t i = 0; i < change.rgb.size(); ++i) change.rgb[i] -= from.rgb[i];
  return change;
}

Image blurred(const Image& image, double deviation) {
  const int reach = static_cast<int>(std::ceil(3 * deviation));
  std::vector<double> taps;
  double sum = 0;
  for (int i = -reach; i <= reach; ++i) sum += taps.emplace_back(std::exp(-i * i / (2 * deviation * deviation)));
  const auto pass = [&](const Image& from, int sx, int sy) {
    return made(from.width, from.height, [&](int x, int y, std::size_t c) {
      double v = 0;
      for (int i = -reach; i <= reach; ++i)
        v += taps[static_cast<std::size_t>(i + reach)] *
             from.pixel(std::clamp(x + sx * i, 0, from.width - 1), std::clamp(y + sy * i, 0, from.height - 1))[c];
      return static_cast<float>(v / sum);
    });
  };
  return pass(pass(image, 1, 0), 0, 1);
}

Image coarse(const Image& image, int side) {
  return made(image.width, image.height, [&](int x, int y, std::size_t c) {
    const int x0 = x / side * side, y0 = y / side * side;
    return mean_over(image, x0, std::min(x0 + side, image.width), y0, std::min(y0 + side, image.height), c);
  });
}

Image resized(const Image& image, int width, int height) {
  if (image.width == width && image.height == height) return image;
  const double sx = static_cast<double>(image.width) / width, sy = static_cast<double>(image.height) / height;
  return made(width, height, [&](int x, int y, std::size_t c) {
    if (sx <= 1 && sy <= 1) return between(image, (x + 0.5) * sx, (y + 0.5) * sy, c, true);
    return mean_over(image, x * sx, (x + 1) * sx, y * sy, (y + 1) * sy, c);
  });
}

}  // namespace photonproof::inline harness_diagnosis_pictures
