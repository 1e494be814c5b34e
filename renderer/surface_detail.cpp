#include "renderer/surface_detail.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace photonproof {
namespace {

/// Component of v across the unit vector n, normalised; any such vector where there is none.
Vec3f perpendicular(const Vec3f& v, const Vec3f& n) {
  const Vec3f across = v - n * dot(n, v);
  const float norm = length(across);
  return norm > 0 && std::isfinite(norm) ? across / norm : any_tangents(n).s;
}

/// Works its way from a surface's BSDF down to a leaf.
class Descent {
 public:
  Descent(const DetailTables& tables, const LocalGeometry& at, const Vec3f& geometric_normal, const Vec3f& direction,
          float u)
      : tables_(tables),
        at_(at),
        geometric_(geometric_normal),
        direction_(direction),
        u_(u),
        normal(at.normal),
        side(at.normal) {}

  std::uint32_t leaf_of(std::uint32_t bsdf) {
    for (;;) {
      const BsdfNode& node = tables_.tree[bsdf];
      bsdf = node.first;
      switch (node.kind) {
        case BsdfNode::Kind::leaf:
          return static_cast<std::uint32_t>(&node - tables_.tree.data());
        case BsdfNode::Kind::two_sided:
          if (dot(normal, direction_) > 0) {
            turn();
            bsdf = node.second;
          }
          break;
        case BsdfNode::Kind::mask:
          if (!draw(number(node.number))) return tables_.nothing;
          break;
        case BsdfNode::Kind::blend:
          if (draw(number(node.number))) bsdf = node.second;
          break;
        case BsdfNode::Kind::bump:
          map(bumped(node.number));
          break;
        case BsdfNode::Kind::normal_map:
          map(mapped(node.number));
          break;
      }
    }
  }

 private:
  const DetailTables& tables_;
  const LocalGeometry& at_;
  const Vec3f geometric_, direction_;
  float u_;
  bool turned_ = false;

 public:
  Vec3f normal, side;

 private:
  void turn() {
    normal = -normal;
    side = -side;
    turned_ = !turned_;
  }

  float number(const TexturedNumber& n) const {
    const float value = n.texture == no_index ? n.value : tables_.textures.number(n.texture, at_.uv);
    return std::clamp(value, 0.0f, 1.0f);
  }

  /// True with that probability; what is left of u is uniform again.
  bool draw(float probability) {
    const bool yes = u_ < probability;
    u_ = yes ? u_ / probability : (u_ - probability) / (1 - probability);
    u_ = std::min(u_, 0x1.fffffep-1f);
    return yes;
  }

  /// The normal as the surface has it in front, whatever side is seen.
  Vec3f front() const { return turned_ ? -normal : normal; }

  /// Of the surface displaced along its normal (Blinn 1978).
  Vec3f bumped(const TexturedNumber& height) const {
    const Vec3f n = front();
    const Vec2<float> slope = tables_.textures.gradient(height.texture, at_.uv);
    const Vec3f du = at_.dp_du + n * (height.value * slope.x - dot(n, at_.dp_du));
    const Vec3f dv = at_.dp_dv + n * (height.value * slope.y - dot(n, at_.dp_dv));
    const Vec3f displaced = cross(du, dv);
    return dot(displaced, geometric_) < 0 ? -displaced : displaced;
  }

  Vec3f mapped(const TexturedNumber& map) const {
    const Vec3f n = front();
    const Vec3f s = perpendicular(at_.dp_du, n);
    const Rgb rgb = tables_.textures.colour(map.texture, at_.uv);
    return s * (2 * rgb.x - 1) + cross(n, s) * (2 * rgb.y - 1) + n * (2 * rgb.z - 1);
  }

  /// Seen from behind, a twosided surface is its front's mirror image.
  void map(const Vec3f& of_front) {
    const float norm = length(of_front);
    if (!(norm > 0) || !std::isfinite(norm)) return;
    const Vec3f n = of_front / norm;
    normal = turned_ ? n - normal * (2 * dot(n, normal)) : n;
  }
};

void copy_record(const SceneView& scene, std::uint32_t bsdf, float* record) {
  std::memcpy(record, scene.bsdfs + std::size_t{bsdf} * BsdfKinds::stride, BsdfKinds::stride * sizeof(float));
}

}  // namespace

LocalGeometry DetailTables::local(std::uint32_t surface, std::uint32_t primitive, const Vec3f& p,
                                  const Vec3f& normal) const {
  const Surface& s = surfaces[surface];
  const AffineMap* frame = s.uv_frame != no_index ? &uv_frames[s.uv_frame] : nullptr;
  return local_geometry(s, frame, triangles != nullptr ? triangles[primitive] : primitive, p, normal);
}

void detail_at(const SceneView& scene, std::uint32_t surface, std::uint32_t primitive, const Vec3f& p,
               const Vec3f& normal, const Vec3f& direction, float u, SurfaceDetail& detail) {
  const DetailTables& tables = *scene.detail;
  detail.surface = surface;
  if (tables.plain[surface] != 0) {
    detail.normal = detail.side = normal;
    detail.tangent = Vec3f(0.0f);
    detail.bsdf = scene.surfaces[surface].bsdf;
    detail.kind = tables.kinds[detail.bsdf];
    copy_record(scene, detail.bsdf, detail.record);
    return;
  }
  const LocalGeometry at = tables.local(surface, primitive, p, normal);
  Descent descent(tables, at, normal, direction, u);
  detail.bsdf = descent.leaf_of(scene.surfaces[surface].bsdf);
  detail.kind = tables.kinds[detail.bsdf];
  detail.normal = descent.normal;
  detail.side = descent.side;
  copy_record(scene, detail.bsdf, detail.record);
  const BsdfNode& leaf = tables.tree[detail.bsdf];
  detail.tangent = leaf.has_directions ? perpendicular(at.dp_du, detail.normal) : Vec3f(0.0f);
  for (const TextureSlot& slot : leaf.slots) {
    if (slot.is_colour) {
      const Rgb colour = tables.textures.colour(slot.texture, at.uv);
      std::memcpy(&detail.record[slot.word], &colour, sizeof colour);
    } else {
      detail.record[slot.word] = tables.textures.number(slot.texture, at.uv);
    }
  }
}

}  // namespace photonproof
