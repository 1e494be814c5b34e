// Tries gather radii before the first pass, on photons of a pilot and at points where camera paths of a pilot end. The
// photons are cut into halves, which are independent. L_1(r) and L_2(r) are the light of a pixel that they give, and
// D_i = L_i(r) - L_i(r/2). Two means over pixels are taken, relative to the image as in relmse:
//   `(D_1 - D_2)^2 / 4` has the variance of D with all photons for its mean. That is three times the variance of L(r).
//   `D_1 D_2` has the square of D's expectation for its mean. The squared bias follows from it (gather_bias.h).
// The product has an error of about `variance of D x sqrt(2/m)`, where m discs of the radius do not overlap. It is
// added, since a bias that photons cannot show may be there.
//
// A pixel's own value has much noise. It may be too bright by the very bias that is measured: a thin bright line in a
// dark place is light that leaks around an edge. So there are two scales of errors. Radii are chosen by means of pixels
// in some cells. The error to expect of light between diffuse surfaces, which is smooth, is relative to the brightest
// pixel around, of one sample each. Caustics are lines themselves.
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
    bool smooth;            ///< whether the light has no bright lines
  };
  /// Tries radii from the least on, until wider ones only add bias. The photons are those of `emitted` light paths, in
  /// the order of these. Without enough of them there are no trials.
  RadiusTrials try_radii(const Photons& photons, double emitted, const Limits& limits);

 private:
  /// Camera paths, one per pixel of a list.
  struct Paths {
    std::vector<float> radiance{};        ///< without photons; 3 values a path
    std::optional<GatherQueue> points{};  ///< null where the window has no pixel
  };
  /// Some pixels, and a few around each.
  struct Part {
    Paths at, around;
    std::vector<RgbD> scale{};         ///< factor of squared errors, by pixel and by its group
    std::vector<RgbD> scale_around{};  ///< by the pixels around; empty without them
  };
  /// Light of the paths of a part by each half of the photons.
  struct Light {
    std::array<std::vector<RgbD>, 2> by{};
    double found = 0, gathers = 0;  ///< photons found, and gathers
  };
  using Halves = std::array<Photons, 2>;
  using Maps = std::array<PhotonMap, 2>;

  Maps maps_of(const Halves& photons, float radius) const;
  std::vector<Light> gather(const Halves& photons, float radius);
  void gather_at(Paths& paths, const Maps& maps, const std::vector<SheetTest>& tests, float radius, Light& light) const;
  void measure_scales_by_groups(const std::vector<Light>& light);
  void measure_scales_around(const Halves& photons, float radius);
  static Light sums_of(const std::vector<Light>& light);
  GatherBias::Evidence compare(const std::vector<Light>& wide, const std::vector<Light>& narrow,
                               std::vector<RgbD> Part::*scales) const;

  const PhotonSource& source_;
  const GatherAreas& areas_;
  std::vector<Part> parts_;
};

}  // namespace photonproof::inline renderer_photon_mapping
