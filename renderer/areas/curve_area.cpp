#include "renderer/areas/curve_area.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "renderer/photons/surface_side.h"
#include "renderer/shapes/local_geometry.h"

namespace photonproof::inline renderer_areas {
namespace {

constexpr std::size_t cuts_of_bspline = 8;  ///< cones of a segment

/// Gauss-Legendre quadrature of eight points on [-1, 1].
constexpr std::array<double, 8> nodes{-0.9602898564975363, -0.7966664774136267, -0.5255324099163290,
                                      -0.1834346424956498, 0.1834346424956498,  0.5255324099163290,
                                      0.7966664774136267,  0.9602898564975363};
constexpr std::array<double, 8> weights{0.1012285362903763, 0.2223810344533745, 0.3137066458778873, 0.3626837833783620,
                                        0.3626837833783620, 0.3137066458778873, 0.2223810344533745, 0.1012285362903763};

struct Interval {
  double low, high;
  void keep(double from, double to) {
    low = std::max(low, from);
    high = std::min(high, to);
  }
  double length() const { return std::max(0.0, high - low); }
};

/// Half the angle of the part of a circle that is at most `reach` from a point; 0 where there is none. The circle's
/// radius is `radius`, and the point is `off` from its middle.
double half_arc(double radius, double off, double reach) {
  const double twice = 2 * radius * off, rest = radius * radius + off * off - reach * reach;
  if (rest <= -twice) return std::numbers::pi;
  return rest >= twice ? 0 : std::acos(rest / twice);
}

}  // namespace

struct CurveArea::Gather {
  Vec3d p, normal;
  double radius, height;
};

CurveArea::CurveArea(const Curves& curves) {
  const std::vector<Piece> pieces = cut(curves);
  std::vector<BoxTree::Part> parts;
  parts.reserve(pieces.size());
  for (const Piece& piece : pieces) {
    const Vec3f reach(piece.radius), far = piece.start + piece.axis * piece.length;
    BoxTree::Part& part = parts.emplace_back(BoxTree::Part{{}, piece.start});
    part.box.add({piece.start - reach, piece.start + reach});
    part.box.add({far - reach, far + reach});
  }
  std::vector<std::uint32_t> order;
  tree_ = BoxTree(parts, order);
  pieces_.reserve(pieces.size());
  for (const std::uint32_t i : order) pieces_.push_back(pieces[i]);
}

std::vector<CurveArea::Piece> CurveArea::cut(const Curves& curves) {
  std::vector<Piece> pieces;
  const std::size_t cuts = curves.linear ? 1 : cuts_of_bspline;
  const auto add_end = [&](const CurveFrame& at, double side) {
    if (at.radius > 0 && length(at.along) > 0)
      pieces.push_back({Vec3f(at.center), Vec3f(normalize(at.along) * side), 0, static_cast<float>(at.radius), 1});
  };
  for (std::size_t i = 0; i < curves.segments.size(); ++i) {
    for (std::size_t k = 0; k < cuts; ++k) {
      const CurveFrame from = curve_frame(curves, i, static_cast<double>(k) / static_cast<double>(cuts));
      const CurveFrame to = curve_frame(curves, i, static_cast<double>(k + 1) / static_cast<double>(cuts));
      const Vec3d axis = to.center - from.center;
      const double run = length(axis), rise = to.radius - from.radius, radius = (from.radius + to.radius) / 2;
      if (!(run > 0 && radius > 0)) continue;
      pieces.push_back({Vec3f(from.center), Vec3f(axis / run), static_cast<float>(run), static_cast<float>(radius),
                        static_cast<float>(std::sqrt(1 + rise * rise / (run * run)))});
    }
    if (!curves.linear) continue;
    const std::uint32_t first = curves.segments[i];
    if (i == 0 || curves.segments[i - 1] + 1 != first) add_end(curve_frame(curves, i, 0), -1);
    if (i + 1 == curves.segments.size() || first + 1 != curves.segments[i + 1]) add_end(curve_frame(curves, i, 1), 1);
  }
  return pieces;
}

// Along a line of the cylinder, the part in the ball and between the two planes is an interval. Over the angle about
// the axis it is integrated where the ball and the normals' limit leave an arc. The arc's angle is a sine, which makes
// the integrand smooth where the line touches the ball.
double CurveArea::of_cone(const Gather& at, const Piece& piece) {
  const Vec3d axis(piece.axis), from_start = at.p - Vec3d(piece.start);
  const double run = double{piece.length}, radius = double{piece.radius};
  const double along = dot(from_start, axis), tilt = dot(at.normal, axis);
  const Vec3d off = from_start - axis * along, up = at.normal - axis * tilt;
  const double distance = length(off), steep = length(up);
  if (!(steep > double{least_side_cosine})) return 0;
  const Vec3d x = up / steep, y = cross(axis, x);
  // The lower of the two planes also ends the arc; a tilted one does so where the tube is nearest to it.
  const double floor = dot(at.normal, off) - at.height - std::abs(tilt) * at.radius;
  const double limit = std::acos(std::clamp(std::max(double{least_side_cosine}, floor / radius) / steep, -1.0, 1.0));
  const double half = half_arc(radius, distance, at.radius), middle = std::atan2(dot(off, y), dot(off, x));
  const auto part_of_line = [&](double angle) {
    const Vec3d foot = (x * std::cos(angle) + y * std::sin(angle)) * radius - off;  // from the gather's axis
    const double room2 = at.radius * at.radius - dot(foot, foot);
    if (!(room2 > 0)) return 0.0;
    Interval part{0, run};
    part.keep(along - std::sqrt(room2), along + std::sqrt(room2));
    const double above = dot(at.normal, foot) - along * tilt;  // at the start
    if (std::abs(tilt) < 1e-9) return std::abs(above) <= at.height ? part.length() : 0.0;
    const double a = (-at.height - above) / tilt, b = (at.height - above) / tilt;
    part.keep(std::min(a, b), std::max(a, b));
    return part.length();
  };
  double area = 0;
  for (const double turn : {-2 * std::numbers::pi, 0.0, 2 * std::numbers::pi}) {
    Interval arc{-limit, limit};
    if (half < std::numbers::pi)
      arc.keep(middle - half + turn, middle + half + turn);
    else if (turn != 0)
      continue;
    if (!(arc.length() > 0)) continue;
    const double centre = (arc.low + arc.high) / 2, reach = arc.length() / 2;
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      const double t = nodes[k] * std::numbers::pi / 2;
      area += weights[k] * reach * std::cos(t) * part_of_line(centre + reach * std::sin(t));
    }
  }
  return area * std::numbers::pi / 2 * radius * double{piece.slant};
}

