// Tries gather radii before the first pass, on photons of a pilot and at points where camera paths of a pilot end. The
// photons are cut into halves, which are independent. L_1(r) and L_2(r) are the light of a pixel that they give, and
// D_i = L_i(r) - L_i(r/2). Two means over pixels are taken, relative to the image as in relmse:
//   `(D_1 - D_2)^2 / 4` has the variance of D with all photons for its mean. That is three times the variance of L(r).
//   `D_1 D_2` has the square of D's expectation for its mean. The squared bias follows from it (gather_bias.h).
// The product has an error of about `variance of D x sqrt(2/m)`, where m discs of the radius do not overlap. It is
// added, since a bias that photons cannot show may be there.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "renderer/photon_mapping/gather_area.h"
#include "renderer/photon_mapping/photon_maps.h"
#include "renderer/photon_mapping/radius_trials.h"

namespace photonproof::inline renderer_photon_mapping {

class RadiusPilot {
 public:
  /// Traces the camera paths. All arguments must outlive this.
  RadiusPilot(const PhotonSource& source, const PathSettings& settings, const GatherAreas& areas, const Tile& window);

  struct Limits {
    double least, most;     ///< radii
    double most_found;      ///< photons that a gather finds, in the mean
    double least_exponent;  ///< of the squared bias
  };
  /// Tries radii from the least on, until wider ones only add bias. The photons are those of `emitted` light paths, in
  /// the order of these. Without enough of them there are no trials.
  RadiusTrials try_radii(const Photons& photons, double emitted, const Limits& limits);

 private:
  /// Camera paths of some pixels, one per pixel.
  struct Part {
    std::vector<float> radiance;          ///< without photons; 3 values a path
    std::optional<GatherQueue> points{};  ///< null where the window has no pixel
  };
  /// Light of the paths of a part by each half of the photons.
  struct Light {
    std::array<std::vector<RgbD>, 2> by{};
    double found = 0, gathers = 0;  ///< photons found, and gathers
  };
  using Halves = std::array<Photons, 2>;
  using Maps = std::array<PhotonMap, 2>;

  std::vector<Light> gather(const Halves& photons, float radius);
  void gather_part(std::size_t number, const Maps& maps, const std::vector<SheetTest>& tests, float radius,
                   Light& light);
  static Light sums_of(const std::vector<Light>& light);
  static RgbD mean_image(const Part& part, const Light& light, std::size_t first);
  GatherBias::Evidence compare(const std::vector<Light>& wide, const std::vector<Light>& narrow) const;

  const PhotonSource& source_;
  const GatherAreas& areas_;
  std::vector<Part> parts_;
};

}  // namespace photonproof::inline renderer_photon_mapping
