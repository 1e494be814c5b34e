// A pilot's camera paths, a few thousand for the whole image. For each way to find light they measure the variance of a
// camera sample, its rays, and the points where photons would be gathered. All ways have the same camera samples.
//
// The pixels come in blocks that lie side by side, scattered over the image. Errors are relative to the mean of a
// block. A rare bright sample hides behind a mean that includes it. So the variance that a method adds to what all have
// is relative to the other pixels of the block.
// Samples come in two sets that do not depend on each other; within a set, Sobol samples are spread evenly. Passes of
// powers of two keep that gain. So a sample has two variances. That of a sample
// by itself is the variance within a set, in the mean over the sets. That of a sample among spread ones is the variance
// of a set's mean, from the difference of two sets, times the samples of a set.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "renderer/passes/scratch_pool.h"
#include "renderer/photon_mapping/photon_maps.h"

namespace photonproof::inline renderer_photon_mapping {

/// Numbers a camera sample, by surface; empty where the way leaves no such points.
using PointsBySurface = std::vector<double>;

struct PilotImage {
  static constexpr int sets = 2, samples_a_set = 4, samples_a_pixel = sets * samples_a_set;
  struct Pixel {
    std::array<RgbD, sets> sum{RgbD(0.0), RgbD(0.0)};  ///< over the samples of a set
    RgbD squares{0.0};                                 ///< sum over all samples
    RgbD without_photons{0.0};                         ///< sum over all samples, without gathered photons
    RgbD caustics{0.0}, dimmed_caustics{0.0};          ///< sums of CausticLight over all samples
    bool rough = false;                                ///< whether rough parts gather photons
    RgbD all() const { return sum[0] + sum[1]; }
  };
  std::vector<Pixel> pixels{};  ///< block after block
  std::size_t block = 1;        ///< pixels of a block
  double rays_a_sample = 0;
  PointsBySurface points_a_sample{}, caustic_points_a_sample{}, rough_points_a_sample{};
  double found_a_sample = 0;  ///< photons of the given map that gathers on rough parts find

  double mean() const;
};

/// Variance of a camera sample: mean over channel values of variance / (mean^2 + 0.01), by means of the whole image.
enum class Samples { by_themselves, spread };
double variance_of(const PilotImage& image, const PilotImage& whole, Samples samples);
/// A variance, and what carries it.
struct Spread {
  double variance = 0;
  double carriers = 0;  ///< pixels or blocks: as many as equal ones would be that have the same sum and sum of squares
};
/// The same of a part without indirect light, by themselves, and at most that of the whole: what only the part has is
/// chance.
Spread variance_within(const PilotImage& part, const PilotImage& whole);
/// The same of a whole image, when spread: what it has in common with its part, and what it adds, relative to other
/// pixels.
struct VarianceBeside {
  double common = 0;
  Spread added{};
};
VarianceBeside variance_beside(const PilotImage& part, const PilotImage& whole);
/// Mean square of the light that the whole image has and its part lacks, relative to the whole in the same way.
double mean_square_between(const PilotImage& part, const PilotImage& whole);

/// Pixels that count: all, or those where no rough part gathers photons in the image given first.
enum class Where { all_pixels, without_rough };
/// Light that the whole image has and its part lacks, photons left out.
struct LightBetween {
  double relative = 0;  ///< mean over channel values of difference / (mean^2 + 0.01)
  double carriers = 0;  ///< pixels: as many as equal ones would be that have the same sum and sum of squares
};
LightBetween light_between(const PilotImage& part, const PilotImage& whole, Where where);

/// Light of the caustic photons at the first diffuse surface, relative to the whole image as above. Its dimmed part is
/// the greatest that a path which goes on from there to the light can bring back.
struct CausticLight {
  double all = 0, dimmed = 0;
};
CausticLight caustic_light(const PilotImage& image, const PilotImage& whole, Where where);

class PathPilot {
 public:
  /// A pilot of about so many camera paths. All arguments must outlive this.
  PathPilot(const PhotonSource& source, const PathSettings& settings, const Tile& window, double paths);

  /// Caustic photons. Rough parts gather them. Beside the caustic map, so do later Lambertian vertices: these add
  /// noise.
  struct CausticMap {
    const PhotonMap& map;
    float radius;
  };
  PilotImage trace(PathPolicy policy, const CausticMap* caustics = nullptr);

 private:
  struct Left;
  std::vector<std::uint32_t> pixels_of(std::size_t chunk) const;
  void trace_chunk(std::size_t chunk, PathPolicy policy, const CausticMap* caustics, Left& left);
  void trace_set(const std::vector<std::uint32_t>& pixels, int set, PathPolicy policy, const CausticMap* caustics,
                 Left& left);
  void gather_caustics(GatherQueue& queue, const CausticMap& caustics, std::vector<float>& radiance,
                       std::vector<PilotImage::Pixel>& pixels) const;

  const PhotonSource& source_;
  const PathSettings& settings_;
  const std::vector<SheetTest> tests_;  ///< the least strict ones
  const Tile window_;
  const int block_width_, blocks_across_, blocks_down_, rows_a_chunk_;
  ScratchPool scratch_;
};

}  // namespace photonproof::inline renderer_photon_mapping
