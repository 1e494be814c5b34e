#include "harness/gates/named_fault.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <vector>

#include "harness/diagnosis/pictures/picture_changes.h"
#include "harness/pixels/display.h"
#include "harness/statistics/deviations.h"

namespace photonproof::inline harness_gates {
namespace {

constexpr double most_left = 0.15;  // share of the squared difference that the right change may leave
constexpr double least_gain = 0.004;

double srgb(double v) { return v <= 1 ? encode_srgb(std::max(0.0, v)) : 1.055 * std::pow(v, 1 / 2.4) - 0.055; }
double linear_of_srgb(double v) { return v <= 1 ? decode_srgb(std::max(0.0, v)) : std::pow((v + 0.055) / 1.055, 2.4); }
double power(double v, double exponent) { return std::pow(std::max(0.0, v), exponent); }

struct Tone {
  int times;  ///< how often the encoding is applied beside that which is right; -1: it is missing
  double (*change)(double);
};

/// They take linear values, also those above 1, which the rows of picture_changes.h clamp.
constexpr std::array tones{
    Tone{1, [](double v) { return srgb(v); }},
    Tone{1, [](double v) { return power(v, 1 / 2.2); }},
    Tone{2, [](double v) { return srgb(srgb(v)); }},
    Tone{2, [](double v) { return power(v, 1 / (2.2 * 2.2)); }},
    Tone{-1, [](double v) { return linear_of_srgb(v); }},
    Tone{-1, [](double v) { return power(v, 2.2); }},
};

const char* words_of(const Tone& tone, bool is_display_file) {
  if (tone.times < 0)
    return is_display_file ? "gamma is missing: values are written linear" : "gamma is undone once too often";
  if (is_display_file) return tone.times == 1 ? "gamma is applied twice" : "gamma is applied three times";
  return tone.times == 1 ? "gamma is applied where linear values are expected"
                         : "gamma is applied twice to linear values";
}

class Pictures {
 public:
  Pictures(const Rendering& reference, std::span<const Image* const> images)
      : reference_(reference.mean), mean_(mean_of(images)), noise_(reference.variance->rgb) {
    const auto n = static_cast<double>(images.size());
    for (std::size_t i = 0; i < noise_.size() && images.size() > 1; ++i) {
      double squares = 0;
      for (const Image* image : images) squares += std::pow(double{image->rgb[i]} - double{mean_.rgb[i]}, 2);
      noise_[i] += static_cast<float>(squares / (n * (n - 1)));
    }
  }

  const Image& reference() const { return reference_; }
  const Image& mean() const { return mean_; }

  /// Squared difference beyond noise, each value relative to its brightness, so that lights do not dominate.
  double unlike(const Image& expected) const {
    double sum = 0;
    for (std::size_t i = 0; i < mean_.rgb.size(); ++i)
      if (const double e = double{expected.rgb[i]}; std::isfinite(e)) sum += unlike_value(e, i);
    return std::max(0.0, sum);
  }

  /// The same of the reference shifted by whole pixels right and down; of large images only some rows are summed.
  double unlike_shifted(int dx, int dy) const {
    constexpr std::size_t enough = std::size_t{1} << 18;
    const int step = static_cast<int>(1 + mean_.pixels() / enough);
    double sum = 0;
    for (int y = std::max(0, dy); y < mean_.height + std::min(0, dy); y += step)
      for (int x = std::max(0, dx); x < mean_.width + std::min(0, dx); ++x)
        for (int c = 0; c < 3; ++c)
          sum += unlike_value(double{reference_.pixel(x - dx, y - dy)[c]},
                              static_cast<std::size_t>(mean_.pixel(x, y) - mean_.rgb.data() + c));
    return step * std::max(0.0, sum);
  }

  /// Mean over a block of 8 x 8 pixels and all channels, of the image less the reference, in its standard errors.
  double score(int x0, int y0) const {
    double off = 0, variance = 0, light = 0;
    for (int y = y0; y < std::min(y0 + 8, mean_.height); ++y)
      for (int x = x0; x < std::min(x0 + 8, mean_.width); ++x)
        for (int c = 0; c < 3; ++c) {
          const auto i = static_cast<std::size_t>(mean_.pixel(x, y) - mean_.rgb.data() + c);
          off += double{mean_.rgb[i]} - double{reference_.rgb[i]};
          light += double{reference_.rgb[i]};
          variance += double{noise_[i]};
        }
    return off / std::sqrt(variance + std::pow(0.002 * light, 2) + 1e-20);
  }

