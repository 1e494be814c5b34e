// Textures of the compiled scene: bitmaps and checkerboards over uv, attributes of meshes, volumes. Meaning as in
// Mitsuba 3.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "renderer/core/ray.h"
#include "renderer/textures/volume.h"
#include "scenes/description/description.h"

namespace photonproof::inline renderer_textures {

/// The part of a transform that moves uv: columns of the linear part and the translation.
struct UvTransform {
  Vec2<float> along_u{1, 0}, along_v{0, 1}, moved;
  /// The transform for a texture that repeats itself after `period`; 0: it does not.
  UvTransform(const Transform& to_uv, double period);
  Vec2<float> apply(const Vec2<float>& uv) const {
    return {along_u.x * uv.x + along_v.x * uv.y + moved.x, along_u.y * uv.x + along_v.y * uv.y + moved.y};
  }
};

/// An image over the unit square of uv, linear between the middles of its texels or constant on them.
class BitmapTexture {
 public:
  explicit BitmapTexture(const BitmapDescription& description);
  Rgb at(const Vec2<float>& uv) const;
  /// The derivative of the luminance of `factor` times the colour, piecewise linear; 0 without interpolation, as in
  /// Mitsuba.
  Vec2<float> gradient(const Vec2<float>& uv, const Rgb& factor = Rgb(1.0f)) const;
  Vec2<int> resolution() const { return {image_->width, image_->height}; }
  std::size_t bytes() const { return image_->rgb.capacity() * sizeof(float); }

 private:
  /// The four texels around a point and where it lies between them.
  struct Corners {
    Rgb c00, c10, c01, c11;
    float x, y;
  };
  Corners corners(const Vec2<float>& uv) const;
  Rgb texel(int x, int y) const;
  Vec2<float> in_texels(const Vec2<float>& uv) const;

  std::shared_ptr<const Image> image_;
  TextureFilter filter_;
  TextureWrap wrap_;
  UvTransform to_uv_;
};

/// A point of a surface. On a mesh it is that of a triangle, by its barycentric coordinates of the second and third
/// corner.
struct PlacedPoint {
  Vec3f p;                     ///< in the frame of rays
  const TriangleMesh* mesh;    ///< null where the surface is no mesh
  std::uint32_t triangle = 0;  ///< and the next: of a mesh
  float b1 = 0, b2 = 0;
};

/// All textures of a scene, by the description's indices.
class Textures {
 public:
  explicit Textures(const std::vector<TextureDescription>& descriptions, const VolumeFrame& frame = {});

  /// `placed` is the same point for textures that need one; without it, mesh attributes and volumes are 0.
  Rgb colour(std::uint32_t texture, const Vec2<float>& uv, const PlacedPoint* placed = nullptr) const;
  /// The colour's luminance (Rec. 709), as Mitsuba converts a colour to a number.
  float number(std::uint32_t texture, const Vec2<float>& uv, const PlacedPoint* placed = nullptr) const;
  /// Derivatives of `number` by u and v; 0 where it jumps.
  Vec2<float> gradient(std::uint32_t texture, const Vec2<float>& uv) const;
  std::size_t bytes() const;

  /// Whether a texture of the scene needs a PlacedPoint.
  bool need_place() const { return has_mesh_attributes_ || has_volumes_; }
  bool has_mesh_attributes() const { return has_mesh_attributes_; }
  /// Whether the texture, or one within it, is a volume.
  bool shows_volume(std::uint32_t texture) const;
  /// Calls `visit` for every mesh attribute that a texture shows, with the factor of its values.
  void visit_attributes(std::uint32_t texture,
                        const std::function<void(const MeshAttributeDescription&, const Rgb& factor)>& visit) const;
  /// Width and height in texels; 1 where there are none.
  Vec2<int> resolution(std::uint32_t texture) const;

 private:
  Vec2<float> gradient(std::uint32_t texture, const Vec2<float>& uv, const Rgb& factor) const;

  struct Colour2 {
    Rgb value;
    std::uint32_t texture = no_index;
  };
  struct Checkerboard {
    Colour2 colours[2];
    UvTransform to_uv;
  };
  struct Scaled {
    std::uint32_t texture;
    Rgb factor;
  };
  static Colour2 compile(const Colour& colour);
  /// The colour of a checkerboard's square.
  static const Colour2& square(const Checkerboard& board, const Vec2<float>& uv);

  std::vector<std::variant<BitmapTexture, Checkerboard, MeshAttributeDescription, Scaled, Volume>> textures_;
  bool has_mesh_attributes_ = false, has_volumes_ = false;
};

}  // namespace photonproof::inline renderer_textures
