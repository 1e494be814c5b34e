// Sampling a flat light from a point that is close relative to its size. Points sampled uniformly by area would nearly
// all be far away. For half-size S at height h, a share (h/S)^2 of them lies where most of the light comes from. Here
// the light is cut into parallel chords. Both the chord and the point on it are sampled by the angle that they subtend.
// Kulla and Fajardo sample a segment this way (2012, "Importance Sampling Techniques for Path Tracing in Participating
// Media", section 4.1). Let h be the height of p above the plane, y the chord's distance from the foot of p and x the
// position on the chord. D^2 = h^2 + y^2, and d is the distance from p. The angles of strip and chord are a and b, at
// most pi.
//   `p(y) = h / (a D^2),   p(x | y) = D / (b(y) d^2)`.
// The density per solid angle, p(y) p(x|y) d^3/h = d / (a b D), is never below 1/pi^2, whatever the light's size. An
// even density over the hemisphere is 1/(2 pi). Chords run across the direction in which p is beside the light.
// Otherwise chords near p would get samples at grazing angles although the light is not near there.
#pragma once

#include <array>
#include <limits>

#include "renderer/lanes/lane_trig.h"
#include "renderer/lights/light_sample.h"

namespace photonproof::inline renderer_lights {

/// A light is close where p is within twice its half-extent from its centre. Elsewhere no point of it is nearer than
/// its half-extent, and area sampling is as good and cheaper.
template <class F>
Mask<F> is_close(const Vec3<F>& p, const Vec3<F>& center, const F& half_extent2) {
  const Vec3<F> d = p - center;
  return dot(d, d) < 4 * half_extent2;
}

/// A quick preliminary test: where p is close, no point of the light is as far as three half-extents. `distance2` is
/// the square of the distance to any point. The test has a margin for rounding.
template <class F>
bool some_may_be_close(const F& distance2, const F& half_extent2) {
  return any(distance2 < 9.1f * half_extent2);
}

/// The angle, in [0, pi], that [low, high] on a line subtends at `distance` from the line's origin.
template <class F>
F seen_angle(const F& low, const F& high, const F& distance) {
  return angle_of(F(distance * lane_max(F(high - low), F(0.0f))), F(mul_add(low, high, distance * distance)));
}

/// The point that divides the given angle in the ratio u.
template <class F>
F at_angle(const F& u, const F& angle, const F& low, const F& high, const F& distance) {
  // The ray (distance, low), rotated by u angle.
  const SinCos<F> turn = sincos_turn(F(u * angle * 0.159154943f));
  const F along = distance * turn.cos - low * turn.sin;
  const F across = low * turn.cos + distance * turn.sin;
  const F x = distance * across / select(along > 0, along, F(1.0f));
  return select(along > 0, lane_min(lane_max(x, low), high), select(across > 0, high, low));
}

/// Value of a light's `offset` where heights above its plane follow from its corner.
inline constexpr float told_by_corner = std::numeric_limits<float>::infinity();
/// Height of p above a plane. Differences from a distant corner leave no digits of it; the plane's normal . x is exact
/// there.
template <class F>
F height_above(const Vec3<F>& p, const Vec3<F>& corner, const Vec3<F>& normal, const F& offset) {
  return select(offset < told_by_corner, F(dot(p, normal) - offset), dot(p - corner, normal));
}

/// Position of p relative to the light's plane.
template <class F>
struct FlatFrame {
  Vec3<F> along, up;  ///< Unit and perpendicular, in the plane; chords run along `along`.
  F height;           ///< Height of p above the plane, on the emitting side.
  F x, y;             ///< Foot of p in this frame.
};

template <class F>
struct Chord {
  F low, high;
};

template <class F>
struct CloseSample {
  Vec3<F> offset;  ///< vector from p to the point
  F pdf;           ///< per solid angle
};

/// Density per solid angle at p of the point at (x, y) on a chord within [y_low, y_high], all relative to the foot of
/// p. It is 0 from behind.
template <class F>
F close_pdf(const F& height, const F& y_low, const F& y_high, const F& y, const Chord<F>& chord, const F& x) {
  const F distance = lane_sqrt(F(mul_add(y, y, height * height)));
  const F angles = seen_angle(y_low, y_high, height) * seen_angle(chord.low, chord.high, distance);
  const F d = lane_sqrt(F(mul_add(x, x, distance * distance)));
  const Mask<F> lit = height > 0 && angles > 0;
  return select(lit, d / (select(lit, F(angles * distance), F(1.0f))), F(0.0f));
}

/// `Flat` has FlatFrame<F> frame, F y_low, F y_high and Chord<F> chord(y), all relative to the foot.
template <class F, class Flat>
CloseSample<F> close_sample(const Flat& flat, const Vec3<F>& normal, const Vec2<F>& u) {
  const F height = flat.frame.height;
  const F y = at_angle(u.y, seen_angle(flat.y_low, flat.y_high, height), flat.y_low, flat.y_high, height);
  const Chord<F> chord = flat.chord(y);
  const F distance = lane_sqrt(F(mul_add(y, y, height * height)));
  const F x = at_angle(u.x, seen_angle(chord.low, chord.high, distance), chord.low, chord.high, distance);
  const Vec3<F> offset = advance(advance(normal * (-height), y, flat.frame.up), x, flat.frame.along);
  return {offset, close_pdf(height, flat.y_low, flat.y_high, y, chord, x)};
}
/// Density of a point of the light that was found otherwise, at this offset from p.
template <class F, class Flat>
F close_pdf(const Flat& flat, const Vec3<F>& offset) {
  const F y = lane_min(lane_max(F(dot(offset, flat.frame.up)), flat.y_low), flat.y_high);
  return close_pdf(flat.frame.height, flat.y_low, flat.y_high, y, flat.chord(y), F(dot(offset, flat.frame.along)));
}

/// Replaces a sample by area with one by angle, in these lanes.
template <class F>
void choose_close(LightSample<F>& s, const Mask<F>& close, const Vec3<F>& p, const CloseSample<F>& c) {
  s.at.p = select(close, Vec3<F>(p + c.offset), s.at.p);
  s.wi = select(close, normalize(c.offset), s.wi);
  s.pdf = select(close, c.pdf, s.pdf);
}

/// Sampling of lights with is_close_to(p), height(p) and shape_from(p). Few packs have close lanes, so this code is out
/// of line. Behind the light, for instance on a ceiling around it, densities are 0 for every strategy.
template <class F, class Light>
[[gnu::noinline]] void sample_close(const Light& light, const Vec3<F>& p, const Vec2<F>& u, LightSample<F>& s) {
  const Mask<F> close = light.is_close_to(p) && light.height(p) > 0;
  if (any(close)) choose_close(s, close, p, close_sample<F>(light.shape_from(p), light.normal, u));
}
template <class F, class Light>
[[gnu::noinline]] void pdf_close(const Light& light, const Vec3<F>& p, const Vec3<F>& p_light, F& pdf) {
  const Mask<F> close = light.is_close_to(p) && light.height(p) > 0;
  if (any(close)) pdf = select(close, close_pdf<F>(light.shape_from(p), Vec3<F>(p_light - p)), pdf);
}

/// Axes with `along` on an edge, and the position of p relative to their origin and plane.
template <class F>
FlatFrame<F> flat_frame(const Vec3<F>& from_origin, const F& height, const Vec3<F>& edge, const Vec3<F>& other) {
  const Vec3<F> along = normalize(edge);
  const Vec3<F> up = normalize(Vec3<F>(other - along * dot(other, along)));
  return {along, up, height, dot(from_origin, along), dot(from_origin, up)};
}

template <class F>
struct CloseParallelogram {
  FlatFrame<F> frame;
  F y_low, y_high;
  F length, shear;  ///< length of the chords; their shift per unit of height

