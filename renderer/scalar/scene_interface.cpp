#include "renderer/scalar/scene_interface.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "renderer/light_sampling/scene_lights.h"
#include "renderer/rays/rays.h"
#include "renderer/scene/surface_detail.h"
#include "renderer/shapes/shape.h"

namespace photonproof::inline renderer_scalar {
namespace {

/// BSDFs with a lobe that leaves the direction as it is.
template <class B>
constexpr bool goes_straight = requires(const B& b, const Vec3f& wo) {
  b.straight_through(wo);
};

Vec3f moved_off(const SegmentEnd& end, const Vec3f& direction, float coordinate_floor) {
  return end.normal == Vec3f(0.0f) ? end.p : offset_from(end.p, end.normal, direction, coordinate_floor);
}

}  // namespace

SceneInterface::SceneInterface(const Scene& scene)
    : scene_(scene),
      far_away_(4 * std::max(scene.scene_lights().ball().radius,
                             length(scene.view().camera.origin - scene.scene_lights().ball().center))),
      has_media_or_interiors_(!scene.media.media.empty() || scene.media.any_priority),
      has_null_surfaces_(std::any_of(scene.bsdfs.records.begin(), scene.bsdfs.records.end(), [](const Bsdf& bsdf) {
        return std::visit([](const auto& b) { return goes_straight<std::decay_t<decltype(b)>>; }, bsdf);
      })) {}

bool SceneInterface::intersect(const Ray& ray, float u_choice, TransportMode mode, Interaction& hit) const {
  const SurfaceHit<float> found = closest_hit<float>(view(), ray.origin, ray.direction, ray.from, true, false);
  if (!found.valid) return false;
  const Surface& surface = scene_.surfaces[found.surface];
  hit.p = found.p;
  hit.ng = found.normal;
  hit.surface = found.surface;
  hit.primitive = found.primitive;
  hit.light = surface.light;
  if (!view().detailed) {
    hit.scattering.frame = Frame<float>(found.normal);
    hit.leaf = surface.bsdf;
    hit.bsdf = scene_.bsdfs.records[surface.bsdf];
    return true;
  }
  hit.u_choice = u_choice;
  look_closer(ray.direction, mode, hit);
  return true;
}

void SceneInterface::look_closer(const Vec3f& direction, TransportMode mode, Interaction& hit) const {
  SurfaceDetail detail;
  detail_at(view(), hit.surface, hit.primitive, hit.p, hit.ng, direction, hit.u_choice, mode, detail);
  hit.scattering = scattering_at(view(), detail, hit.ng);
  hit.leaf = detail.bsdf;
  BsdfKinds::for_each([&]<template <class> class Kind>(std::uint32_t kind) {
    if (kind != detail.kind) return;
    Kind<float> bsdf;
    std::memcpy(&bsdf, detail.record, sizeof bsdf);
    hit.bsdf = bsdf;
  });
}

const Interaction& SceneInterface::seen_from(const Interaction& at, const Vec3f& to_camera, Interaction& other) const {
  if (!view().maps_normals || at.scattering.maps.seen_from(at.scattering.frame.to_local(to_camera))) return at;
  other = at;
  look_closer(-to_camera, TransportMode::radiance, other);
  return other;
}

bool SceneInterface::visible(const SegmentEnd& from, const SegmentEnd& to) const {
  const SceneView& scene = view();
  const Vec3f along = to.p - from.p;
  const Vec3f origin = moved_off(from, along, scene.coordinate_floor);
  const bool is_named = scene.small && to.primitive != no_index;
  const Vec3f end = is_named ? to.p : moved_off(to, -along, scene.coordinate_floor);
  return !occluded<float>(scene, origin, end - origin, from.primitive, to.primitive, true);
}

Ray SceneInterface::leave(const SegmentEnd& at, const Vec3f& direction) const {
  const Vec3f origin = moved_off(at, direction, view().coordinate_floor);
  return {origin, direction, at.primitive, dot(origin - at.p, direction)};
}

Ray SceneInterface::pass(const Ray& ray, const Interaction& at, const Vec3f& direction) const {
  Ray next = leave(at, direction);
  if (dot(next.origin - ray.origin, direction) > 0) return next;
  next.origin = ray.origin + direction * static_cast<float>(0x1p-20 * largest_coordinate(Vec3d(ray.origin)));
  next.gap = dot(next.origin - at.p, direction);
  return next;
}

Rgb evaluate(const Interaction& at, const Vec3f& to_camera, const Vec3f& to_light, TransportMode mode) {
  const Vec3f wo = at.scattering.frame.to_local(to_camera), wi = at.scattering.frame.to_local(to_light);
  return std::visit([&](const auto& b) { return at.scattering.eval(b, wo, wi); }, at.bsdf) *
         at.scattering.cosine(wo, wi, mode);
}

float scatter_pdf(const Interaction& at, const Vec3f& wo, const Vec3f& wi, TransportMode mode) {
  const Vec3f wo_local = at.scattering.frame.to_local(wo), wi_local = at.scattering.frame.to_local(wi);
  return std::visit([&](const auto& b) { return at.scattering.pdf(b, wo_local, wi_local, mode); }, at.bsdf);
}

Scattered scatter(const Interaction& at, const Vec3f& wo, float u_lobe, const Vec2<float>& u_direction,
                  TransportMode mode) {
  const Frame<float>& frame = at.scattering.frame;
  const Vec3f wo_local = frame.to_local(wo);
  return std::visit(
      [&](const auto& b) -> Scattered {
        const BsdfSample<float> s = at.scattering.sample(b, wo_local, u_lobe, u_direction, mode);
        if (!s.valid || !(max_component(s.weight) > 0) || !(s.pdf > 0)) return {};
        const bool straight =
            goes_straight<std::decay_t<decltype(b)>> && s.delta && dot(s.wi_local, wo_local) < -0.9999f;
        return {normalize(frame.to_world(s.wi_local)), s.weight, s.pdf, s.eta, s.delta, straight, true};
      },
      at.bsdf);
}

std::optional<Rgb> straight_through(const Interaction& at, const Vec3f& wo) {
  const Vec3f wo_local = at.scattering.frame.to_local(wo);
  return std::visit(
      [&](const auto& b) -> std::optional<Rgb> {
        if constexpr (goes_straight<std::decay_t<decltype(b)>>)
          return b.straight_through(wo_local);
        else
          return std::nullopt;
      },
      at.bsdf);
}

}  // namespace photonproof::inline renderer_scalar
