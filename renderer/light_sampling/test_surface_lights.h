// Surface lights of every kind with random and extreme parameters, the parts that a point sees, and points to see them
// from; test code only.
#pragma once

#include <algorithm>
#include <ostream>
#include <string>

#include "renderer/lanes/test_random.h"
#include "renderer/light_sampling/test_close_patches.h"
#include "renderer/lights/light_bounds.h"

namespace photonproof::test {

struct SurfaceLight {
  std::string name;
  Light light;
  std::vector<Patch> whole;
  std::function<Seen(const Vec3d& p)> seen;
  std::vector<Vec3f> places;
  /// Slant at a point on it: 1, and less towards a rim where chords end so obliquely that rounding moves their ends.
  std::function<double(const Vec3d& q, const Vec3d& n)> slant = [](const Vec3d&, const Vec3d&) { return 1.0; };
  double width = 1e30;  ///< width across its thinnest chord: rounding of its points moves the ends of chords
};

inline Vec3d random_unit(Random& r) { return normalize(Vec3d(square_to_sphere(r.next2()))); }
inline double random_between(Random& r, double low, double high) { return low + (high - low) * double{r.next()}; }
/// Rounds as the renderer does, through memory. GCC 12 drops the rounding of two of three components when it converts
/// them to float and back as a vector. A light of 1e-4 at a distance of 1e-2 is then off its double twin by 2e-4 of its
/// radius.
inline Vec3d rounded(const Vec3d& v) {
  const volatile float x = static_cast<float>(v.x), y = static_cast<float>(v.y), z = static_cast<float>(v.z);
  return {x, y, z};
}

/// The flat patches whose front faces the point.
inline std::function<Seen(const Vec3d&)> seen_fronts(const std::vector<Patch>& whole) {
  return [whole](const Vec3d& p) {
    Seen seen;
    double area = 0;
    for (const Patch& patch : whole) {
      area += patch.area;
      if (dot(patch.facing, p - patch.at(0.5, 0.5).p) <= 0) continue;
      seen.patches.push_back(patch);
      seen.share += patch.area;
    }
    seen.share /= area;
    return seen;
  };
}

/// Points before a flat light: almost touching it, grazing, at its size's distance, and so far that it is a point. The
/// last is behind.
inline std::vector<Vec3f> places_before(const Vec3d& center, const Vec3d& u, const Vec3d& v, const Vec3d& n,
                                        Random& r) {
  const double size = std::max(length(u), length(v));
  const auto on = [&] { return center + u * random_between(r, -0.4, 0.4) + v * random_between(r, -0.4, 0.4); };
  const Vec3d aside = normalize(u * random_between(r, -1, 1) + v);
  return {Vec3f(on() + n * (1e-3 * size)),
          Vec3f(center + aside * (3 * size) + n * (0.03 * size)),
          Vec3f(on() + n * (0.5 * size)),
          Vec3f(center + aside * (random_between(r, -5, 5) * size) + n * (2 * size)),
          Vec3f(center + (aside + n * 0.2) * (1e3 * size)),
          Vec3f(on() - n * size)};
}
inline std::vector<Vec3f> places_around(const Vec3d& center, double radius, const std::vector<double>& distances,
                                        Random& r) {
  std::vector<Vec3f> all;
  for (const double d : distances) all.emplace_back(center + random_unit(r) * (radius * d));
  return all;
}

inline Rgb gaudy(const Vec2<float>& uv) { return Rgb(0.1f + uv.x * uv.x, 2 * uv.y, uv.x < 0.5f ? 1 : 0.01f); }

inline void add_flat(std::vector<SurfaceLight>& all, const Vec3d& at, double size, double thin, Random& r) {
  const Vec3d u = rounded(random_unit(r) * size);
  // Not perpendicular: up to 60 degrees of shear.
  const Vec3d across = any_across(normalize(u));
  const Vec3d v = rounded((across + normalize(u) * random_between(r, -1.7, 1.7)) * (size * thin));
  const Vec3d n = normalize(cross(u, v)), center = rounded(at), corner = rounded(at - (u + v) * 0.5);
  const auto area = static_cast<float>(length(cross(u, v)));
  const Patch quad = quad_patch(corner, u, v, n), disk = disk_patch(center, u, v, n);
  const auto add = [&](const std::string& name, Light light, const Patch& patch, const auto& from, bool round) {
    const auto seen = [=](const Vec3d& p) -> Seen {
      if (dot(n, p - center) <= 0) return {};
      // Far from a disk its density is even over its area; chords in equal steps of the angle would be uneven.
      const bool close = dot(p - center, p - center) < 4 * (dot(u, u) + dot(v, v));
      return {{close || !round ? from(p) : patch}, 1, true, 4};
    };
    all.push_back({name, std::move(light), {patch}, seen, places_before(center, u, v, n, r)});
    all.back().width = std::min(length(u), length(v));
    if (round) all.back().slant = [patch](const Vec3d& q, const Vec3d&) { return 1 - patch.uv(q).x; };
  };
  const auto quad_seen = [=](const Vec3d& p) { return quad_from(p, corner, u, v, n); };
  const auto disk_seen = [=](const Vec3d& p) { return disk_from(p, center, u, v, n); };
  const Vec3f uf(u), vf(v), nf(n);
  add("quad", QuadLight<float>{Vec3f(corner), uf, vf, nf, area, Rgb(1), told_by_corner}, quad, quad_seen, false);
  add("textured quad", AreaLight(QuadShape{Vec3f(corner), uf, vf, nf}, gaudy), quad, quad_seen, false);
  add("disk", DiskLight<float>{Vec3f(center), uf, vf, nf, pi * area, Rgb(1), told_by_corner}, disk, disk_seen, true);
  add("textured disk", AreaLight(DiskShape{Vec3f(center), uf, vf, nf}, gaudy), disk, disk_seen, true);
  // Textured lights share the others' code: places almost touching, close and behind suffice.
  for (SurfaceLight& light : all)
    if (light.name.find("textured") == 0) light.places = {light.places[0], light.places[2], light.places[5]};
}

/// The smallest gap, in radii, that the places' floats resolve is `finest`.
inline void add_spheres(std::vector<SurfaceLight>& all, const Vec3d& at, double size, double finest, Random& r) {
  const Vec3d center = rounded(at);
  const double radius = static_cast<float>(size);
  const Vec3d up = random_unit(r);
  const auto seen_inward = [=](const Vec3d& p) -> Seen {
    if (length(p - center) < radius) return {{sphere_from_within(center, radius, p)}, 1, true, 6};
    // Share of the area: the part whose emitting side p sees lies beyond the horizon, z = R / distance on the axis to
    // p.
    const double horizon = radius / length(p - center);
    return {{sphere_zone(center, radius, -1, normalize(p - center), -1, horizon)}, (horizon + 1) / 2};
  };
  for (const double sign : {1.0, -1.0}) {
    const std::vector<Patch> whole{sphere_zone(center, radius, sign, up, -1, 1)};
    const std::string name = sign > 0 ? "sphere" : "inward sphere";
    const auto by_cone = [=](const Vec3d& p) -> Seen {
      if (length(p - center) < radius) return {};
      return {{sphere_cap(center, radius, p)}, 1};
    };
    const std::vector<double> outside{1.6, 6, 1e3, 0.5};
    all.push_back({name, SphereLight<float>{Vec3f(center), float(radius), float(sign), Rgb(1)}, whole,
                   sign > 0 ? std::function<Seen(const Vec3d&)>(by_cone) : seen_inward,
                   places_around(center, radius,
                                 sign > 0 ? std::vector<double>{1 + finest, 1.001, 1.02, 1.3, 6, 1e3, 0.5}
                                          : std::vector<double>{0.01, 0.5, 0.98, 0.999, 1.3, 50},
                                 r)});
    const Vec3d start = any_across(up);
    all.push_back({"textured " + name,
                   AreaLight(SphereShape{Vec3f(center), float(radius), Vec3f(start), Vec3f(cross(up, start)), Vec3f(up),
                                         float(sign)},
                             gaudy),
                   whole, sign > 0 ? std::function<Seen(const Vec3d&)>(by_cone) : seen_inward,
                   places_around(center, radius, outside, r)});
  }
}

inline void add_cylinders(std::vector<SurfaceLight>& all, const Vec3d& at, double size, double thin, double finest,
                          Random& r) {
  const Vec3d along = random_unit(r), axis = rounded(along * size), base = rounded(at - axis * 0.5);
  const double radius = static_cast<float>(size * thin * 0.5);
  const Vec3d start = any_across(normalize(axis)), side = cross(normalize(axis), start);
  for (const double sign : {1.0, -1.0}) {
    const auto seen = [=](const Vec3d& p) -> Seen {
      const Vec3d from_axis = p - base - axis * (dot(p - base, axis) / dot(axis, axis));
      if (length(from_axis) < radius) {
        if (sign > 0) return {};
        return {{cylinder_from_within(p, base, axis, radius)}, 1};
      }
      return {{cylinder_from(p, base, axis, radius, sign)}, 1};
    };
    const auto place = [&](double radii, double height) {
      const double phi = random_between(r, 0, 2 * std::numbers::pi);
      return Vec3f(base + axis * height + (start * std::cos(phi) + side * std::sin(phi)) * (radius * radii));
    };
    const std::vector<Vec3f> places{place(1 + std::max(finest, 1e-4), 0.6),
                                    place(1.3, 0.3),
                                    place(2, 2),
                                    place(4, -1),
                                    place(100, 0.5),
                                    place(0.5, 0.4),
                                    place(1 - std::max(finest, 0.01), 0.7),
                                    place(0.9, 30)};
    const std::vector<Patch> whole{cylinder_sector(base, axis, start, radius, sign, 0, 2 * std::numbers::pi)};
    const CylinderShape shape{base, axis, Vec3f(start), Vec3f(side), radius, float(sign)};
    const std::string name = sign > 0 ? "cylinder" : "inward cylinder";
    all.push_back({name, AreaLight(shape, Rgb(1)), whole, seen, places});
    all.back().width = radius;
    all.push_back({"textured " + name, AreaLight(shape, gaudy), whole, seen, {places[0]}});
    all.back().width = radius;
  }
}

/// Independent triangles, of sizes 1 to 1/100, some slivers.
inline void add_meshes(std::vector<SurfaceLight>& all, const Vec3d& at, double size, Random& r) {
  for (const bool flipped : {false, true}) {
    std::vector<Vec3f> positions;
    std::vector<MeshShape::Triangle> faces;
    std::vector<Vec2<float>> uvs;
    std::vector<Patch> whole;
    std::vector<std::array<Vec3d, 3>> corners;
    for (std::uint32_t i = 0; i < 10; ++i) {
      const Vec3d middle = at + random_unit(r) * size, u = random_unit(r), v = any_across(u);
      const double edge = size * std::pow(10, random_between(r, -2, 0)), thin = i % 3 == 0 ? 0.01 : 1;
      for (const Vec3d& corner :
           {middle, middle + u * edge, middle + (v + u * random_between(r, -1, 1)) * (edge * thin)}) {
        positions.emplace_back(corner);
        uvs.push_back(r.next2());
      }
      faces.push_back({3 * i, 3 * i + 1, 3 * i + 2});
      const auto corner = [&](std::size_t k) { return Vec3d(positions[3 * i + k]); };
      corners.push_back({corner(0), corner(1), corner(2)});
      whole.push_back(triangle_patch(corner(0), corner(1), corner(2), flipped ? -1 : 1, i));
    }
    const std::string name = flipped ? "flipped mesh" : "mesh";
    const MeshShape shape(positions, faces, uvs, flipped);
    // From nearby, triangles are chosen by an importance that is above 0 for some that face away.
    const auto seen = [=, fronts = seen_fronts(whole), box = round_bounds(positions)](const Vec3d& p) {
      Seen found = fronts(p);
      const Vec3d diagonal(box.high - box.low), from = p - Vec3d(box.low + box.high) * 0.5;
      if (dot(from, from) > dot(diagonal, diagonal)) return found;
      for (Patch& patch : found.patches) {
        const std::uint32_t i = patch.at(0.5, 0.5).triangle;
        patch = triangle_from(p, corners[i], patch.facing, i);
      }
      found.share_known = false;
      found.finer = 2;
      return found;
    };
    // Places that see at least a fifth of it: a million samples of a smaller part take too long.
    std::vector<Vec3f> places;
    for (const double distance : {0.7, 2.0, 3.0, 1e3}) {
      Vec3f p(0.0f);
      do p = Vec3f(at + random_unit(r) * (size * distance));
      while (seen(Vec3d(p)).share < 0.2);
      places.push_back(p);
    }
    for (const double away : {1e-3, 0.1}) {  // distance from the middle of a triangle
      const std::array<Vec3d, 3>& t = corners[1];
      places.emplace_back((t[0] + t[1] + t[2]) / 3.0 + whole[1].facing * (away * length(t[1] - t[0])));
    }
    // The smallest barycentric coordinate: chords vanish in corners.
    const auto slant = [whole](const Vec3d& q, const Vec3d& n) {
      const auto less = [&](const Patch& a, const Patch& b) { return dot(a.facing, n) < dot(b.facing, n); };
      const Vec2<double> uv = std::max_element(whole.begin(), whole.end(), less)->uv(q);
      return std::min({1 - uv.x, uv.x * uv.y, uv.x * (1 - uv.y)});
    };
    all.push_back({name, AreaLight(shape, Rgb(1)), whole, seen, places, slant, 1e-4 * size});
    all.push_back({"textured " + name, AreaLight(shape, gaudy), whole, seen, {places[0]}, slant, 1e-4 * size});
  }
}

struct Setting {
  const char* name;
  std::uint64_t seed;
  double size, away, thin;
};
inline void PrintTo(const Setting& s, std::ostream* out) { *out << s.name; }
/// Far from the origin is where floats are coarse.
inline constexpr std::array<Setting, 3> settings{
    {{"ordinary", 51, 1, 0.5, 1}, {"tiny_thin_and_far_away", 52, 1e-4, 1e-2, 0.02}, {"huge", 53, 1e5, 1e5, 0.4}}};

inline std::vector<SurfaceLight> surface_lights(const Setting& setting) {
  std::vector<SurfaceLight> all;
  Random r(setting.seed);
  const Vec3d at = random_unit(r) * setting.away;
  add_flat(all, at, setting.size, setting.thin, r);
  const double finest = std::max(1e-6, 4e-6 * setting.away / setting.size);
  add_spheres(all, at, setting.size, finest, r);
  add_cylinders(all, at, setting.size, setting.thin, 10 * finest / setting.thin, r);
  add_meshes(all, at, setting.size, r);
  return all;
}

}  // namespace photonproof::test
