// Removes noise from an image by Open Image Denoise's filter for ray tracing (Áfra, openimagedenoise.org), a neural
// network that is guided by albedo and normals. The result is biased by an unknown amount, and nothing of the image's
// variance layer holds for it.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "renderer/denoising/guides.h"
#include "renderer/denoising/oidn_library.h"
#include "scenes/images/image.h"

namespace photonproof::inline renderer_denoising {

/// Why no denoised image was made.
struct NotDenoised {
  bool cancelled = false;  ///< by the progress function
  std::string why{};       ///< in the library's words, one sentence
};

class Denoiser {
 public:
  /// `place` as in load_oidn; `threads` is the number to filter with. Throws InputError at "--denoise" where the
  /// library cannot be loaded or does not support this processor.
  Denoiser(const std::string& place, int threads);
  ~Denoiser();
  Denoiser(const Denoiser&) = delete;
  Denoiser& operator=(const Denoiser&) = delete;

  /// "2.5.1"
  const std::string& version() const { return version_; }

  /// Filters linear radiance in place; without a result it stays as it is. A pixel with a value that is not finite is
  /// the mean of its neighbours for the filter, and keeps its values. `progress` gets the share that is done, from one
  /// thread at a time, and returns false to cancel; it may be empty. The same bits for any number of threads.
  std::optional<NotDenoised> filter(Image& colour, const Guides& guides,
                                    const std::function<bool(double fraction)>& progress) const;

  /// Memory that `filter` takes for so many pixels, guides included and the colour not, in bytes. Measured with
  /// version 2.5.1.
  static std::uint64_t bytes(std::uint64_t pixels);

 private:
  class Filter;
  OidnFunctions oidn_;
  OidnFunctions::Device device_ = nullptr;
  std::string version_;
};

}  // namespace photonproof::inline renderer_denoising
