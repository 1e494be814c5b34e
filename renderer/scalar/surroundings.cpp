#include "renderer/scalar/surroundings.h"

#include <algorithm>
#include <limits>
#include <variant>

namespace photonproof::inline renderer_scalar {

const Surroundings::Body* Surroundings::top() const {
  const Body* highest = nullptr;
  for (std::size_t i = 0; i < count_; ++i)
    if (highest == nullptr || bodies_[i].priority > highest->priority) highest = &bodies_[i];
  return highest;
}

void Surroundings::enter(std::uint32_t bsdf, std::uint32_t medium, int priority) {
  for (std::size_t i = 0; i < count_; ++i)
    if (bodies_[i].bsdf == bsdf) {
      ++bodies_[i].entered;
      return;
    }
  if (count_ < most_bodies) bodies_[count_++] = {bsdf, medium, priority, 1};
}

void Surroundings::exit(std::uint32_t bsdf) {
  for (std::size_t i = 0; i < count_; ++i) {
    if (bodies_[i].bsdf != bsdf) continue;
    if (--bodies_[i].entered > 0) return;
    std::copy(bodies_.begin() + static_cast<std::ptrdiff_t>(i) + 1,
              bodies_.begin() + static_cast<std::ptrdiff_t>(count_), bodies_.begin() + static_cast<std::ptrdiff_t>(i));
    --count_;
    return;
  }
}

Crossing Surroundings::crossing(const SceneInterface& world, const Interaction& at, const Vec3f& direction) const {
  const SceneMedia& media = world.scene().media;
  if (!media.any_priority || !media.bodies[at.leaf].priority) return {};
  Surroundings after = *this;
  after.cross(world, at, direction);
  const Body* before = top();
  const Body* behind = after.top();
  const std::uint32_t now = before != nullptr ? before->bsdf : no_index;
  const std::uint32_t then = behind != nullptr ? behind->bsdf : no_index;
  if (now == then) return {false, std::nullopt};
  const auto ior = [&](std::uint32_t bsdf) {
    return bsdf == no_index ? media.bodies[at.leaf].ext_ior : media.bodies[bsdf].int_ior;
  };
  const bool entering = dot(at.ng, direction) < 0;
  return {true, entering ? ior(then) / ior(now) : ior(now) / ior(then)};
}

void Surroundings::cross(const SceneInterface& world, const Interaction& at, const Vec3f& direction) {
  const SceneMedia& media = world.scene().media;
  const Surface& surface = world.scene().surfaces[at.surface];
  const bool entering = dot(at.ng, direction) < 0;
  if (media.any_priority && media.bodies[at.leaf].priority) {
    if (entering)
      enter(at.leaf, surface.interior, *media.bodies[at.leaf].priority);
    else
      exit(at.leaf);
    medium_ = top() != nullptr ? top()->medium : surface.exterior;
  } else if (surface.interior != no_index || surface.exterior != no_index) {
    medium_ = entering ? surface.interior : surface.exterior;
  }
}

void Surroundings::leave(const SceneInterface& world, const Interaction& at, const Vec3f& wo, const Vec3f& wi) {
  if (dot(at.ng, wo) * dot(at.ng, wi) < 0) cross(world, at, wi);
}

void Surroundings::refract_as(const Crossing& crossing, Interaction& at) {
  if (!crossing.eta) return;
  if (auto* glass = std::get_if<DielectricBsdf<float>>(&at.bsdf)) glass->eta = *crossing.eta;
}

namespace {

/// No axis or diagonal of a scene.
const Vec3f odd_direction = normalize(Vec3f(0.3712f, 0.4871f, 0.7906f));

void follow(const SceneInterface& world, Ray ray, float length_left, Surroundings& surroundings) {
  Interaction at;
  while (world.intersect(ray, 0, TransportMode::radiance, at)) {
    length_left -= ray.way_to(at.p);
    if (length_left <= 0) return;
    surroundings.cross(world, at, ray.direction);
    ray = world.pass(ray, at, ray.direction);
  }
}

/// Whether what was met on the way to an end is that end: its surface, close to it, or the front of a round one, which
/// is met once.
bool is_end(const SceneInterface& world, const Interaction& met, const SegmentEnd& end, const Vec3f& direction,
            bool is_close) {
  if (met.surface != end.surface) return false;
  const Geometry& geometry = world.scene().surfaces[met.surface].geometry;
  const bool is_round = std::visit([](const auto& shape) { return shape.is_round; }, geometry);
  return is_close || (is_round && dot(met.ng, direction) < 0 && dot(end.normal, direction) < 0);
}

}  // namespace

std::uint32_t outer_medium(const SceneInterface& world) {
  Surroundings surroundings(world.scene().media.around_camera);
  if (world.has_media_or_bodies())
    follow(world, {world.view().camera.origin, odd_direction}, std::numeric_limits<float>::infinity(), surroundings);
  return surroundings.medium();
}

Rgb arriving_from_infinity(const SceneInterface& world, bool from_infinity, std::uint32_t outer) {
  if (!from_infinity || outer == no_index) return Rgb(1.0f);
  return world.scene().media.media[outer].transmittance(std::numeric_limits<float>::infinity());
}

Surroundings surroundings_at(const SceneInterface& world, const Vec3f& p, std::uint32_t outer) {
  Surroundings surroundings(outer);
  if (world.has_media_or_bodies())
    follow(world, {p - odd_direction * world.far_away(), odd_direction}, world.far_away(), surroundings);
  return surroundings;
}

Rgb transmittance(const SceneInterface& world, const SegmentEnd& from, const SegmentEnd& to, Surroundings surroundings,
                  const Passing& through, const PathSampler& draws, std::uint32_t dimension) {
  if (!world.has_media_or_bodies() && !through.lights && !(through.null && world.has_null_surfaces()))
    return Rgb(world.visible(from, to) ? 1.0f : 0.0f);
  const std::vector<Medium>& media = world.scene().media.media;
  Rgb left(1.0f);
  const auto attenuate = [&](float distance) {
    if (surroundings.medium() != no_index) left *= media[surroundings.medium()].transmittance(distance);
  };
  Ray ray = world.leave(from, normalize(to.p - from.p));
  constexpr float at_the_end = 1e-3f;  // part of the segment within which its own end is met
  const float whole = length(to.p - from.p);
  for (;; ++dimension) {
    const float distance = ray.way_to(to.p);
    Interaction at;
    const bool met = world.intersect(ray, draws.one(dimension), TransportMode::radiance, at);
    const float step = met ? ray.way_to(at.p) : distance;
    if (!met || step >= distance * segment_end ||
        is_end(world, at, to, ray.direction, distance - step < at_the_end * whole)) {
      attenuate(to.at_infinity ? std::numeric_limits<float>::infinity() : distance);
      return left;
    }
    attenuate(step);
    const bool passes = through.lights && at.light != no_index;
    if (!passes && surroundings.crossing(world, at, ray.direction).is_boundary) {
      const std::optional<Rgb> part = through.null ? straight_through(at, -ray.direction) : std::nullopt;
      if (!part) return Rgb(0.0f);
      left *= *part;
    }
    if (!(max_component(left) > 0)) return Rgb(0.0f);
    surroundings.cross(world, at, ray.direction);
    ray = world.pass(ray, at, ray.direction);
  }
}

bool travel(const SceneInterface& world, Ray& ray, Surroundings& surroundings, float u_layer, TransportMode mode,
            Rgb& throughput, Interaction& at) {
  if (!world.has_media_or_bodies()) return world.intersect(ray, u_layer, mode, at);
  while (world.intersect(ray, u_layer, mode, at)) {
    if (surroundings.medium() != no_index)
      throughput *= world.scene().media.media[surroundings.medium()].transmittance(ray.way_to(at.p));
    const Crossing crossing = surroundings.crossing(world, at, ray.direction);
    if (crossing.is_boundary) {
      Surroundings::refract_as(crossing, at);
      return true;
    }
    surroundings.cross(world, at, ray.direction);
    ray = world.pass(ray, at, ray.direction);
  }
  if (surroundings.medium() != no_index)
    throughput *=
        world.scene().media.media[surroundings.medium()].transmittance(std::numeric_limits<float>::infinity());
  return false;
}

}  // namespace photonproof::inline renderer_scalar
