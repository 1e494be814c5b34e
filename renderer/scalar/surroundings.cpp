#include "renderer/scalar/surroundings.h"

#include <algorithm>
#include <limits>
#include <variant>

#include "renderer/media/varying_medium.h"

namespace photonproof::inline renderer_scalar {

const Surroundings::Interior* Surroundings::top() const {
  const Interior* highest = nullptr;
  for (std::size_t i = 0; i < count_; ++i)
    if (highest == nullptr || interiors_[i].priority > highest->priority) highest = &interiors_[i];
  return highest;
}

void Surroundings::enter(std::uint32_t bsdf, std::uint32_t medium, int priority) {
  for (std::size_t i = 0; i < count_; ++i)
    if (interiors_[i].bsdf == bsdf) {
      ++interiors_[i].entered;
      return;
    }
  if (count_ < max_interiors) interiors_[count_++] = {bsdf, medium, priority, 1};
}

void Surroundings::exit(std::uint32_t bsdf) {
  for (std::size_t i = 0; i < count_; ++i) {
    if (interiors_[i].bsdf != bsdf) continue;
    if (--interiors_[i].entered > 0) return;
    std::copy(interiors_.begin() + static_cast<std::ptrdiff_t>(i) + 1,
              interiors_.begin() + static_cast<std::ptrdiff_t>(count_),
              interiors_.begin() + static_cast<std::ptrdiff_t>(i));
    --count_;
    return;
  }
}

Crossing Surroundings::crossing(const SceneInterface& scene, const Interaction& at, const Vec3f& direction) const {
  const SceneMedia& media = scene.scene().media;
  if (!media.any_priority || !media.interiors[at.leaf].priority) return {};
  Surroundings after = *this;
  after.cross(scene, at, direction);
  const Interior* before = top();
  const Interior* behind = after.top();
  const std::uint32_t now = before != nullptr ? before->bsdf : no_index;
  const std::uint32_t then = behind != nullptr ? behind->bsdf : no_index;
  if (now == then) return {false, std::nullopt};
  const auto ior = [&](std::uint32_t bsdf) {
    return bsdf == no_index ? media.interiors[at.leaf].ext_ior : media.interiors[bsdf].int_ior;
  };
  const bool entering = dot(at.ng, direction) < 0;
  return {true, entering ? ior(then) / ior(now) : ior(now) / ior(then)};
}

void Surroundings::cross(const SceneInterface& scene, const Interaction& at, const Vec3f& direction) {
  const SceneMedia& media = scene.scene().media;
  const Surface& surface = scene.scene().surfaces[at.surface];
  const bool entering = dot(at.ng, direction) < 0;
  if (media.any_priority && media.interiors[at.leaf].priority) {
    if (entering)
      enter(at.leaf, surface.interior, *media.interiors[at.leaf].priority);
    else
      exit(at.leaf);
    medium_ = top() != nullptr ? top()->medium : surface.exterior;
  } else if (surface.interior != no_index || surface.exterior != no_index) {
    medium_ = entering ? surface.interior : surface.exterior;
  }
}

void Surroundings::leave(const SceneInterface& scene, const Interaction& at, const Vec3f& wo, const Vec3f& wi) {
  if (dot(at.ng, wo) * dot(at.ng, wi) < 0) cross(scene, at, wi);
}

void Surroundings::refract_as(const Crossing& crossing, Interaction& at) {
  if (!crossing.eta) return;
  if (auto* glass = std::get_if<DielectricBsdf<float>>(&at.bsdf)) glass->eta = *crossing.eta;
}

namespace {

/// No axis or diagonal of a scene.
const Vec3f odd_direction = normalize(Vec3f(0.3712f, 0.4871f, 0.7906f));

void follow(const SceneInterface& scene, Ray ray, float length_left, Surroundings& surroundings) {
  Interaction at;
  while (scene.intersect(ray, 0, TransportMode::radiance, at)) {
    length_left -= ray.way_to(at.p);
    if (length_left <= 0) return;
    surroundings.cross(scene, at, ray.direction);
    ray = scene.pass(ray, at, ray.direction);
  }
}

/// Whether a hit on the way to an end is that end: its surface, close to it, or the front of a round one, which is met
/// once.
bool is_end(const SceneInterface& scene, const Interaction& met, const SegmentEnd& end, const Vec3f& direction,
            bool is_close) {
  if (met.surface != end.surface) return false;
  const Geometry& geometry = scene.scene().surfaces[met.surface].geometry;
  const bool is_round = std::visit([](const auto& shape) { return shape.is_round; }, geometry);
  return is_close || (is_round && dot(met.ng, direction) < 0 && dot(end.normal, direction) < 0);
}

}  // namespace

std::uint32_t outer_medium(const SceneInterface& scene) {
  Surroundings surroundings(scene.scene().media.around_camera);
  if (scene.has_media_or_interiors())
    follow(scene, {scene.view().camera.origin, odd_direction}, std::numeric_limits<float>::infinity(), surroundings);
  return surroundings.medium();
}

Rgb arriving_from_infinity(const SceneInterface& scene, bool from_infinity, std::uint32_t outer) {
  if (!from_infinity || outer == no_index) return Rgb(1.0f);
  return scene.scene().media.media[outer].transmittance(std::numeric_limits<float>::infinity());
}

Surroundings surroundings_at(const SceneInterface& scene, const Vec3f& p, std::uint32_t outer) {
  Surroundings surroundings(outer);
  if (scene.has_media_or_interiors())
    follow(scene, {p - odd_direction * scene.far_away(), odd_direction}, scene.far_away(), surroundings);
  return surroundings;
}

Rgb transmittance(const SceneInterface& scene, const SegmentEnd& from, const SegmentEnd& to, Surroundings surroundings,
                  const Passing& through, const PathSampler& draws, std::uint32_t dimension) {
  if (!scene.has_media_or_interiors() && !through.lights && !(through.null && scene.has_null_surfaces()))
    return Rgb(scene.visible(from, to) ? 1.0f : 0.0f);
  const std::vector<Medium>& media = scene.scene().media.media;
  Rgb left(1.0f);
  Ray ray = scene.leave(from, normalize(to.p - from.p));
  const auto attenuate = [&](float distance) {
    if (surroundings.medium() == no_index) return;
    const Medium& medium = media[surroundings.medium()];
    left *= medium.varying
                ? medium.varying->transmittance(ray.start(), ray.direction, distance, draws_of_flight(draws, dimension))
                : medium.transmittance(distance);
  };
  constexpr float at_the_end = 1e-3f;  // part of the segment within which its own end is met
  const float whole = length(to.p - from.p);
  for (;; ++dimension) {
    const float distance = ray.way_to(to.p);
    Interaction at;
    const bool met = scene.intersect(ray, draws.one(dimension), TransportMode::radiance, at);
    const float step = met ? ray.way_to(at.p) : distance;
    if (!met || step >= distance * segment_end ||
        is_end(scene, at, to, ray.direction, distance - step < at_the_end * whole)) {
      attenuate(to.at_infinity ? std::numeric_limits<float>::infinity() : distance);
      return left;
    }
    attenuate(step);
    const bool passes = through.lights && at.light != no_index;
    if (!passes && surroundings.crossing(scene, at, ray.direction).is_boundary) {
      const std::optional<Rgb> part = through.null ? straight_through(at, -ray.direction) : std::nullopt;
      if (!part) return Rgb(0.0f);
      left *= *part;
    }
    if (!(max_component(left) > 0)) return Rgb(0.0f);
    surroundings.cross(scene, at, ray.direction);
    ray = scene.pass(ray, at, ray.direction);
  }
}

bool travel(const SceneInterface& scene, Ray& ray, Surroundings& surroundings, float u_layer, TransportMode mode,
            Rgb& throughput, Interaction& at) {
  if (!scene.has_media_or_interiors()) return scene.intersect(ray, u_layer, mode, at);
  while (scene.intersect(ray, u_layer, mode, at)) {
    if (surroundings.medium() != no_index)
      throughput *= scene.scene().media.media[surroundings.medium()].transmittance(ray.way_to(at.p));
    const Crossing crossing = surroundings.crossing(scene, at, ray.direction);
    if (crossing.is_boundary) {
      Surroundings::refract_as(crossing, at);
      return true;
    }
    surroundings.cross(scene, at, ray.direction);
    ray = scene.pass(ray, at, ray.direction);
  }
  if (surroundings.medium() != no_index)
    throughput *=
        scene.scene().media.media[surroundings.medium()].transmittance(std::numeric_limits<float>::infinity());
  return false;
}

}  // namespace photonproof::inline renderer_scalar
