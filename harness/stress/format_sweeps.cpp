// One picture in two formats. `compare` must find them equal up to the format's precision, or refuse the file where the
// format keeps nothing.

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "harness/stress/compared.h"
#include "harness/stress/other_formats.h"
#include "harness/stress/sweep_rows.h"
#include "scenes/files/atomic_file.h"
#include "scenes/files/scratch_folder.h"
#include "scenes/images/image.h"

namespace photonproof::inline harness_stress {
namespace {

namespace fs = std::filesystem;

/// Values between 0.3 and 0.9 times `factor`.
Image shades(int width, int height, double factor) {
  Image image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < 3; ++c)
        image.pixel(x, y)[c] = static_cast<float>(factor * (0.3 + 0.04 * ((3 * x + 5 * y + 7 * c) % 16)));
  return image;
}

/// The nearest half float: 11 bits, down to steps of 2^-24.
float as_half(float value) {
  int exponent = 0;
  std::frexp(value, &exponent);
  const int step = std::max(exponent - 11, -24);
  return static_cast<float>(std::ldexp(std::nearbyint(std::ldexp(double{value}, -step)), step));
}

struct Format {
  const char *name, *extension;
  std::function<void(const fs::path&, const Image&)> write;
  double kept;                                                   ///< The largest relative error of a value.
  std::vector<double> up, down;                                  ///< The levels k of 10^k and 10^-k.
  double highest, lowest;                                        ///< The last levels at which values should be right.
  std::function<float(float)> held = [](float v) { return v; };  ///< The stored value, where that is known.
};

std::vector<Format> formats() {
  const auto exr = [](ExrColour colour) {
    return [=](const fs::path& file, const Image& image) { write_exr(file.string(), {image, {}, {}}, colour); };
  };
  const std::vector<double> up{0, 2, 4, 5, 6, 9, 15, 30, 37}, down{0, 2, 4, 5, 6, 8, 9, 15, 30, 37};
  std::vector<double> further = down;
  further.insert(further.end(), {40, 44});
  return {{"EXR float", ".exr", exr(ExrColour::single), 0, up, further, 37, 44},
          {"EXR half", ".exr", exr(ExrColour::half), 0, up, {0, 2, 4, 5, 6, 7, 8}, 4, 8, as_half},
          {"PFM", ".pfm", write_pfm, 0, up, further, 37, 44},
          {"HDR", ".hdr", write_rgbe, 0x1p-6, up, down, 37, 37},
          {"TIFF float", ".tif", write_tiff_of_floats, 0, up, further, 37, 44}};
}

/// Formats of values from 0 to 1 only: they take the curve of sRGB and are clamped. The value that 16 bits keep is
/// computed; it is as exact as single precision until nothing is left.
std::vector<Format> formats_of_words() {
  const std::vector<double> down{0, 1, 2, 3, 4, 5, 6, 7};
  return {{"PNG 16 bits", ".png", write_png_of_words, 4e-6, {}, down, 0, 7, as_srgb_word},
          {"TIFF 16 bits", ".tif", write_tiff_of_words, 4e-6, {}, down, 0, 7, as_srgb_word}};
}

LevelVerdict in_two_formats(const StressRunner& runner, const Format& format, const Image& image, double scale) {
  const ScratchFolder scratch("stress");
  const fs::path plain = scratch.path() / "plain.exr",
                 other = scratch.path() / (std::string("other") + format.extension);
  Image held = image;
  for (float& v : held.rgb) v = format.held(v);
  write_exr(plain.string(), {held, {}, {}});
  format.write(other, image);
  return compare_files(runner, plain, other, {{"max_abs", format.kept * scale, 0, true}});
}

Sweep format_sweep(const Format& format, const char* sweep_run, const char* measure, const std::vector<double>& heights,
                   double wanted, const std::function<LevelVerdict(double, const StressRunner&)>& measured) {
  Sweep sweep{std::string("format ") + format.name, sweep_run, measure, heights, wanted, {}};
  sweep.engines = {"compare"};
  sweep.measured = measured;
  return sweep;
}

/// 8 bits of sRGB: half a step of 1/255 where the curve is steepest in [0.3, 0.9].
constexpr double of_eight_bits = 0.5 / 255 * 2.3;

}  // namespace

std::vector<Sweep> format_sweeps(const fs::path&) {
  std::vector<Sweep> sweeps;
  const std::vector<double> sides{1, 2, 3, 7, 8, 17, 1001, 30001};
  const auto add_values = [&](const Format& format, bool is_up) {
    const auto measured = [format, is_up](double k, const StressRunner& runner) {
      const double scale = std::pow(10.0, is_up ? k : -k);
      return in_two_formats(runner, format, shades(9, 5, scale), scale);
    };
    sweeps.push_back(
        is_up ? format_sweep(format, "values up", "values of 10^k", format.up, format.highest, measured)
              : format_sweep(format, "values down", "values of 10^-k", format.down, format.lowest, measured));
  };
  const auto add_sizes = [&](const Format& format) {
    sweeps.push_back(
        format_sweep(format, "size", "k x 3 pixels", sides, 30001, [format](double n, const StressRunner& runner) {
          return in_two_formats(runner, format, shades(static_cast<int>(n), 3, 1), 1);
        }));
  };
  for (const Format& format : formats()) {
    add_values(format, true);
    add_values(format, false);
    add_sizes(format);
  }
  for (const Format& format : formats_of_words()) {
    add_values(format, false);
    add_sizes(format);
  }
  add_sizes({"PNG",
             ".png",
             [](const fs::path& file, const Image& image) { write_png(file.string(), image); },
             of_eight_bits,
             {},
             {},
             0,
             0});
  return sweeps;
}

}  // namespace photonproof::inline harness_stress
