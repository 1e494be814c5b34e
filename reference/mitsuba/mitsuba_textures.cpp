// Textures for Mitsuba: every image becomes a linear EXR, and patterns that it lacks become images.
#include <algorithm>
#include <string>
#include <variant>

#include "reference/mitsuba/mitsuba_lowering.h"
#include "scenes/description/overloaded.h"

namespace photonproof::inline reference_mitsuba {
namespace {

/// A pattern that Mitsuba has: an image, or values of a mesh.
using Pattern = decltype(TextureDescription::pattern);

class Textures {
 public:
  explicit Textures(MitsubaLowering& lowering) : lowering_(lowering), scene_(lowering.scene()) {}

  Pattern lower(const TextureDescription& texture) const {
    return std::visit([&](const auto& pattern) { return lower(texture, pattern); }, texture.pattern);
  }

 private:
  Pattern lower(const TextureDescription&, BitmapDescription bitmap) const {
    bitmap.raw = false;  // linear already
    return bitmap;
  }

  /// Two by two texels. Mitsuba's checkerboard has colours up to 1 only, and swaps them where it is read as a number.
  Pattern lower(const TextureDescription& texture, const CheckerboardDescription& board) const {
    const auto *a = std::get_if<RgbD>(&board.color0), *b = std::get_if<RgbD>(&board.color1);
    if (!a || !b) lowering_.refuse(texture.loc, "a checkerboard whose colours are textures: not written yet");
    lowering_.explain("checkerboard of " + scene_.where(texture.loc) + ": an image of 2 x 2 texels");
    auto image = std::make_shared<Image>(2, 2);
    for (int y = 0; y < 2; ++y)
      for (int x = 0; x < 2; ++x) {
        const RgbD& c = x == y ? *a : *b;
        float* rgb = image->pixel(x, y);
        rgb[0] = static_cast<float>(c.x), rgb[1] = static_cast<float>(c.y), rgb[2] = static_cast<float>(c.z);
      }
    BitmapDescription bitmap;
    bitmap.image = image;
    bitmap.filter = TextureFilter::nearest;
    bitmap.to_uv = board.to_uv;
    return bitmap;
  }

  Pattern lower(const TextureDescription& texture, const ScaledTextureDescription& scaled) const {
    Pattern inner = lower(scene_.textures[scaled.texture.value]);
    const RgbD& s = scaled.scale;
    if (auto* bitmap = std::get_if<BitmapDescription>(&inner)) {
      lowering_.explain("scale of " + scene_.where(texture.loc) + ": a copy of the image, multiplied");
      auto image = std::make_shared<Image>(*bitmap->image);
      const double factors[3] = {s.x, s.y, s.z};
      for (std::size_t i = 0; i < image->rgb.size(); ++i)
        image->rgb[i] = static_cast<float>(double{image->rgb[i]} * factors[i % 3]);
      bitmap->image = image;
      return inner;
    }
    auto* attribute = std::get_if<MeshAttributeDescription>(&inner);
    if (!attribute || s.x != s.y || s.y != s.z)
      lowering_.refuse(texture.loc, "a scale by a colour of a texture other than an image: Mitsuba has none");
    attribute->scale *= s.x;
    return inner;
  }

  static Pattern lower(const TextureDescription&, const MeshAttributeDescription& attribute) { return attribute; }

  Pattern lower(const TextureDescription& texture, const VolumeTextureDescription&) const {
    lowering_.refuse(texture.loc, "a volume as a texture: not written yet");
  }

  MitsubaLowering& lowering_;
  const SceneDescription& scene_;
};

}  // namespace

void lower_textures(MitsubaLowering& lowering) {
  const Textures textures(lowering);
  for (std::size_t i = 0; i < lowering.scene().textures.size(); ++i) {
    Pattern pattern = textures.lower(lowering.scene().textures[i]);
    if (auto* bitmap = std::get_if<BitmapDescription>(&pattern)) bitmap->filename = lowering.file_of(bitmap->image);
    lowering.lowered().textures[i].pattern = std::move(pattern);
  }
}

}  // namespace photonproof::inline reference_mitsuba
