// Textures as a scene file states them, and the indices by which parts of a description refer to each other.
#pragma once

#include <compare>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <variant>

#include "scenes/base/input_error.h"
#include "scenes/base/vec.h"
#include "scenes/description/param_type.h"
#include "scenes/description/texture_wrap.h"
#include "scenes/description/transform.h"
#include "scenes/description/volume_description.h"
#include "scenes/images/image.h"

namespace photonproof::inline scenes_description {

/// A typed index into one of SceneDescription's tables.
template <class Tag>
struct Index {
  std::uint32_t value = 0;
  friend auto operator<=>(const Index&, const Index&) = default;
};

using BsdfIndex = Index<struct BsdfTag>;
using TextureIndex = Index<struct TextureTag>;
using MediumIndex = Index<struct MediumTag>;
using ShapeGroupIndex = Index<struct ShapeGroupTag>;

/// A colour, or the texture that gives one at every point.
using Colour = std::variant<RgbD, TextureIndex>;
/// A number, or the texture whose luminance (Rec. 709) gives one at every point.
using Scalar = std::variant<double, TextureIndex>;

/// The value of a colour that is not a texture.
inline const RgbD& constant(const Colour& colour) { return std::get<RgbD>(colour); }

/// An image over the unit square of uv; its first row is at v = 0, as in Mitsuba.
struct BitmapDescription {
  std::string filename;                ///< as the scene spells it
  std::shared_ptr<const Image> image;  ///< never null, linear; shared by the textures that name the same file
  bool raw = false;                    ///< 8-bit values are numbers, not sRGB
  TextureFilter filter = TextureFilter::bilinear;
  TextureWrap wrap = TextureWrap::repeat;
  Transform to_uv;  ///< applied to uv before evaluation; its x and y rows count
  friend bool operator==(const BitmapDescription& a, const BitmapDescription& b) {
    return a.filename == b.filename && a.raw == b.raw && a.filter == b.filter && a.wrap == b.wrap && a.to_uv == b.to_uv;
  }
};

template <class P>
void describe(P& p, BitmapDescription& d) {
  p.plugin("bitmap", "an image over the unit square of uv, its first row at v = 0");
  p.file("filename", d.filename, "the name of an image");
  p.boolean("raw", d.raw, "8-bit values are numbers, not sRGB");
  p.choice("filter_type", d.filter, {{"bilinear", TextureFilter::bilinear}, {"nearest", TextureFilter::nearest}},
           "between texels");
  p.choice("wrap_mode", d.wrap,
           {{"repeat", TextureWrap::repeat}, {"mirror", TextureWrap::mirror}, {"clamp", TextureWrap::clamp}},
           "beyond the unit square");
  p.transform("to_uv", d.to_uv, "applied to uv before the lookup");
}

/// Two alternating colours on squares of half a unit of uv: color0 where both halves agree.
struct CheckerboardDescription {
  Colour color0 = RgbD(0.4), color1 = RgbD(0.2);
  Transform to_uv;
  friend bool operator==(const CheckerboardDescription&, const CheckerboardDescription&) = default;
};

template <class P>
void describe(P& p, CheckerboardDescription& d) {
  p.plugin("checkerboard", "squares of half a unit of uv");
  p.colour_map("color0", d.color0, scene_xml::kNotNegative, "where both halves agree");
  p.colour_map("color1", d.color1, scene_xml::kNotNegative, "elsewhere");
  p.transform("to_uv", d.to_uv, "applied to uv before the lookup");
}

/// The attribute of this name of the mesh that has the texture (TriangleMesh::attributes).
struct MeshAttributeDescription {
  std::string name;  ///< begins with vertex_ or face_
  double scale = 1;
  friend bool operator==(const MeshAttributeDescription&, const MeshAttributeDescription&) = default;
};

template <class P>
void describe(P& p, MeshAttributeDescription& d) {
  p.plugin("mesh_attribute", "values of a PLY file's vertices, linear between them, or of its faces");
  p.text("name", d.name, "vertex_NAME or face_NAME");
  p.number("scale", d.scale, scene_xml::kNotNegative, "factor of the values");
}

/// Another texture times a colour.
struct ScaledTextureDescription {
  TextureIndex texture;
  RgbD scale = RgbD(1.0);
  friend bool operator==(const ScaledTextureDescription&, const ScaledTextureDescription&) = default;
};

template <class P>
void describe(P& p, ScaledTextureDescription& d) {
  p.plugin("scale", "extension: another texture times a colour, from Mitsuba 0.6");
  p.colour("scale", d.scale, scene_xml::kNotNegative, "a colour or a number");
  p.nested_texture(d.texture, "the other texture");
}

/// A volume at the positions of hits, in the world.
struct VolumeTextureDescription {
  VolumeColour volume = RgbD(1.0);
  friend bool operator==(const VolumeTextureDescription&, const VolumeTextureDescription&) = default;
};

template <class P>
void describe(P& p, VolumeTextureDescription& d) {
  p.plugin("volume", "a volume at the hit's position; not for bump maps, heightfields and lights");
  p.require("volume", "a volume");
  p.volume("volume", d.volume, scene_xml::kNotNegative, "values in the world's space");
}

struct TextureDescription {
  SourceLoc loc;
  std::string id;  ///< empty when unnamed
  std::variant<BitmapDescription, CheckerboardDescription, MeshAttributeDescription, ScaledTextureDescription,
               VolumeTextureDescription>
      pattern;
};

}  // namespace photonproof::inline scenes_description
