// A point light with a measured distribution of intensity (ANSI/IES LM-63): bilinear between the file's angles.
#pragma once

#include <memory>
#include <vector>

#include "renderer/core/discrete_distribution.h"
#include "renderer/lights/light_bounds.h"
#include "renderer/lights/light_sample.h"
#include "scenes/meshes/ies.h"

namespace photonproof::inline renderer_lights {

class IesLight {
 public:
  static constexpr bool is_delta = true, is_infinite = false;

  /// The unit vectors `c0`, `c90` and `zenith` form a right-handed frame. Vertical angles are measured from -zenith,
  /// horizontal ones from c0 towards c90. Outside the file's vertical angles the light is 0.
  IesLight(const Vec3f& position, const Vec3f& c0, const Vec3f& c90, const Vec3f& zenith, const Rgb& intensity,
           const IesProfile& profile);

  LightSample<float> sample(const Vec3f& p, const Vec2<float>& u) const;
  float pdf(const Vec3f&, const LightPoint<float>&) const { return 0; }
  Emission<float> emit(const Vec2<float>& u_position, const Vec2<float>& u_direction) const;
  EmissionPdfs<float> emit_pdfs(const LightPoint<float>& at, const Vec3f& direction) const;
  Rgb flux_towards(const LightPoint<float>& at, const Vec3f& direction) const { return leaving(at, direction); }
  Rgb leaving(const LightPoint<float>& at, const Vec3f& direction) const;
  Rgb flux() const { return flux_; }
  LightBounds bounds() const { return round_bounds(position_, position_); }

 private:
  /// Candela at the angles, in degrees; 0 outside the file's vertical ones.
  double candela(double vertical, double horizontal) const;
  double candela_towards(const Vec3f& direction) const;
  std::size_t cell_of(std::size_t row, std::size_t column) const { return row * columns() + column; }
  std::size_t columns() const { return horizontal_.size() - 1; }
  double solid_angle(std::size_t cell) const;

  Vec3f position_, c0_, c90_, zenith_;
  Rgb intensity_;
  std::vector<double> vertical_, horizontal_;  ///< in degrees; horizontal from 0 to 360
  std::vector<double> candela_;                ///< indexed horizontal x vertical
  DiscreteDistribution cells_;                 ///< cells between neighbouring angles, by flux
  Rgb flux_{0.0f};
};

}  // namespace photonproof::inline renderer_lights
