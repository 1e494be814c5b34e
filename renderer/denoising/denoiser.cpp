#include "renderer/denoising/denoiser.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <vector>

#include "scenes/base/input_error.h"
#include "scenes/base/vec.h"

namespace photonproof::inline renderer_denoising {
namespace {

/// The power of two that brings the geometric mean of the positive values to about 1. The filter takes values below
/// 1e-8 for black. A mean would follow the brightest pixel.
float power_near_mean(const std::vector<float>& values) {
  std::int64_t exponents = 0, positive = 0;
  for (const float v : values) {
    if (!(v > 0)) continue;
    exponents += std::ilogb(v);
    ++positive;
  }
  if (positive == 0) return 1;
  return std::ldexp(1.0f, static_cast<int>(std::clamp<std::int64_t>(-exponents / positive, -126, 126)));
}

bool is_finite(const float* pixel) {
  return std::isfinite(pixel[0]) && std::isfinite(pixel[1]) && std::isfinite(pixel[2]);
}

/// Mean of a pixel's finite neighbours, at most eight; 0 without any. A black pixel would darken those beside it.
RgbD mean_around(const Image& image, int x, int y) {
  RgbD sum(0.0);
  int count = 0;
  for (int v = std::max(y - 1, 0); v <= std::min(y + 1, image.height - 1); ++v)
    for (int u = std::max(x - 1, 0); u <= std::min(x + 1, image.width - 1); ++u) {
      const float* pixel = image.pixel(u, v);
      if (!is_finite(pixel)) continue;
      sum += RgbD(double{pixel[0]}, double{pixel[1]}, double{pixel[2]});
      ++count;
    }
  return count > 0 ? sum / count : sum;
}

/// The colour as the filter gets it: finite, with a geometric mean near 1.
class FilterInput {
 public:
  explicit FilterInput(const Image& colour) : values_(colour.rgb) {
    for (int y = 0; y < colour.height; ++y)
      for (int x = 0; x < colour.width; ++x) {
        if (is_finite(colour.pixel(x, y))) continue;
        const RgbD around = mean_around(colour, x, y);
        const auto pixel = static_cast<std::size_t>(colour.pixel(x, y) - colour.rgb.data());
        values_[pixel] = static_cast<float>(around.x);
        values_[pixel + 1] = static_cast<float>(around.y);
        values_[pixel + 2] = static_cast<float>(around.z);
        left_.push_back(pixel);
      }
    scale_ = power_near_mean(values_);
    for (float& v : values_) v *= scale_;
  }

  const float* values() const { return values_.data(); }

  /// The filter's result as the colour, which keeps its values that are not finite. False where another one is not.
  bool copy_to(std::vector<float>& result, Image& colour) const {
    for (float& v : result) v /= scale_;
    for (const std::size_t i : left_) std::fill_n(&result[i], 3, 0.0f);
    if (!std::ranges::all_of(result, [](float v) { return std::isfinite(v); })) return false;
    for (const std::size_t i : left_) std::copy_n(&colour.rgb[i], 3, &result[i]);
    colour.rgb.swap(result);
    return true;
  }

 private:
  std::vector<float> values_;
  std::vector<std::size_t> left_;  ///< first values of pixels that are not finite
  float scale_ = 1;
};

std::string version_text(int number) {  // 20501
  return std::to_string(number / 10000) + "." + std::to_string(number / 100 % 100) + "." + std::to_string(number % 100);
}

}  // namespace

/// One filter of the library.
class Denoiser::Filter {
 public:
  using Progress = std::function<bool(double fraction)>;

  Filter(const OidnFunctions& oidn, OidnFunctions::Device device, const Progress& progress)
      : oidn_(oidn), filter_(oidn.NewFilter(device, "RT")), progress_(progress) {
    if (progress_) oidn_.SetFilterProgressMonitorFunction(filter_, &Filter::monitor, this);
  }
  ~Filter() { oidn_.ReleaseFilter(filter_); }
  Filter(const Filter&) = delete;
  Filter& operator=(const Filter&) = delete;

  /// The library writes to the image named "output" only.
  void image(const char* name, const float* rgb, const Image& size) {
    oidn_.SetSharedFilterImage(filter_, name, const_cast<float*>(rgb), OidnFunctions::format_float3,
                               static_cast<std::size_t>(size.width), static_cast<std::size_t>(size.height), 0, 0, 0);
  }
  void set(const char* name) { oidn_.SetFilterBool(filter_, name, true); }
  void run() {
    oidn_.CommitFilter(filter_);
    oidn_.ExecuteFilter(filter_);
  }

 private:
  /// Nothing may be thrown through the library.
  static bool monitor(void* user, double fraction) noexcept {
    Filter& filter = *static_cast<Filter*>(user);
    const std::lock_guard lock(filter.mutex_);
    return filter.progress_(fraction);
  }

  const OidnFunctions& oidn_;
  OidnFunctions::Filter filter_;
  const Progress& progress_;
  std::mutex mutex_;
};

Denoiser::Denoiser(const std::string& place, int threads) : oidn_(load_oidn(place)) {
  const auto refuse_failed = [this](OidnFunctions::Device device) {
    const char* words = nullptr;
    const int code = oidn_.GetDeviceError(device, &words);
    if (code == OidnFunctions::error_none && device != nullptr) return;
    const std::string why = words == nullptr ? "error " + std::to_string(code) : words;
    if (device_ != nullptr) oidn_.ReleaseDevice(device_);
    throw InputError("--denoise", "Open Image Denoise does not run here: " + why);
  };
  device_ = oidn_.NewDevice(OidnFunctions::device_type_cpu);
  refuse_failed(device_);
  oidn_.SetDeviceInt(device_, "numThreads", threads);
  oidn_.SetDeviceBool(device_, "setAffinity", false);  // else it would bind the renderer's threads to processors, too
  oidn_.CommitDevice(device_);
  refuse_failed(device_);
  version_ = version_text(oidn_.GetDeviceInt(device_, "version"));
}

Denoiser::~Denoiser() { oidn_.ReleaseDevice(device_); }

std::optional<NotDenoised> Denoiser::filter(Image& colour, const Guides& guides,
                                            const std::function<bool(double fraction)>& progress) const {
  const FilterInput input(colour);
  std::vector<float> output(colour.rgb.size());
  Filter filter(oidn_, device_, progress);
  filter.image("color", input.values(), colour);
  filter.image("albedo", guides.albedo.rgb.data(), colour);
  filter.image("normal", guides.normal.rgb.data(), colour);
  filter.image("output", output.data(), colour);
  filter.set("hdr");
  filter.run();
  const char* words = nullptr;
  const int code = oidn_.GetDeviceError(device_, &words);
  if (code == OidnFunctions::error_cancelled) return NotDenoised{true, "it was interrupted"};
  if (code != OidnFunctions::error_none)
    return NotDenoised{false, "Open Image Denoise: " + (words ? std::string(words) : "error " + std::to_string(code))};
  if (!input.copy_to(output, colour)) return NotDenoised{false, "Open Image Denoise: its result is not finite"};
  return std::nullopt;
}

std::uint64_t Denoiser::bytes(std::uint64_t pixels) {
  // Two guides, the filter's input and its output; the library itself takes 16 MB and 580 bytes a pixel of a tile.
  constexpr std::uint64_t images = 4 * 3 * sizeof(float), most_in_a_tile = 2160 * 2160;
  return (std::uint64_t{16} << 20) + images * pixels + 580 * std::min(pixels, most_in_a_tile);
}

}  // namespace photonproof::inline renderer_denoising
