#include "renderer/light_sampling/emission_guiding.h"

#include <algorithm>
#include <cmath>

#include "renderer/lights/light_bounds.h"

namespace photonproof::inline renderer_light_sampling {
namespace {

/// Ratio of half-extent to distance above which a light is huge. Below it, closer starts gain less than the loss from
/// using them only every other time.
constexpr float huge = 8;
/// Distance in radii of a ball from which a light is far away: of unguided paths one in a million hits the ball.
constexpr float far_away = 256;
/// Smallest radius of a target, as a share of the scene. Single precision could not hit smaller targets from outside
/// the scene.
constexpr float smallest_place = 0x1p-14f;

/// Vector from the box around a light to p.
Vec3f apart_from(const LightBounds& box, const Vec3f& p) {
  const auto beside = [](float low, float high, float x) { return std::max({low - x, x - high, 0.0f}); };
  return {beside(box.low.x, box.high.x, p.x), beside(box.low.y, box.high.y, p.y), beside(box.low.z, box.high.z, p.z)};
}

/// Point from which a ball's starts are sampled, at least its radius from the light. Empty if that is not near,
/// compared to the light's size.
struct Viewpoint {
  const ProjectionTarget& ball;

  std::optional<Vec3f> operator()(const QuadLight<float>& l) const {
    const auto from =
        before_plane(l.height(ball.center), l.normal, length(l.edge_u + l.edge_v), length(l.edge_u - l.edge_v));
    return from && l.is_close_to(*from) ? from : std::nullopt;
  }
  std::optional<Vec3f> operator()(const DiskLight<float>& l) const {
    const auto from =
        before_plane(l.height(ball.center), l.normal, 2 * length(l.half_axis_u), 2 * length(l.half_axis_v));
    return from && l.is_close_to(*from) ? from : std::nullopt;
  }
  std::optional<Vec3f> operator()(const SphereLight<float>& l) const {
    return around(Vec3d(ball.center) - Vec3d(l.center), l.height(ball.center), l.side, l.radius);
  }
  std::optional<Vec3f> operator()(const AreaLight& l) const {
    return std::visit([&](const auto& shape) { return of_shape(shape); }, l.shape());
  }
  std::optional<Vec3f> operator()(const SmoothMeshLight&) const { return std::nullopt; }
  template <class L>
  requires(L::is_delta || L::is_infinite) std::optional<Vec3f>
  operator()(const L&) const { return std::nullopt; }

