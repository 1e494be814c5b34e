// A picture in batches with independent random numbers: the mean is the image, the spread its variance.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "scenes/description/description.h"
#include "scenes/images/image.h"

namespace photonproof::inline reference_engines {

struct EngineBatch {
  int samples = 0;
  std::uint32_t seed = 0;  ///< 31 bits, as many as every engine takes
};

/// A pixel's samples in up to 16 batches of nearly equal size; one batch where there are too few samples for a
/// meaningful spread. Seeds are distinct and follow from `seed`.
std::vector<EngineBatch> engine_batches(int samples, std::uint64_t seed);

/// The size of the image that each batch has, the film of that size, of which a crop is kept, and the batches. Batch i
/// is in the file batch_i.exr.
struct BatchedPicture {
  int width = 0, height = 0;
  FilmDescription film;
  std::vector<EngineBatch> batches;
};

/// The kept part of every batch's image in the folder. Throws EngineFailure where an image is missing, broken or of
/// another size; `engine` begins the message ("Blender").
std::vector<Image> read_batches(const BatchedPicture& picture, const std::filesystem::path& folder,
                                const std::string& engine);

/// Pools images weighted by their samples: the mean, its variance, and the standard error of the image's mean. A single
/// image has no variance.
Rendering pooled_batches(const std::vector<EngineBatch>& batches, const std::vector<Image>& images);

/// Standard error of the mean over pixels and channels, as a share of it; 0 from one batch.
double relative_error_of_mean(const std::vector<EngineBatch>& batches, const std::vector<Image>& images);

/// Calls `progress` with the share of batches that a script reports as done on standard error, in lines like
/// "photonproof: 3".
struct BatchProgress {
  std::size_t batches;
  std::string engine;
  std::function<void(double, const std::string&)> progress;
  std::string text{};

  void operator()(std::string_view chunk);
};

/// The exception at the end of the last Python traceback in a program's output; empty where there is none.
std::string python_exception(const std::string& console);

}  // namespace photonproof::inline reference_engines
