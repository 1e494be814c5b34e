#include "renderer/scene/surface_detail.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "renderer/lanes/sampler.h"
#include "renderer/scene/mixed_mirrors.h"

namespace photonproof::inline renderer_scene {
namespace {

/// Component of v across the unit vector n, normalised; any such vector where there is none.
Vec3f perpendicular(const Vec3f& v, const Vec3f& n) {
  const Vec3f across = v - n * dot(n, v);
  const float norm = length(across);
  return norm > 0 && std::isfinite(norm) ? across / norm : any_tangents(n).s;
}

/// Descends from a surface's BSDF to a leaf.
class Descent {
 public:
  Descent(const DetailTables& tables, const LocalGeometry& at, const PlacedPoint* placed, const Vec3f& geometric_normal,
          const Vec3f& direction, float u, TransportMode mode)
      : tables_(tables),
        at_(at),
        placed_(placed),
        geometric_(geometric_normal),
        back_(-direction),
        mode_(mode),
        u_(u),
        u_flip_(to_unit<float>(mix_bits(std::bit_cast<std::uint32_t>(u)))),
        normal(at.normal) {}

  std::uint32_t leaf_of(std::uint32_t bsdf) {
    for (;;) {
      const BsdfNode& node = tables_.bsdfs.tree[bsdf];
      bsdf = node.first;
      switch (node.kind) {
        case BsdfNode::Kind::leaf:
          return static_cast<std::uint32_t>(&node - tables_.bsdfs.tree.data());
        case BsdfNode::Kind::two_sided:
          if (maps < 2) state |= Maps::faces[maps];
          if (dot(normal, back_) < 0) {
            turn();
            bsdf = node.second;
          }
          break;
        case BsdfNode::Kind::mask:
          if (!draw(number(node.number))) return tables_.bsdfs.nothing;
          break;
        case BsdfNode::Kind::blend:
          if (node.mixes_mirrors)
            bsdf = mixing(node);
          else if (is_diffuse(node.first) && is_diffuse(node.second))
            add_diffuse(node);
          else if (draw(number(node.number)))
            bsdf = node.second;
          break;
        case BsdfNode::Kind::bump:
          map(bumped(node.number), node);
          break;
        case BsdfNode::Kind::normal_map:
          map(mapped(node.number), node);
          break;
      }
    }
  }

 private:
  const DetailTables& tables_;
  const LocalGeometry& at_;
  const PlacedPoint* placed_;
  const Vec3f geometric_, back_;
  const TransportMode mode_;
  float u_;
  float u_flip_;  ///< uniform as well, and as good as independent of u
  bool turned_ = false;

 public:
  int maps = 0;
  Vec3f normal, below[2];
  float shadow[2] = {0, 0};
  std::uint32_t state = 0;
  float chance = 1;
  std::uint32_t mixed = no_index;  ///< the leaf that a mirror in a blend is mixed with (mixed_mirrors.h)
  float mixed_share = 0;           ///< the mirror's
  std::uint32_t added = no_index;  ///< another diffuse leaf, whose reflectance counts with the share below
  float added_share = 0;

 private:
  bool is_diffuse(std::uint32_t bsdf) const {
    return tables_.bsdfs.is_leaf(bsdf) && std::holds_alternative<DiffuseBsdf<float>>(tables_.bsdfs.records[bsdf]);
  }
  /// A blend of two diffuse leaves is one of the blended reflectance: nothing is drawn, and no noise is added.
  void add_diffuse(const BsdfNode& node) {
    added = node.second;
    added_share = number(node.number);
  }

  /// The drawn side of a blend. The other's leaf becomes `mixed`, if only twosided BSDFs wrap it.
  std::uint32_t mixing(const BsdfNode& node) {
    const float second = number(node.number);
    const bool drawn = draw(second);
    std::uint32_t other = drawn ? node.first : node.second;
    while (tables_.bsdfs.tree[other].kind == BsdfNode::Kind::two_sided)
      other = dot(normal, back_) < 0 ? tables_.bsdfs.tree[other].second : tables_.bsdfs.tree[other].first;
    mixed = tables_.bsdfs.is_leaf(other) ? other : no_index;
    mixed_share = drawn ? second : 1 - second;
    return drawn ? node.second : node.first;
  }

  void turn() {
    normal = -normal;
    for (int i = 0; i < maps; ++i) below[i] = -below[i];
    turned_ = !turned_;
    state ^= Maps::turned;
  }

  float number(const TexturedNumber& n) const {
    const float value = n.texture == no_index ? n.value : tables_.textures.number(n.texture, at_.uv, placed_);
    return std::clamp(value, 0.0f, 1.0f);
  }