 private:
  std::optional<Vec3f> before_plane(float height, const Vec3f& normal, float diagonal, float other) const {
    if (height <= -ball.radius) return std::nullopt;
    const float away = std::max(height, ball.radius);
    if (std::max(diagonal, other) < 2 * huge * away) return std::nullopt;
    return ball.center + normal * (away - height);
  }
  /// Point in front of or within a round shape; `out` leads from its centre or axis, `height` is above its front.
  std::optional<Vec3f> around(const Vec3d& out, float height, float side, float extent) const {
    const auto distance = static_cast<float>(length(out));
    const float away = std::max(height, ball.radius);
    if (height <= -ball.radius || extent < huge * away) return std::nullopt;
    const Vec3f axis = distance > 0 ? Vec3f(normalize(out)) : Vec3f(0.0f);
    return ball.center + axis * std::max(side * (away - height), -distance);
  }
  std::optional<Vec3f> of_shape(const QuadShape& s) const {
    return (*this)(QuadLight<float>{s.corner, s.edge_u, s.edge_v, s.normal, s.area(), Rgb(0.0f), s.offset});
  }
  std::optional<Vec3f> of_shape(const DiskShape& s) const {
    return (*this)(DiskLight<float>{s.center, s.half_axis_u, s.half_axis_v, s.normal, s.area(), Rgb(0.0f), s.offset});
  }
  std::optional<Vec3f> of_shape(const SphereShape& s) const {
    return (*this)(SphereLight<float>{s.center, s.radius, s.sign, Rgb(0.0f), s.offset});
  }
  std::optional<Vec3f> of_shape(const CylinderShape& s) const {
    const double whole = length(s.axis);
    const Vec3d along = s.axis / whole, from_base = Vec3d(ball.center) - s.base;
    const double z = dot(from_base, along);
    if (z < -ball.radius || z > whole + ball.radius) return std::nullopt;
    const Vec3d out = from_base - along * z;
    return around(out, static_cast<float>(double{s.sign} * (length(out) - s.radius)), s.sign,
                  static_cast<float>(std::hypot(whole / 2, s.radius)));
  }
  /// Point for other shapes, by their box: a mesh's triangles are chosen from the ball's position.
  std::optional<Vec3f> of_shape(const auto& s) const {
    const LightBounds box = s.bounds();
    if (length(box.high - box.low) < 2 * huge * std::max(length(apart_from(box, ball.center)), ball.radius))
      return std::nullopt;
    return ball.center;
  }
};

bool is_far(const Light& light, const ProjectionTarget& ball) {
  const std::optional<LightBounds> bounds = light_bounds(light);
  return bounds && length(apart_from(*bounds, ball.center)) > far_away * ball.radius;
}

/// Whether u >= 1/2; rescales u to be uniform again.
bool takes_second_half(float& u) {
  const bool second = u >= 0.5f;
  u = second ? 2 * u - 1 : 2 * u;
  return second;
}

GuidedStart guided(const Emission<float>& even) { return {even.at, even.direction, even.at.p}; }

}  // namespace

EmissionGuiding::EmissionGuiding(const std::vector<Light>& lights, const std::vector<ProjectionTarget>& seen,
                                 const SceneBall& scene, const ClearWays* ways)
    : scene_(scene), ways_(ways), views_(lights.size()) {
  for (std::size_t i = 0; i < lights.size(); ++i) {
    if (std::holds_alternative<BeamLight>(lights[i])) continue;  // its photons have one direction from one surface
    for (const ProjectionTarget& ball : seen) {
      if (is_infinite(lights[i])) {
        ProjectionTarget place = ball;
        place.radius = std::max(ball.radius, smallest_place * scene.radius);
        if (huge * place.radius < scene.radius) views_[i].push_back({place.center, place});
      } else if (const auto from = std::visit(Viewpoint{ball}, lights[i])) {
        views_[i].push_back({*from, ball});
      } else if (is_far(lights[i], ball)) {
        views_[i].push_back({ball.center, ball, true});
      }
    }
    if (!views_[i].empty()) ++guided_;
  }
}

/// Samples the direction as without a guide.
GuidedStart EmissionGuiding::start_far(const Light& light, const ProjectionTarget& ball, const Vec2<float>& u_position,
                                       const Vec2<float>& u_direction) const {
  GuidedStart start = guided(emit(light, {0.5f, 0.5f}, u_direction));
  const Vec2<float> d = square_to_disc(u_position);
  start.on_line = ball.center + Frame<float>(start.direction).to_world({d.x, d.y, 0}) * ball.radius;
  start.at.p = start.on_line - start.direction * (scene_.radius + length(ball.center - scene_.center));
  return start;
}

std::optional<GuidedStart> EmissionGuiding::start(const Light& light, std::uint32_t index,
                                                  const Vec2<float>& u_position, const Vec2<float>& u_direction) const {
  Vec2<float> u = u_position, u_way = u_direction;
  if (!takes_second_half(u.x)) return guided(emit(light, u, u_direction));
  const std::vector<Aov>& views = views_[index];
  const float scaled = u.x * static_cast<float>(views.size());
  const std::size_t which = std::min(static_cast<std::size_t>(scaled), views.size() - 1);
  u.x = std::min(scaled - static_cast<float>(which), 1 - 0x1p-24f);
  if (is_infinite(light)) return start_far(light, views[which].ball, u, u_direction);

  const Aov& view = views[which];
  GuidedStart start;
  if (view.is_far) {
    start = guided(emit(light, u, {0.5f, 0.5f}));
    aim(index, view.ball, u_way, start);
    return start;
  }
  const LightSample<float> s = sample(light, view.from, u);
  if (!(s.pdf > 0)) return std::nullopt;
  start.at = with_uv(light, s.at);
  start.on_line = s.at.p;
  if (takes_second_half(u_way.x))
    aim(index, view.ball, u_way, start);
  else
    start.direction = Frame<float>(start.at.normal).to_world(square_to_cosine_hemisphere(u_way));
  return start;
}

void EmissionGuiding::aim(std::uint32_t light, const ProjectionTarget& ball, const Vec2<float>& u,
                          GuidedStart& start) const {
  const AimedLine<float> line = aimed_line<float>(ball.center, ball.radius, start.at.p, u);
  start.direction = line.direction;
  start.on_line = line.point;
  if (ways_ == nullptr || light >= ways_->others.size()) return;
  const PointAhead<float> ahead = point_ahead<float>(*ways_, light, line, start.at.p);
  if (ahead.valid) start.ahead = ahead.p;
}

EmissionPdfs<float> EmissionGuiding::pdfs(const Light& light, std::uint32_t index, const LightPoint<float>& at,
                                          const AimedLine<float>& line, const EmissionPdfs<float>& even) const {
  const std::vector<Aov>& views = views_[index];
  const double share = 0.5 / static_cast<double>(views.size());
  if (is_infinite(light)) {
    double here = 0;
    for (const Aov& view : views) {
      const double r2 = double{view.ball.radius} * double{view.ball.radius};
      if (meets<float>(line, view.ball.center, view.ball.radius)) here += 1 / (std::numbers::pi * r2);
    }
    return {even.first, static_cast<float>(0.5 * double{even.second} + share * here)};
  }
  double position = 0, both = 0;
  for (const Aov& view : views) {
    const double aimed{projection_pdf<float>(view.ball.center, view.ball.radius, at.p, line)};
    if (view.is_far) {
      position += double{even.first};
      both += double{even.first} * aimed;
      continue;
    }
    const Vec3f d = view.from - at.p;
    const float distance2 = length_squared(d), cosine = dot(at.normal, d) / std::sqrt(distance2);
    if (!(cosine > 0)) continue;
    const double here = double{pdf(light, view.from, at)} * double{cosine} / double{distance2};
    position += here;
    both += here * 0.5 * (double{even.second} + aimed);
  }
  const double all = 0.5 * double{even.first} + share * position;
  const double joint = 0.5 * double{even.first} * double{even.second} + share * both;
  return {static_cast<float>(all), static_cast<float>(joint / all)};
}

}  // namespace photonproof::inline renderer_light_sampling