// The smaller one of two caps of the ball is sampled: that of normals near the gather's, and that in its radius.
double CurveArea::of_end(const Gather& at, const Piece& piece) {
  constexpr int turns = 16;
  const double radius = double{piece.radius};
  const Vec3d from_center = at.p - Vec3d(piece.start);
  const double distance = length(from_center), half = half_arc(radius, distance, at.radius);
  const bool by_radius = std::cos(half) > double{least_side_cosine};
  double height = by_radius ? 1 - std::cos(half) : 1 - double{least_side_cosine};
  const Vec3d z = by_radius ? from_center / distance : at.normal;
  const bool is_on_ball = dot(z, at.normal) > 1 - 1e-4;  // then the plane below ends the cap
  if (is_on_ball) height = std::min(height, std::max(0.0, at.height + radius - distance) / radius);
  const Tangents across = any_tangents(Vec3f(z));
  const Vec3d x(across.s), y = cross(z, x);
  double area = 0;
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const double cosine = 1 - height * (1 + nodes[k]) / 2, sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
    for (int i = 0; i < turns; ++i) {
      const double angle = 2 * std::numbers::pi * (i + 0.5) / turns;
      const Vec3d out = z * cosine + (x * std::cos(angle) + y * std::sin(angle)) * sine;
      const Vec3d offset = out * radius - from_center;
      const bool counts = dot(out, Vec3d(piece.axis)) >= 0 && dot(out, at.normal) >= double{least_side_cosine} &&
                          length_squared(offset) <= at.radius * at.radius &&
                          std::abs(dot(offset, at.normal)) <= at.height;
      if (counts) area += weights[k];
    }
  }
  return area * height / 2 * 2 * std::numbers::pi / turns * radius * radius;
}

double CurveArea::within(const Vec3f& p, const Vec3f& outward, float radius) const {
  const Gather at{Vec3d(p), Vec3d(outward), double{radius}, double{sheet_height} * double{radius}};
  double area = 0;
  tree_.visit_near(p, radius, [&](std::uint32_t place) {
    const Piece& piece = pieces_[place];
    area += piece.length > 0 ? of_cone(at, piece) : of_end(at, piece);
  });
  return area;
}

}  // namespace photonproof::inline renderer_areas