  bool draw(float probability) { return draw_by(u_, probability); }

  /// True with that probability; the rest of u is uniform again.
  static bool draw_by(float& u, float probability) {
    const bool yes = u < probability;
    u = yes ? u / probability : (u - probability) / (1 - probability);
    u = std::min(u, 0x1.fffffep-1f);
    return yes;
  }

  /// The normal on the surface's front, for either visible side.
  Vec3f front() const { return turned_ ? -normal : normal; }

  /// Normal of the surface displaced along its normal (Blinn 1978).
  Vec3f bumped(const TexturedNumber& height) const {
    const Vec3f n = front();
    const Vec2<float> slope = tables_.textures.gradient(height.texture, at_.uv);
    // cross(du + n a, dv + n b) with du and dv perpendicular to n, term by term: in the sums steep slopes would drown
    // the tangential part. It is divided by the steeper slope, whose square may exceed single precision.
    const Vec3f du = at_.dp_du - n * dot(n, at_.dp_du), dv = at_.dp_dv - n * dot(n, at_.dp_dv);
    constexpr float most = std::numeric_limits<float>::max();
    const float a = std::clamp(height.value * slope.x, -most, most),
                b = std::clamp(height.value * slope.y, -most, most);
    const float unit = std::max({1.0f, std::abs(a), std::abs(b)});
    const Vec3f displaced = cross(du, dv) / unit + cross(du, n) * (b / unit) + cross(n, dv) * (a / unit);
    return dot(displaced, geometric_) < 0 ? -displaced : displaced;
  }

  Vec3f mapped(const TexturedNumber& map) const {
    const Vec3f n = front();
    const Vec3f s = perpendicular(at_.dp_du, n);
    const Rgb rgb = tables_.textures.colour(map.texture, at_.uv, placed_);
    return s * (2 * rgb.x - 1) + cross(n, s) * (2 * rgb.y - 1) + n * (2 * rgb.z - 1);
  }

  /// Seen from behind, a twosided surface is its front's mirror image.
  void map(const Vec3f& of_front, const BsdfNode& node) {
    const float norm = length(of_front);
    if (!(norm > 0) || !std::isfinite(norm)) return;
    const Vec3f n = of_front / norm;
    const Vec3f under = normal;
    const Vec3f shown = turned_ ? n - under * (2 * dot(n, under)) : n;
    const float tilt = dot(shown, under);
    const auto k = static_cast<std::size_t>(maps);
    below[k] = under;
    normal = shown;
    if (node.shadows) {
      const float cos2 = tilt * tilt;
      shadow[k] = cos2 > 0 ? std::min(0.125f * std::max(1 - cos2, 0.0f) / cos2, 1.0f) : 1;
    }
    if (node.flips) {
      state |= Maps::flips[k];
      // The mirrored normal is seen by (1 - cos) / 2 of the light that leaves a Lambertian surface, and from the angle
      // over pi of all directions above. A chance in between is never far too small for light paths of any BSDF kind.
      const float chance_to_flip = 0.25f * (1 - tilt + std::sqrt(std::max(1 - tilt * tilt, 0.0f)));
      const bool flip = mode_ == TransportMode::importance ? draw_by(u_flip_, chance_to_flip)
                                                           : !(dot(under, back_) * dot(shown, back_) > 0);
      chance *= flip ? chance_to_flip : 1 - chance_to_flip;
      if (flip) {
        state |= Maps::flipped[k];
        normal = under * (2 * tilt) - shown;
      }
    }
    ++maps;
  }

