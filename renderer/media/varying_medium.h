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

#include <array>
#include <memory>
#include <optional>

#include "renderer/lanes/path_sampler.h"
#include "renderer/media/free_flight.h"
#include "scenes/description/description.h"

namespace photonproof::inline renderer_media {

/// The frame of rays: p = world x scale + moved.
struct MediaFrame {
  Vec3d moved{0, 0, 0};
  double scale = 1;
};

/// A value that varies in space.
class Volume {
 public:
  Volume(const VolumeColour& value, const MediaFrame& frame);
  Rgb at(const Vec3f& p) const;
  struct Span {
    float begin, end;  ///< none where begin >= end
  };
  /// The part of a ray from 0 to `distance` in the box of the volume, whose sides are along the world's axes.
  Span inside(const Vec3f& origin, const Vec3f& direction, float distance) const;

 private:
  Vec3f local_point(const Vec3f& p) const;
  Rgb cell(const std::array<int, 3>& index) const;
  int wrapped(int i, int cells) const;

  Rgb constant_;
  std::shared_ptr<const VolumeGrid> grid_;  ///< empty where the value is constant
  VolumeFilter filter_ = VolumeFilter::trilinear;
  TextureWrap wrap_ = TextureWrap::clamp;
  std::array<Vec3f, 3> axes_;  ///< the rows of the map to the unit cube
  Vec3f offset_;
  Vec3f low_, high_;  ///< of the box
};

class VaryingMedium {
 public:
  VaryingMedium(const HeterogeneousDescription& d, const MediaFrame& frame);

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
