#include "scenes/pbrt/curves.h"

#include <array>
#include <cmath>
#include <limits>

#include "scenes/base/text_numbers.h"

namespace photonproof::inline scenes_pbrt {
namespace {

constexpr int kMostHalvings = 4;  ///< towards a point

/// A cubic Bezier curve; the radius grows evenly with the parameter.
struct Bezier {
  std::array<Vec3d, 4> at;
  double first = 0, last = 0;  ///< radii

  std::pair<Bezier, Bezier> halves() const {
    const auto middle = [](const Vec3d& a, const Vec3d& b) { return (a + b) / 2; };
    const Vec3d a = middle(at[0], at[1]), b = middle(at[1], at[2]), c = middle(at[2], at[3]);
    const Vec3d ab = middle(a, b), bc = middle(b, c), abc = middle(ab, bc);
    const double radius = (first + last) / 2;
    return {{{at[0], a, ab, abc}, first, radius}, {{abc, bc, c, at[3]}, radius, last}};
  }
};

/// Pieces of the curve of P. Those of degree 2 are raised.
std::vector<std::array<Vec3d, 4>> pieces_of(const PbrtParameters& p, const std::vector<Vec3d>& points) {
  const auto degree = static_cast<std::size_t>(p.integer("degree", 3, 2, 3));
  const std::string basis = p.text("basis", "bezier");
  if (basis != "bezier" && basis != "bspline")
    p.fail("has the basis " + in_quotes(basis) + ", expected bezier or bspline");
  const bool bezier = basis == "bezier";
  if (points.size() < degree + 1 || (bezier && (points.size() - 1) % degree != 0))
    p.fail("has " + std::to_string(points.size()) + " points, expected degree + 1" +
           (bezier ? ", or degree more for each further piece" : " or more"));
  const auto raised = [](const Vec3d& a, const Vec3d& b, const Vec3d& c) {
    return std::array{a, (a + b * 2.0) / 3, (c + b * 2.0) / 3, c};
  };
  std::vector<std::array<Vec3d, 4>> pieces;
  for (std::size_t i = 0; i + degree < points.size(); i += bezier ? degree : 1) {
    const Vec3d* q = &points[i];
    if (degree == 2)
      pieces.push_back(bezier ? raised(q[0], q[1], q[2]) : raised((q[0] + q[1]) / 2, q[1], (q[1] + q[2]) / 2));
    else if (bezier)
      pieces.push_back({q[0], q[1], q[2], q[3]});
    else
      pieces.push_back({(q[0] + q[1] * 4.0 + q[2]) / 6, (q[1] * 2.0 + q[2]) / 3, (q[1] + q[2] * 2.0) / 3,
                        (q[1] + q[2] * 4.0 + q[3]) / 6});
  }
  return pieces;
}

std::vector<Vec3d> points_of(const PbrtParameters& p) {
  const std::vector<double> numbers = p.numbers("P", {"point3", "point"});
  if (numbers.size() % 3 != 0) p.fail("has " + std::to_string(numbers.size()) + " numbers in P, expected points");
  std::vector<Vec3d> points;
  for (std::size_t i = 0; i + 2 < numbers.size(); i += 3)
    points.push_back({numbers[i], numbers[i + 1], numbers[i + 2]});
  return points;
}

/// As a B-spline of one piece, whose middle part is the curve. Control radii before a point would be negative, so a
/// curve that is pointed is halved towards the point, and the last piece is a little blunt.
void append(CurveSet& set, const Bezier& curve, int halvings = 0) {
  const double step = curve.last - curve.first;
  const bool pointed = curve.first - step < 0 || curve.last + step < 0;
  if (pointed && halvings < kMostHalvings) {
    const auto [first, second] = curve.halves();
    append(set, first, halvings + 1);
    append(set, second, halvings + 1);
    return;
  }
  const auto& b = curve.at;
  const std::array<Vec3d, 4> control{b[0] * 6.0 - b[1] * 7.0 + b[2] * 2.0, b[1] * 2.0 - b[2], b[2] * 2.0 - b[1],
                                     b[1] * 2.0 - b[2] * 7.0 + b[3] * 6.0};
  set.first.push_back(static_cast<std::uint32_t>(set.points.size()));
  for (std::size_t i = 0; i < 4; ++i)
    set.points.push_back(
        {Vec3f(control[i]), static_cast<float>(std::max(0.0, curve.first + step * (static_cast<double>(i) - 1)))});
}

}  // namespace

void PbrtCurves::add(const PbrtParameters& p, const Transform& to_world, BsdfIndex bsdf, int group) {
  p.ignore({"splitdepth"});
  const std::string type = p.text("type", "flat");
  if (type != "flat" && type != "cylinder" && type != "ribbon")
    p.fail("has the type " + in_quotes(type) + ", expected flat, cylinder or ribbon");
  if (type == "ribbon") p.numbers("N", {"normal", "normal3"});
  if (type != "cylinder")
    context_.log.note(p.at(), "curves of type '" + type + "' are rendered as tubes of their width");
  const double width = p.number("width", 1, 0, 1e30);
  const double thick = std::cbrt(std::abs(to_world.determinant())) / 2;
  const double first = p.number("width0", width, 0, 1e30) * thick, last = p.number("width1", width, 0, 1e30) * thick;
  const std::vector<std::array<Vec3d, 4>> pieces = pieces_of(p, points_of(p));
  p.finish();
  CurveSet& set = sets_[{group, bsdf.value}];
  if (set.points.size() > std::numeric_limits<std::uint32_t>::max() / 2) p.fail("is one of too many curves");
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const auto share = [&](std::size_t k) { return static_cast<double>(k) / static_cast<double>(pieces.size()); };
    Bezier curve{pieces[i], first + (last - first) * share(i), first + (last - first) * share(i + 1)};
    for (Vec3d& point : curve.at) {
      point = to_world.point(point);
      if (!is_finite(Vec3f(point))) p.fail("has a point that does not fit single precision");
    }
    append(set, curve);
  }
}

void PbrtCurves::finish() {
  for (const auto& [place, set] : sets_) {
    const auto& [group, bsdf] = place;
    ShapeDescription shape;
    CurvesDescription curves;
    curves.filename = context_.files.write(set);
    shape.geometry = curves;
    shape.bsdf = {bsdf};
    (group < 0 ? context_.scene.shapes : context_.scene.groups[static_cast<std::size_t>(group)].shapes)
        .push_back(shape);
  }
  sets_.clear();
}

}  // namespace photonproof::inline scenes_pbrt