  /// The vector `from_corner` leads from the corner to p.
  CloseParallelogram(const Vec3<F>& from_corner, const F& height, const Vec3<F>& edge_u, const Vec3<F>& edge_v,
                     const Vec3<F>& normal) {
    // Distance of p beyond the strip between two opposite edges; twice the area cancels.
    const Vec3<F> across_u = cross(normal, edge_u), across_v = cross(edge_v, normal);
    const F beside_u = beside(F(dot(from_corner, across_u)), F(dot(edge_v, across_u))) / photonproof::length(edge_u);
    const F beside_v = beside(F(dot(from_corner, across_v)), F(dot(edge_u, across_v))) / photonproof::length(edge_v);
    const Mask<F> swap = beside_v > beside_u;
    const Vec3<F> edge = select(swap, edge_v, edge_u), other = select(swap, edge_u, edge_v);
    frame = flat_frame(from_corner, height, edge, other);
    const F width = dot(other, frame.up);
    length = dot(edge, frame.along);
    shear = dot(other, frame.along) / width;
    y_low = -frame.y;
    y_high = width - frame.y;
  }
  Chord<F> chord(const F& y) const {
    const F low = mul_add(F(y + frame.y), shear, F(-frame.x));
    return {low, low + length};
  }

 private:
  /// Distance of s from the range between 0 and `end`; `end` may be negative.
  static F beside(const F& s, const F& end) {
    const F low = lane_min(end, F(0.0f)), high = lane_max(end, F(0.0f));
    return lane_max(lane_max(F(low - s), F(s - high)), F(0.0f));
  }
};

template <class F>
struct CloseEllipse {
  FlatFrame<F> frame;
  F y_low, y_high;
  F half, reach, shear;  ///< Half length of the longest chord, range of the heights, and shift per unit of height.

