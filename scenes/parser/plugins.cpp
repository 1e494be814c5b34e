#include "scenes/parser/plugins.h"

#include <cmath>

namespace photonproof::scene_xml {
namespace {

constexpr double kShearTolerance = 1e-5;  // what six printed digits of a matrix leave

}  // namespace

std::string title_of(const Sources& sources, const Element& object) {
  return object.tag + " " + in_quotes(require(sources, object, "type").value);
}

std::string id_of(const Element& object) {
  const Attribute* id = object.find("id");
  return id ? id->value : std::string();
}

bool is_perpendicular(const Vec3d& a, const Vec3d& b) {
  return std::abs(dot(normalize(a), normalize(b))) <= kShearTolerance;
}

bool is_even(const Transform& t) {
  const Vec3d x = t.vector({1, 0, 0}), y = t.vector({0, 1, 0}), z = t.vector({0, 0, 1});
  const double size = length(x);
  return std::abs(length(y) / size - 1) <= kShearTolerance && std::abs(length(z) / size - 1) <= kShearTolerance &&
         is_perpendicular(x, y) && is_perpendicular(y, z) && is_perpendicular(z, x);
}

void expect_alone(const Params& params, const std::string& name, const std::string& other) {
  params.expect(!(params.has(name) && params.has(other)), name,
                "is given beside " + other + ", expected one or the other");
}

Vec3d unit_vector(Params& params, const std::string& name, const Vec3d& fallback) {
  const Vec3d v = params.point(name, fallback);
  if (std::abs(length_squared(v) - 1) < 1e-8) return v;
  const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  params.expect(largest > 0, name, "is zero, expected a direction");
  return normalize(v / largest);
}

void expect_similarity(Params& params, const std::string& what) {
  const Transform to_world = params.transform("to_world");
  params.expect(is_even(to_world), "to_world",
                "scales unevenly or shears, which " + what + " cannot, expected a uniform scale");
  params.expect(to_world.determinant() > 0, "to_world", "mirrors " + what + ", expected a positive scale");
}

}  // namespace photonproof::scene_xml
