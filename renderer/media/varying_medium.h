// Media whose extinction and albedo vary in space, sampled without bias.
//
// Delta tracking (Woodcock et al. 1965) fills the medium up to a constant extinction m, the majorant, by collisions
// that change nothing. The density of a flight to the next collision is m exp(-m t). Its transmittance is exp(-m t) in
// every channel, so that a collision has the weight 1/m. There a channel c scatters with the coefficient s_c =
// sigma_t,c albedo_c or continues with n_c = m - sigma_t,c. Let w_c be the path's throughput, S the sum of w_c s_c and
// N that of w_c n_c. The path scatters with the chance S / (S + N), weighted by s_c (S + N) / (m S), and otherwise
// continues, weighted by n_c (S + N) / (m N). Each choice times its chance is what the integral has, in every channel,
// so the estimate has no bias. Either way the sum of the channels' throughputs becomes (S + N) / m: it never grows, as
// s_c + n_c <= m. This is spectral tracking by the path's history (Kutz et al. 2017, section 5.1). No channel is the
// hero, hence no weights against others' densities (Miller et al. 2019) are needed.
//
// Ratio tracking (Novak et al. 2014) is the same without scattering: each collision leaves n_c / m of the light.
#pragma once

#include <optional>

#include "renderer/lanes/path_sampler.h"
#include "renderer/media/free_flight.h"
#include "renderer/textures/volume.h"
#include "scenes/description/description.h"

namespace photonproof::inline renderer_media {

class VaryingMedium {
 public:
  /// The extinction is `factor` times that of the description.
  VaryingMedium(const HeterogeneousDescription& d, const VolumeFrame& frame, double factor = 1);

  bool scatters() const { return scatters_; }
  /// A flight along a ray from 0 to `distance`, which may be infinite. `draws` serve this flight alone.
  FreeFlight fly(const Rgb& throughput, const Vec3f& origin, const Vec3f& direction, float distance,
                 const PathSampler& draws) const;
  /// An estimate of the transmittance.
  Rgb transmittance(const Vec3f& origin, const Vec3f& direction, float distance, const PathSampler& draws) const;

 private:
  /// The next collision's distance.
  float next(float t, float u) const;
  Rgb extinction(const Vec3f& p) const;

  Volume sigma_t_, albedo_;
  float scale_, majorant_;
  bool scatters_;
};

/// Random numbers for one flight, as many as it takes.
PathSampler draws_of_flight(PathSampler draws, std::uint32_t dimension);

}  // namespace photonproof::inline renderer_media