  /// The vector `from_center` leads from the centre to p. Any conjugate half axes suffice: the second is turned towards
  /// p.
  CloseEllipse(const Vec3<F>& from_center, const F& height, const Vec3<F>& half_axis_u, const Vec3<F>& half_axis_v,
               const Vec3<F>& normal) {
    const F twice = dot(cross(half_axis_u, half_axis_v), normal);
    const F a = dot(cross(from_center, half_axis_v), normal) / twice;
    const F b = dot(cross(half_axis_u, from_center), normal) / twice;
    const F r = lane_sqrt(F(mul_add(a, a, b * b)));
    const Mask<F> beside = r > 1e-6f;
    const F c = select(beside, b / select(beside, r, F(1.0f)), F(1.0f));
    const F s = select(beside, a / select(beside, r, F(1.0f)), F(0.0f));
    const Vec3<F> towards = half_axis_u * s + half_axis_v * c, across = half_axis_u * c - half_axis_v * s;
    frame = flat_frame(from_center, height, across, towards);
    half = dot(across, frame.along);
    reach = dot(towards, frame.up);
    shear = dot(towards, frame.along) / reach;
    y_low = -reach - frame.y;
    y_high = reach - frame.y;
  }
  Chord<F> chord(const F& y) const {
    const F from_middle = y + frame.y, t = from_middle / reach;
    const F wide = half * lane_sqrt(lane_max(F(1 - t * t), F(0.0f)));
    const F middle = mul_add(from_middle, shear, F(-frame.x));
    return {middle - wide, middle + wide};
  }
};

/// A triangle for one path at a time, as in sampling meshes.
struct CloseTriangle {
  FlatFrame<float> frame;
  float y_low, y_high;
  float length, apex;  ///< length of the longest chord, at y_low; position of the apex from the chord's start

  CloseTriangle(const Vec3f& p, float height, const std::array<Vec3d, 3>& corner);
  Chord<float> chord(float y) const {
    const float t = (y - y_low) / (y_high - y_low);
    const float low = apex * t - frame.x;
    return {low, low + length * (1 - t)};
  }
};

}  // namespace photonproof::inline renderer_lights
