#include "reference/povray/povray_mesh.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <ostream>
#include <utility>

namespace photonproof::inline reference_povray {
namespace {

/// Text that goes to a stream in large pieces.
class Buffered {
 public:
  explicit Buffered(std::ostream& out) : out_(out) { text_.reserve(kFull + 256); }
  ~Buffered() { flush(); }
  Buffered(const Buffered&) = delete;
  Buffered& operator=(const Buffered&) = delete;

  Buffered& operator<<(std::string_view text) {
    text_ += text;
    return *this;
  }
  Buffered& operator<<(float value) { return number(value); }
  Buffered& operator<<(std::uint64_t value) { return number(value); }
  void end_line() {
    text_ += '\n';
    if (text_.size() >= kFull) flush();
  }

 private:
  static constexpr std::size_t kFull = std::size_t{1} << 16;
  template <class T>
  Buffered& number(T value) {
    std::array<char, 32> digits{};
    text_.append(digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr);
    return *this;
  }
  void flush() {
    out_.write(text_.data(), static_cast<std::streamsize>(text_.size()));
    text_.clear();
  }
  std::ostream& out_;
  std::string text_;
};

}  // namespace

std::array<Vec3d, 8> PovMesh::box_corners() const {
  std::array<Vec3d, 8> corners;
  for (std::size_t i = 0; i < 8; ++i)
    corners[i] = {(i & 1) != 0 ? high.x : low.x, (i & 2) != 0 ? high.y : low.y, (i & 4) != 0 ? high.z : low.z};
  return corners;
}

std::array<Vec3d, 3> PovMesh::triangle(std::size_t i) const {
  const auto& [a, b, c] = mesh->triangles[i];
  const auto corner = [&](std::uint32_t v) { return to_world.point(Vec3d(mesh->positions[v])); };
  return {corner(a), corner(flip ? c : b), corner(flip ? b : c)};
}

bool PovMesh::any_triangle(const std::function<bool(const std::array<Vec3d, 3>&)>& holds) const {
  for (std::size_t i = 0; i < mesh->triangles.size(); ++i)
    if (holds(triangle(i))) return true;
  return false;
}

bool PovMesh::is_closed() const {
  std::map<std::array<float, 3>, std::uint32_t> places;
  std::vector<std::uint32_t> place_of;
  for (const Vec3f& p : mesh->positions)
    place_of.push_back(places.try_emplace({p.x, p.y, p.z}, static_cast<std::uint32_t>(places.size())).first->second);
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> passed;  // from the lower to the higher, less the other way
  double volume = 0;
  for (std::size_t i = 0; i < mesh->triangles.size(); ++i) {
    const auto& corners = mesh->triangles[i];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = place_of[corners[k]], b = place_of[corners[(k + 1) % 3]];
      passed[std::minmax(a, b)] += a < b ? 1 : -1;
    }
    const auto [a, b, c] = triangle(i);
    volume += dot(a - low, cross(b - low, c - low));
  }
  const auto is_balanced = [](const auto& edge) { return edge.second == 0 || edge.first.first == edge.first.second; };
  return volume > 0 && std::ranges::all_of(passed, is_balanced);
}

std::vector<Vec3d> vertex_normals(const TriangleMesh& mesh) {
  std::vector<Vec3d> normals(mesh.positions.size(), Vec3d(0.0));
  const auto normalized = [](const Vec3d& n) { return dot(n, n) > 0 ? normalize(n) : Vec3d{0, 0, 1}; };
  if (!mesh.normals.empty()) {
    for (std::size_t i = 0; i < normals.size(); ++i) normals[i] = normalized(Vec3d(mesh.normals[i]));
    return normals;
  }
  for (const auto& triangle : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3d at(mesh.positions[triangle[k]]);
      const Vec3d u = Vec3d(mesh.positions[triangle[(k + 1) % 3]]) - at;
      const Vec3d v = Vec3d(mesh.positions[triangle[(k + 2) % 3]]) - at;
      const Vec3d n = cross(u, v);
      if (!(dot(n, n) > 0)) continue;
      normals[triangle[k]] += normalize(n) * std::atan2(length(n), dot(u, v));
    }
  }
  for (Vec3d& n : normals) n = normalized(n);
  return normals;
}

PovMesh place_mesh(const ShapeDescription& shape, std::shared_ptr<const TriangleMesh> mesh, bool smooth,
                   std::size_t number) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  const bool turned = shape.flip_normals != (shape.to_world.determinant() < 0);  // mirrored, the front stays the front
  PovMesh placed{std::move(mesh), shape.to_world, turned, number, smooth, 0, Vec3d(inf), Vec3d(-inf)};
  for (const Vec3f& local : placed.mesh->positions) {
    const Vec3d p = shape.to_world.point(Vec3d(local));
    placed.low = {std::min(placed.low.x, p.x), std::min(placed.low.y, p.y), std::min(placed.low.z, p.z)};
    placed.high = {std::max(placed.high.x, p.x), std::max(placed.high.y, p.y), std::max(placed.high.z, p.z)};
  }
  for (std::size_t i = 0; i < placed.mesh->triangles.size(); ++i) {
    const auto [a, b, c] = placed.triangle(i);
    placed.area += length(cross(b - a, c - a)) / 2;
  }
  return placed;
}

namespace {

/// A normal on the same side of a surface that `t` moves: by the cofactors of its upper block, which need no inverse.
Vec3d turned_normal(const Transform& t, const Vec3d& n) {
  const Vec3d x = t.vector({1, 0, 0}), y = t.vector({0, 1, 0}), z = t.vector({0, 0, 1});
  const double side = t.determinant() < 0 ? -1 : 1;
  return normalize(cross(y, z) * n.x + cross(z, x) * n.y + cross(x, y) * n.z) * side;
}

void write_normals(const PovMesh& mesh, Buffered& out) {
  const std::vector<Vec3d> normals = vertex_normals(*mesh.mesh);
  out << "normal_vectors{" << std::uint64_t{normals.size()};
  out.end_line();
  for (const Vec3d& local : normals) {
    const Vec3f n(turned_normal(mesh.to_world, local));
    out << ",<" << n.x << "," << n.y << "," << n.z << ">";
    out.end_line();
  }
  out << "}";
  out.end_line();
}

}  // namespace

void write_mesh_declaration(const PovMesh& mesh, double scale, std::ostream& stream) {
  Buffered out(stream);
  out << "#declare Mesh_" << std::uint64_t{mesh.number} << " = mesh2{";
  out.end_line();
  out << "vertex_vectors{" << std::uint64_t{mesh.mesh->positions.size()};
  out.end_line();
  for (const Vec3f& local : mesh.mesh->positions) {
    const Vec3f p(mesh.to_world.point(Vec3d(local)) * scale);
    out << ",<" << p.x << "," << p.y << "," << p.z << ">";
    out.end_line();
  }
  out << "}";
  out.end_line();
  if (mesh.smooth) write_normals(mesh, out);
  out << "face_indices{" << std::uint64_t{mesh.mesh->triangles.size()};
  out.end_line();
  for (const auto& [a, b, c] : mesh.mesh->triangles) {
    // Clockwise seen from the front, other than polygons: it is the side that POV-Ray takes for a triangle's exterior.
    out << ",<" << std::uint64_t{a} << "," << std::uint64_t{mesh.flip ? b : c} << ","
        << std::uint64_t{mesh.flip ? c : b} << ">";
    out.end_line();
  }
  out << "}}";
  out.end_line();
}

}  // namespace photonproof::inline reference_povray
