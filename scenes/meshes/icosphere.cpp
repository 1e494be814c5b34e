#include "scenes/meshes/icosphere.h"

#include <map>
#include <utility>

namespace photonproof::inline scenes_meshes {
namespace {

using Triangle = TriangleMesh::Triangle;

Icosphere icosahedron() {
  // The corners of three golden rectangles; numbered so that consecutive signs and axes give these faces.
  const double g = (1 + std::sqrt(5.0)) / 2;
  Icosphere ball;
  for (const Vec3d& p :
       {Vec3d{-1, g, 0}, Vec3d{1, g, 0}, Vec3d{-1, -g, 0}, Vec3d{1, -g, 0}, Vec3d{0, -1, g}, Vec3d{0, 1, g},
        Vec3d{0, -1, -g}, Vec3d{0, 1, -g}, Vec3d{g, 0, -1}, Vec3d{g, 0, 1}, Vec3d{-g, 0, -1}, Vec3d{-g, 0, 1}})
    ball.directions.push_back(normalize(p));
  ball.triangles = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                    {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                    {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  return ball;
}

/// The vertex halfway between two others, shared by the triangles on both sides of their edge.
class Midpoints {
 public:
  explicit Midpoints(std::vector<Vec3d>& directions) : directions_(directions) {}
  std::uint32_t between(std::uint32_t a, std::uint32_t b) {
    const auto [known, is_new] = made_.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(directions_.size()));
    if (is_new) directions_.push_back(normalize(directions_[a] + directions_[b]));
    return known->second;
  }

 private:
  std::vector<Vec3d>& directions_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> made_;
};

}  // namespace

Icosphere make_icosphere(int level) {
  Icosphere ball = icosahedron();
  for (; level > 0; --level) {
    Midpoints midpoints(ball.directions);
    std::vector<Triangle> finer;
    finer.reserve(4 * ball.triangles.size());
    for (const auto& [a, b, c] : ball.triangles) {
      const std::uint32_t ab = midpoints.between(a, b), bc = midpoints.between(b, c), ca = midpoints.between(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
    }
    ball.triangles = std::move(finer);
  }
  return ball;
}

}  // namespace photonproof::inline scenes_meshes
