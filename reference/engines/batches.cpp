#include "reference/engines/batches.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>

#include "reference/engines/engine_run.h"
#include "scenes/base/input_error.h"
#include "scenes/images/mean_error.h"

namespace photonproof::inline reference_engines {
namespace {

namespace fs = std::filesystem;

constexpr int most_batches = 16, least_samples = 2;

/// SplitMix64 (Steele, Lea and Flood 2014): the n-th number of a seed's sequence.
std::uint64_t mixed(std::uint64_t seed, std::uint64_t n) {
  std::uint64_t z = seed + (n + 1) * 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

/// Image `i` of the run.
Image batch_image(const BatchedPicture& picture, const fs::path& folder, std::size_t i, const std::string& engine) {
  const fs::path file = folder / ("batch_" + std::to_string(i) + ".exr");
  const auto failed = [&](const std::string& why) {
    return EngineFailure(EngineFailure::Kind::failed, engine + " ended well and " + why);
  };
  if (!fs::exists(file)) throw failed("wrote no image " + file.filename().string());
  Image image;
  try {
    image = read_image(file.string());
  } catch (const InputError& error) {
    throw failed("left an image that cannot be read: " + error.summary());
  }
  if (image.width != picture.width || image.height != picture.height)
    throw failed("wrote an image of " + std::to_string(image.width) + "x" + std::to_string(image.height) + " where " +
                 std::to_string(picture.width) + "x" + std::to_string(picture.height) + " was asked for");
  return kept_part(picture.film, image);
}

/// Each batch's share of the samples.
std::vector<double> weights_of(const std::vector<EngineBatch>& batches) {
  double samples = 0;
  for (const EngineBatch& batch : batches) samples += batch.samples;
  std::vector<double> weights;
  for (const EngineBatch& batch : batches) weights.push_back(batch.samples / samples);
  return weights;
}

/// Variance of the weighted mean over at least two batches, from their spread. A batch's variance is assumed to be
/// proportional to 1 / samples.
template <class Value>
double variance_of_mean(const std::vector<double>& weights, double mean, const Value& value) {
  double sum = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) sum += weights[i] * std::pow(value(i) - mean, 2);
  return sum / double(weights.size() - 1);
}

}  // namespace

std::vector<EngineBatch> engine_batches(int samples, std::uint64_t seed) {
  const int count = std::clamp(samples / least_samples, 1, most_batches);
  std::vector<EngineBatch> batches;
  for (int i = 0; i < count; ++i) {
    const int size = samples / count + (i < samples % count ? 1 : 0);
    batches.push_back({size, static_cast<std::uint32_t>(mixed(seed, static_cast<std::uint64_t>(i)) >> 33)});
  }
  return batches;
}

std::vector<Image> read_batches(const BatchedPicture& picture, const fs::path& folder, const std::string& engine) {
  std::vector<Image> images;
  for (std::size_t i = 0; i < picture.batches.size(); ++i) images.push_back(batch_image(picture, folder, i, engine));
  return images;
}

Rendering pooled_batches(const std::vector<EngineBatch>& batches, const std::vector<Image>& images) {
  const std::vector<double> weights = weights_of(batches);
  Rendering out;
  out.mean = Image(images.front().width, images.front().height);
  const std::size_t count = images.size();
  if (count > 1) out.variance = out.mean;
  std::vector<std::array<double, 3>> totals(count);
  for (std::size_t k = 0; k < out.mean.rgb.size(); ++k) {
    double mean = 0;
    for (std::size_t i = 0; i < count; ++i) {
      mean += weights[i] * double{images[i].rgb[k]};
      totals[i][k % 3] += double{images[i].rgb[k]};
    }
    out.mean.rgb[k] = static_cast<float>(mean);
    if (count > 1)
      out.variance->rgb[k] =
          static_cast<float>(variance_of_mean(weights, mean, [&](std::size_t i) { return double{images[i].rgb[k]}; }));
  }
  if (count < 2) return out;
  MeanError error;
  error.passes = double(count);
  const auto pixels = double(out.mean.pixels());
  for (std::size_t c = 0; c < 3; ++c) {
    double mean = 0;
    for (std::size_t i = 0; i < count; ++i) mean += weights[i] * totals[i][c] / pixels;
    error.standard_error[c] =
        std::sqrt(variance_of_mean(weights, mean, [&](std::size_t i) { return totals[i][c] / pixels; }));
  }
  store_mean_error(out, error);
  return out;
}

double relative_error_of_mean(const std::vector<EngineBatch>& batches, const std::vector<Image>& images) {
  const std::vector<double> weights = weights_of(batches);
  double mean = 0;
  std::vector<double> totals;
  for (std::size_t i = 0; i < images.size(); ++i) {
    double total = 0;
    for (const float value : images[i].rgb) total += double{value};
    totals.push_back(total);
    mean += weights[i] * total;
  }
  if (images.size() < 2 || !(mean > 0)) return 0;
  return std::sqrt(variance_of_mean(weights, mean, [&](std::size_t i) { return totals[i]; })) / mean;
}

void BatchProgress::operator()(std::string_view chunk) {
  constexpr std::string_view start = "photonproof: ";
  text += chunk;
  for (std::size_t end = text.find('\n'); end != std::string::npos; end = text.find('\n')) {
    int done = 0;
    if (text.starts_with(start)) std::from_chars(text.data() + start.size(), text.data() + end, done);
    if (done > 0 && progress) progress(std::min(1.0, double(done) / double(batches)), engine);
    text.erase(0, end + 1);
  }
}

std::string python_exception(const std::string& console) {
  const std::size_t trace = console.rfind("Traceback (most recent call last):");
  if (trace == std::string::npos) return "";
  for (std::size_t at = console.find('\n', trace); at != std::string::npos;) {
    const std::size_t start = at + 1, end = std::min(console.find('\n', start), console.size());
    if (start >= console.size()) break;
    if (console[start] != ' ' && console[start] != '\n') return console.substr(start, end - start);
    at = end < console.size() ? end : std::string::npos;
  }
  return "";
}

}  // namespace photonproof::inline reference_engines