  using Maps = MappedNormals<float>;
};

void copy_record(const SceneView& scene, std::uint32_t bsdf, float* record) {
  std::memcpy(record, scene.bsdfs + std::size_t{bsdf} * BsdfKinds::stride, BsdfKinds::stride * sizeof(float));
}

/// The leaf's record with the textures' values.
void fill_record(const SceneView& scene, std::uint32_t leaf, const LocalGeometry& at, const PlacedPoint* placed,
                 float* record) {
  copy_record(scene, leaf, record);
  const Textures& textures = scene.detail->textures;
  for (const TextureSlot& slot : scene.detail->bsdfs.tree[leaf].slots) {
    if (slot.is_colour) {
      const Rgb colour = textures.colour(slot.texture, at.uv, placed);
      std::memcpy(&record[slot.word], &colour, sizeof colour);
    } else {
      record[slot.word] = textures.number(slot.texture, at.uv, placed);
    }
  }
}

/// Blends the reflectance of a diffuse leaf with another's.
void add_diffuse(const SceneView& scene, const Descent& descent, const LocalGeometry& at, const PlacedPoint* placed,
                 float* record) {
  float other[BsdfKinds::stride];
  fill_record(scene, descent.added, at, placed, other);
  for (int channel = 0; channel < 3; ++channel)
    record[channel] += (other[channel] - record[channel]) * descent.added_share;
}

/// Weights a mirror of a blend against the other leaf.
void mix(const SceneView& scene, const Descent& descent, const LocalGeometry& at, const PlacedPoint* placed,
         const Vec3f& direction, SurfaceDetail& detail) {
  float other[BsdfKinds::stride];
  fill_record(scene, descent.mixed, at, placed, other);
  const Frame<float> frame(detail.normal, perpendicular(at.dp_du, detail.normal));
  mix_mirror(detail.kind, detail.record, descent.mixed_share, scene.detail->bsdfs.kind(descent.mixed), other,
             frame.to_local(-direction));
}

}  // namespace

Scattering<float> scattering_at(const SceneView& scene, const SurfaceDetail& detail, const Vec3f& normal) {
  const bool has_tangent = dot(detail.tangent, detail.tangent) > 0;
  Scattering<float> s{has_tangent ? Frame<float>(detail.normal, detail.tangent) : Frame<float>(detail.normal)};
  s.bent = scene.bends_normals;
  s.mapped = scene.maps_normals;
  s.ng = s.frame.to_local(normal);
  s.maps = {{s.frame.to_local(detail.below[0]), s.frame.to_local(detail.below[1])},
            {detail.shadow[0], detail.shadow[1]},
            detail.state,
            detail.chance};
  return s;
}

LocalGeometry DetailTables::local(std::uint32_t surface, std::uint32_t primitive, const Vec3f& p,
                                  const Vec3f& normal) const {
  const Surface& s = surfaces[surface];
  const AffineMap* frame = s.uv_frame != no_index ? &uv_frames[s.uv_frame] : nullptr;
  return local_geometry(s, frame, triangles != nullptr ? triangles[primitive] : primitive, p, normal);
}

PlacedPoint DetailTables::placed_point(std::uint32_t surface, std::uint32_t primitive, const Vec3f& p) const {
  const Mesh* mesh = mesh_of(surfaces[surface].geometry);
  if (mesh == nullptr) return {p, nullptr};
  const std::uint32_t triangle = triangles != nullptr ? triangles[primitive] : primitive;
  const Vec2<float> b = barycentric(surfaces[surface], triangle, p);
  return {p, mesh->source.get(), triangle, b.x, b.y};
}

void detail_at(const SceneView& scene, std::uint32_t surface, std::uint32_t primitive, const Vec3f& p,
               const Vec3f& normal, const Vec3f& direction, float u, TransportMode mode, SurfaceDetail& detail) {
  const DetailTables& tables = *scene.detail;
  detail.surface = surface;
  if (tables.plain[surface] != 0) {
    detail.normal = detail.below[0] = detail.below[1] = normal;
    detail.shadow[0] = detail.shadow[1] = 0;
    detail.state = 0;
    detail.chance = 1;
    detail.tangent = Vec3f(0.0f);
    detail.bsdf = scene.surfaces[surface].bsdf;
    detail.kind = tables.bsdfs.kind(detail.bsdf);
    copy_record(scene, detail.bsdf, detail.record);
    return;
  }
  const LocalGeometry at = tables.local(surface, primitive, p, normal);
  std::optional<PlacedPoint> point;
  if (tables.textures.need_place()) point = tables.placed_point(surface, primitive, p);
  const PlacedPoint* placed = point ? &*point : nullptr;
  Descent descent(tables, at, placed, normal, direction, u, mode);
  detail.bsdf = descent.leaf_of(scene.surfaces[surface].bsdf);
  detail.kind = tables.bsdfs.kind(detail.bsdf);
  detail.normal = descent.normal;
  for (int map = 0; map < 2; ++map) {
    detail.below[map] = map < descent.maps ? descent.below[map] : descent.normal;
    detail.shadow[map] = descent.shadow[map];
  }
  detail.state = descent.state;
  detail.chance = descent.chance;
  detail.surface |= (descent.state & ((1u << MappedNormals<float>::tag_bits) - 1)) << PhotonSurface::number_bits;
  fill_record(scene, detail.bsdf, at, placed, detail.record);
  if (descent.added != no_index) add_diffuse(scene, descent, at, placed, detail.record);
  const bool has_directions = tables.bsdfs.tree[detail.bsdf].has_directions;
  detail.tangent = has_directions ? perpendicular(at.dp_du, detail.normal) : Vec3f(0.0f);
  if (descent.mixed != no_index) mix(scene, descent, at, placed, direction, detail);
}

}  // namespace photonproof::inline renderer_scene
