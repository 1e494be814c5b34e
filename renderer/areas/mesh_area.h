// The counterpart of disc_area (shape.h) for triangle meshes: the area of the mesh within the gather radius whose
// photons pass the surface side's test. It is a balanced tree over the triangles. Nodes have their bounds, their area
// and a cone of their normals, so that a gather accepts or rejects most nodes whole; triangles on the border are
// clipped.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "renderer/core/parallel.h"
#include "renderer/shapes/surface.h"

namespace photonproof::inline renderer_areas {

class MeshArea {
 public:
  /// `mesh` must outlive this. The same at any number of threads.
  MeshArea(const Mesh& mesh, const Threads& threads);

  /// The area for a gather at p of the mesh's own space with the unit front normal there. It is exact except for
  /// triangles, and groups of them, that are smaller than a quarter of the radius. On the border these count whole
  /// where their middle is within; groups that are not flat count by a sample of eight triangles, drawn by p. Both are
  /// right in the mean.
  double within(const Vec3f& p, const Vec3f& front_normal, float radius) const;

  /// The same in world space, where `placement` puts the mesh.
  double within(const AffineMap& placement, const Vec3f& p, const Vec3f& front_normal, float radius) const;

  std::size_t triangle_count() const { return mesh_.triangle_count(); }
  std::size_t memory_bytes() const;

 private:
  struct Item {
    Vec3f middle;
    std::uint32_t triangle = 0;
    Vec3f front;  ///< side_normal, not unit
    float area = 0;
    float reach = 0;  ///< largest distance of its corners from the middle
  };
  struct Node {
    Vec3f low, high;
    float area = 0;
    Vec3f axis;        ///< axis of the cone that holds the triangles' normals, unit
    float cosine = 1;  ///< cosine of the cone's half angle; below 0 where it is unknown
    float sine = 0;    ///< sine of the half angle
  };
  static constexpr std::size_t most_in_leaf = 8;
  /// Items, each member of all of them in a row. Unused items have no front, and so never count.
  struct Leaf {
    std::size_t count = 0;
    std::array<float, most_in_leaf> x{}, y{}, z{}, front_x{}, front_y{}, front_z{}, area{}, reach{};
    std::array<std::uint32_t, most_in_leaf> triangle{};
  };
  struct Gather;

  std::size_t begin_of(int level, std::size_t k) const { return (items_.size() * k) >> level; }
  void cut_subtree(int level, std::size_t k);
  void bound(int level, std::size_t k);
  void fill(std::size_t leaf);
  double visit(const Gather& at, int level, std::size_t k) const;
  double sample(const Gather& at, int level, std::size_t k) const;
  double visit_leaf(const Gather& at, const Leaf& leaf) const;

  const Mesh& mesh_;
  int leaf_level_ = 0;
  std::vector<Item> items_;  ///< triangles with an area, leaf after leaf; none once the tree is made
  std::vector<Leaf> leaves_;
  std::vector<Node> nodes_;  ///< node k of a level is 2^level + k; the children of n are 2n and 2n + 1
};

}  // namespace photonproof::inline renderer_areas
