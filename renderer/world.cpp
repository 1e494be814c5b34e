#include "renderer/world.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "renderer/kernels/rays.h"

namespace photonproof {
namespace {

/// BSDFs with a lobe that leaves the direction as it is.
template <class B>
constexpr bool goes_straight = requires(const B& b, const Vec3f& wo) {
  b.straight_through(wo);
};

/// Half the diagonal of the box around all surfaces and the camera.
float reach(const Scene& scene) {
  Vec3f low(std::numeric_limits<float>::infinity()), high = -low;
  const auto hold = [&](const Vec3f& p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  };
  hold(scene.view().camera.origin);
  for (const Surface& surface : scene.surfaces) {
    if (const auto* quad = std::get_if<Quad>(&surface.geometry)) {
      for (const Vec3f& edge : {Vec3f(0.0f), quad->edge_u, quad->edge_v, quad->edge_u + quad->edge_v})
        hold(quad->corner + edge);
    } else if (const auto* sphere = std::get_if<Sphere>(&surface.geometry)) {
      hold(sphere->center - Vec3f(sphere->radius));
      hold(sphere->center + Vec3f(sphere->radius));
    } else {
      const auto& mesh = std::get<Mesh>(surface.geometry);
      for (std::size_t i = 0; i + 1 < mesh.positions.size(); ++i) hold(mesh.positions[i]);  // the last is a spare
    }
  }
  return length(high - low) / 2;
}

Vec3f moved_off(const SegmentEnd& end, const Vec3f& direction, float coordinate_floor) {
  return end.normal == Vec3f(0.0f) ? end.p : offset_from(end.p, end.normal, direction, coordinate_floor);
}

/// Whether a segment that arrives along `direction` comes to a convex body from its inside, having crossed it before.
bool arrives_from_inside(const Scene& scene, const SegmentEnd& end, const Vec3f& direction) {
  if (end.surface == no_index) return false;
  const auto* sphere = std::get_if<Sphere>(&scene.surfaces[end.surface].geometry);
  return sphere != nullptr && dot(end.p - sphere->center, direction) > 0;
}

}  // namespace

World::World(const Scene& scene)
    : scene_(scene),
      far_away_(4 * reach(scene)),
      has_media_or_bodies_(!scene.media.media.empty() || scene.media.any_priority),
      has_null_surfaces_(std::any_of(scene.bsdfs.begin(), scene.bsdfs.end(), [](const Bsdf& bsdf) {
        return std::visit([](const auto& b) { return goes_straight<std::decay_t<decltype(b)>>; }, bsdf);
      })) {}

bool World::intersect(const Ray& ray, float, Interaction& hit) const {
  const SurfaceHit<float> found = closest_hit<float>(view(), ray.origin, ray.direction, ray.from, true, false);
  if (!found.valid) return false;
  const Surface& surface = scene_.surfaces[found.surface];
  hit.p = found.p;
  hit.ng = found.normal;
  hit.frame = Frame<float>(found.normal);
  hit.surface = found.surface;
  hit.primitive = found.primitive;
  hit.light = surface.light;
  hit.leaf = surface.bsdf;
  hit.bsdf = scene_.bsdfs[surface.bsdf];
  return true;
}

bool World::visible(const SegmentEnd& from, const SegmentEnd& to) const {
  const SceneView& scene = view();
  const Vec3f along = to.p - from.p;
  const Vec3f origin = moved_off(from, along, scene.coordinate_floor);
  if (!scene.small)
    return !occluded<float>(scene, origin, moved_off(to, -along, scene.coordinate_floor) - origin, no_index, no_index,
                            true);
  // What a segment ends on is no obstacle, unless it is a body that the segment crosses before.
  if (to.primitive == no_index || (to.primitive != from.primitive && arrives_from_inside(scene_, to, along)))
    return !occluded<float>(scene, origin, moved_off(to, -along, scene.coordinate_floor) - origin, from.primitive,
                            no_index, true);
  return !occluded<float>(scene, origin, to.p - origin, from.primitive, to.primitive, true);
}

Ray World::leave(const SegmentEnd& at, const Vec3f& direction) const {
  return {moved_off(at, direction, view().coordinate_floor), direction, at.primitive};
}

bool has_smooth_part(const Bsdf& bsdf) { return !is_delta(bsdf); }

Rgb evaluate(const Interaction& at, const Vec3f& to_camera, const Vec3f& to_light) {
  const Vec3f wo = at.frame.to_local(to_camera), wi = at.frame.to_local(to_light);
  return std::visit([&](const auto& b) { return b.eval(wo, wi); }, at.bsdf);
}

float scatter_pdf(const Interaction& at, const Vec3f& wo, const Vec3f& wi) {
  const Vec3f wo_local = at.frame.to_local(wo), wi_local = at.frame.to_local(wi);
  return std::visit([&](const auto& b) { return b.pdf(wo_local, wi_local); }, at.bsdf);
}

Scattering scatter(const Interaction& at, const Vec3f& wo, float u_lobe, const Vec2<float>& u_direction,
                   TransportMode mode) {
  const Vec3f wo_local = at.frame.to_local(wo);
  return std::visit(
      [&](const auto& b) -> Scattering {
        const BsdfSample<float> s = b.sample(wo_local, u_lobe, u_direction, mode);
        if (!s.valid || !(max_component(s.weight) > 0) || !(s.pdf > 0)) return {};
        return {normalize(at.frame.to_world(s.wi_local)),
                s.weight,
                s.pdf,
                s.eta,
                b.is_delta,
                goes_straight<std::decay_t<decltype(b)>> && b.is_delta && dot(s.wi_local, wo_local) < -0.9999f,
                true};
      },
      at.bsdf);
}

std::optional<Rgb> straight_through(const Interaction& at, const Vec3f& wo) {
  const Vec3f wo_local = at.frame.to_local(wo);
  return std::visit(
      [&](const auto& b) -> std::optional<Rgb> {
        if constexpr (goes_straight<std::decay_t<decltype(b)>>)
          return b.straight_through(wo_local);
        else
          return std::nullopt;
      },
      at.bsdf);
}

float adjoint_correction(const Interaction& at, const Vec3f& to_light, const Vec3f& to_camera) {
  const float above = cosine(at.frame.n, to_light) * cosine(at.ng, to_camera);
  const float below = cosine(at.ng, to_light) * cosine(at.frame.n, to_camera);
  return below > 0 ? above / below : 0;
}

}  // namespace photonproof