 private:
  double unlike_value(double expected, std::size_t i) const {
    const double x = double{mean_.rgb[i]};
    return ((x - expected) * (x - expected) - double{noise_[i]}) / (expected * expected + x * x + 1e-4);
  }

  Image reference_, mean_;
  std::vector<float> noise_;
};

struct Best {
  double least;
  std::string sentence{};
  void consider(double left, const std::string& words) {
    if (left >= least) return;
    least = left;
    sentence = words;
  }
};

void try_rows(const Pictures& pictures, bool is_display_file, Best& best) {
  const Image& light = pictures.reference();
  for (const TurnRow& row : turn_rows().subspan(1))
    if (!row.swaps_sides || light.width == light.height)
      best.consider(pictures.unlike(turned(light, row)), row.sentence);
  for (const ChannelRow& row : channel_rows().subspan(1))
    best.consider(pictures.unlike(with_channels(light, row)), row.sentence);
  for (const Tone& tone : tones) {
    Image changed = light;
    for (float& value : changed.rgb) value = static_cast<float>(tone.change(double{value}));
    best.consider(pictures.unlike(changed), words_of(tone, is_display_file));
  }
  for (const ToneRow& row : tone_rows().subspan(1))
    if (std::string_view(row.kind) == "tone-mapped") best.consider(pictures.unlike(toned(light, row, 1)), row.sentence);
}

/// Shifts by whole pixels, of which the smallest that is as good as the best counts.
void try_shifts(const Pictures& pictures, Best& best) {
  constexpr int most = 4, least_side = 4 * most;
  if (std::min(pictures.mean().width, pictures.mean().height) < least_side) return;
  for (int distance = 1; distance <= 2 * most; ++distance)
    for (int dy = -most; dy <= most; ++dy)
      for (int dx = -most; dx <= most; ++dx) {
        if (std::abs(dx) + std::abs(dy) != distance) continue;
        const double left = pictures.unlike_shifted(dx, dy);
        if (left >= 0.9 * best.least) continue;
        std::string words;
        const auto add = [&](int pixels, const char* up, const char* down) {
          if (pixels == 0) return;
          words += fmt::format("{}{} {} {}", words.empty() ? "" : " and ", std::abs(pixels),
                               std::abs(pixels) == 1 ? "pixel" : "pixels", pixels < 0 ? up : down);
        };
        add(dx, "left", "right");
        add(dy, "up", "down");
        best.consider(left, "the image is shifted by " + words);
      }
}

/// The factor that fits the values of some channels best, beginning with `first`, each `step`-th.
double gain_of(const Pictures& pictures, std::size_t first, std::size_t step) {
  double products = 0, squares = 0;
  for (std::size_t i = first; i < pictures.mean().rgb.size(); i += step) {
    const double r = double{pictures.reference().rgb[i]}, x = double{pictures.mean().rgb[i]};
    const double weight = 1 / (r * r + x * x + 1e-4);
    products += weight * r * x;
    squares += weight * r * r;
  }
  return squares > 0 ? products / squares : 1;
}

using Gains = std::array<double, 3>;  // of red, green and blue

/// The squared difference that the gains leave.
double unlike_scaled(const Pictures& pictures, const Gains& gains) {
  Image scaled = pictures.reference();
  for (std::size_t i = 0; i < scaled.rgb.size(); ++i)
    scaled.rgb[i] = static_cast<float>(gains[i % 3] * double{scaled.rgb[i]});
  return pictures.unlike(scaled);
}

/// One gain of all channels, else one of each channel, that leaves less than `most` of the squared difference.
std::optional<SeenFault> of_gain(const Pictures& pictures, double most) {
  constexpr const char* by_factor = "everywhere by the same factor";
  const double gain = gain_of(pictures, 0, 1);
  if (std::abs(gain - 1) >= least_gain && unlike_scaled(pictures, {gain, gain, gain}) < most)
    return SeenFault{fmt::format("the image is {} by {:.2g} %, {}", gain < 1 ? "darker" : "brighter",
                                 100 * std::abs(gain - 1), by_factor),
                     true};
  const Gains gains{gain_of(pictures, 0, 3), gain_of(pictures, 1, 3), gain_of(pictures, 2, 3)};
  if (std::ranges::none_of(gains, [](double g) { return std::abs(g - 1) >= least_gain; })) return std::nullopt;
  if (std::ranges::any_of(gains, [](double g) { return g <= 0; }) || unlike_scaled(pictures, gains) >= most)
    return std::nullopt;
  const auto percent = [](double g) { return std::round(1000 * (g - 1)) / 10 + 0.0; };  // + 0.0: never "-0.0"
  return SeenFault{fmt::format("the channels are scaled apart: R {:+.1f} %, G {:+.1f} %, B {:+.1f} %, {}",
                               percent(gains[0]), percent(gains[1]), percent(gains[2]), by_factor),
                   true};
}

/// Whether every channel lost or gained light, and none lost or gained less than a quarter of another's share. A light
/// may have a colour, but a channel that is wrong alone is no missing light.
bool channels_agree(const Pictures& pictures) {
  constexpr double least_of_most = 0.25;
  std::array<double, 3> changes{};
  for (std::size_t c = 0; c < 3; ++c) {
    double light = 0, found = 0;
    for (std::size_t i = c; i < pictures.mean().rgb.size(); i += 3) {
      light += double{pictures.reference().rgb[i]};
      found += double{pictures.mean().rgb[i]};
    }
    changes[c] = light > 0 ? found / light - 1 : 0;
  }
  const auto [least, most] = std::ranges::minmax(changes);
  return least > 0 ? least >= least_of_most * most : most < 0 && most <= least_of_most * least;
}

/// Blocks that are darker and nearly none that is brighter: light is missing. The reverse is light that should not be
/// there. Of few noisy images some blocks look brighter by chance. Fewer blocks may be one object that is wrong.
std::optional<SeenFault> of_light(const Pictures& pictures) {
  if (!channels_agree(pictures)) return std::nullopt;
  constexpr double certain = 6, least_share = 0.25, by_chance = 0.05;
  int blocks = 0, darker = 0, brighter = 0;
  for (int y = 0; y < pictures.mean().height; y += 8)
    for (int x = 0; x < pictures.mean().width; x += 8) {
      const double score = pictures.score(x, y);
      ++blocks;
      darker += score < -certain;
      brighter += score > certain;
    }
  const auto words = [&](const char* fault, int count, const char* way, int others, const char* other_way) {
    const std::string rest = others == 0 ? std::string("none is") : fmt::format("{} are", others);
    return SeenFault{
        fmt::format("{}: {:.0f} % of all blocks are {}, {} {}", fault, 100.0 * count / blocks, way, rest, other_way)};
  };
  if (darker >= least_share * blocks && brighter <= by_chance * darker)
    return words("light is missing", darker, "darker", brighter, "brighter");
  if (brighter >= least_share * blocks && darker <= by_chance * brighter)
    return words("there is light too much", brighter, "brighter", darker, "darker");
  return std::nullopt;
}

}  // namespace

std::optional<SeenFault> named_fault(const Rendering& reference, std::span<const Image* const> images,
                                     bool is_display_file) {
  const Pictures pictures(reference, images);
  const auto is_black = [](const Image& image) {
    return std::ranges::all_of(image.rgb, [](float value) { return value == 0; });
  };
  if (is_black(pictures.mean()) && !is_black(pictures.reference())) return SeenFault{"the image is black"};
  const double before = pictures.unlike(pictures.reference());
  Best best{most_left * before};
  try_rows(pictures, is_display_file, best);
  try_shifts(pictures, best);
  if (auto gain = of_gain(pictures, best.least)) return gain;
  if (!best.sentence.empty()) return SeenFault{best.sentence};
  return of_light(pictures);
}

}  // namespace photonproof::inline harness_gates
