#include "harness/gate_mutants.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "harness/display.h"

namespace photonproof {
namespace {

template <class Change>
Image each_value(Image image, const Change& change) {
  for (float& value : image.rgb) value = change(value);
  return image;
}

Image more_energy(const Image& image) {
  return each_value(image, [](float value) { return 1.02f * value; });
}

/// To the right; the left column is doubled.
Image shifted(const Image& image) {
  Image out = image;
  for (int y = 0; y < image.height; ++y)
    for (int x = 1; x < image.width; ++x) std::copy_n(image.pixel(x - 1, y), 3, out.pixel(x, y));
  return out;
}

/// A twelfth of the sides, black, off the centre and off the grid of blocks.
Image with_hole(const Image& image) {
  Image out = image;
  const int side = std::max(1, std::min(image.width, image.height) / 12);
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x)
      std::fill_n(out.pixel(std::min(image.width / 3 + x, image.width - 1),
                            std::min(2 * image.height / 3 + y, image.height - 1)),
                  3, 0.0f);
  return out;
}

Image with_nan(const Image& image) {
  Image out = image;
  out.pixel(image.width / 2, image.height / 2)[1] = std::numeric_limits<float>::quiet_NaN();
  return out;
}

/// Mean over 3 x 3 pixels.
Image blurred(const Image& image) {
  Image out = image;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      for (int c = 0; c < 3; ++c) {
        float sum = 0;
        for (int dy = -1; dy <= 1; ++dy)
          for (int dx = -1; dx <= 1; ++dx)
            sum += image.pixel(std::clamp(x + dx, 0, image.width - 1), std::clamp(y + dy, 0, image.height - 1))[c];
        out.pixel(x, y)[c] = sum / 9;
      }
  return out;
}

/// Encoded by the sRGB curve and decoded by a power of 2.2, the usual mistake: right at 1, some per cent off below.
Image wrong_gamma(const Image& image) {
  return each_value(image, [](float value) {
    if (value <= 0 || value >= 1) return value;
    return static_cast<float>(std::pow(encode_srgb(double{value}), 2.2));
  });
}

Image swapped_channels(const Image& image) {
  Image out = image;
  for (std::size_t i = 0; i < out.rgb.size(); i += 3) std::swap(out.rgb[i], out.rgb[i + 2]);
  return out;
}

}  // namespace

std::span<const Variant> gate_variants() {
  // The faulty program has the faults in one instruction set (renderer/CMakeLists.txt).
#if defined(__x86_64__)
  static const std::vector<std::string> faulty_kernels{"--isa", "v2"};
#else
  static const std::vector<std::string> faulty_kernels{"--isa", "native"};
#endif
  static const std::vector<Variant> variants{
      {"dropped cosine", true, nullptr, "dropped-cosine", faulty_kernels},
      {"2 % energy", true, more_energy},
      {"one-pixel shift", true, shifted},
      {"missing caustic", true, nullptr, "missing-caustic", faulty_kernels},
      {"hole", true, with_hole},
      {"NaN", true, with_nan},
      {"blur", true, blurred},
      {"wrong gamma", true, wrong_gamma},
      {"swapped channels", true, swapped_channels},
      {"half photons", true, nullptr, "half-photons", faulty_kernels},
      {"other seeds", false},
      {"3 threads", false, nullptr, "", {}, 3},
      {"scalar kernels", false, nullptr, "", {"--isa", "scalar"}},
  };
  return variants;
}

}  // namespace photonproof
