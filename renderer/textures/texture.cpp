#include "renderer/textures/texture.h"

#include <algorithm>
#include <cmath>

#include "scenes/base/numeric_faults.h"
#include "scenes/description/overloaded.h"

namespace photonproof::inline renderer_textures {
namespace {

float luminance(const Rgb& c) { return 0.212671f * c.x + 0.715160f * c.y + 0.072169f * c.z; }

/// The attribute of the mesh at the point; 0 if it has none of that name. There are few, so that they are searched.
Rgb attribute_at(const std::string& name, const PlacedPoint& at) {
  for (const MeshAttribute& attribute : at.mesh->attributes) {
    if (attribute.name != name) continue;
    if (!attribute.per_vertex()) return attribute.values[at.triangle];
    const TriangleMesh::Triangle& corners = at.mesh->triangles[at.triangle];
    return attribute.values[corners[0]] * (1 - at.b1 - at.b2) + attribute.values[corners[1]] * at.b1 +
           attribute.values[corners[2]] * at.b2;
  }
  return Rgb(0.0f);
}

/// The texel for number i of a row of n.
int wrapped(int i, int n, TextureWrap wrap) {
  if (wrap == TextureWrap::clamp) return std::clamp(i, 0, n - 1);
  const int turn = i >= 0 ? i / n : -((n - 1 - i) / n);
  const int within = i - turn * n;
  return wrap == TextureWrap::mirror && turn % 2 != 0 ? n - 1 - within : within;
}

/// An equivalent coordinate, small enough to be counted in texels.
float reduced(float t, TextureWrap wrap) {
  if (!std::isfinite(t)) return 0;
  if (wrap == TextureWrap::clamp) return std::clamp(t, -1.0f, 2.0f);
  const float period = wrap == TextureWrap::mirror ? 2 : 1;
  return t - period * std::floor(t / period);
}

/// Removes whole periods, which far from the origin would cost the texels their precision; 0: there is no period.
float without_far_periods(double moved, double period) {
  constexpr double far = 64;
  if (has_fault(NumericFault::far_periods)) return static_cast<float>(moved);
  if (period > 0 && std::abs(moved) > far && std::isfinite(moved)) moved -= period * std::floor(moved / period);
  return static_cast<float>(moved);
}

double period_of(TextureWrap wrap) {
  if (wrap == TextureWrap::clamp) return 0;
  return wrap == TextureWrap::mirror ? 2 : 1;
}

}  // namespace

UvTransform::UvTransform(const Transform& to_uv, double period)
    : along_u{static_cast<float>(to_uv.m[0]), static_cast<float>(to_uv.m[4])},
      along_v{static_cast<float>(to_uv.m[1]), static_cast<float>(to_uv.m[5])},
      moved{without_far_periods(to_uv.m[3], period), without_far_periods(to_uv.m[7], period)} {}

BitmapTexture::BitmapTexture(const BitmapDescription& d)
    : image_(d.image), filter_(d.filter), wrap_(d.wrap), to_uv_(d.to_uv, period_of(d.wrap)) {}

Rgb BitmapTexture::texel(int x, int y) const {
  const float* rgb = image_->pixel(wrapped(x, image_->width, wrap_), wrapped(y, image_->height, wrap_));
  return {rgb[0], rgb[1], rgb[2]};
}

Vec2<float> BitmapTexture::in_texels(const Vec2<float>& uv) const {
  const Vec2<float> at = to_uv_.apply(uv);
  return {reduced(at.x, wrap_) * static_cast<float>(image_->width),
          reduced(has_fault(Fault::flipped_v) ? 1 - at.y : at.y, wrap_) * static_cast<float>(image_->height)};
}

BitmapTexture::Corners BitmapTexture::corners(const Vec2<float>& uv) const {
  const Vec2<float> at = in_texels(uv);
  const float left = std::floor(at.x - 0.5f), top = std::floor(at.y - 0.5f);
  const int x = static_cast<int>(left), y = static_cast<int>(top);
  return {texel(x, y), texel(x + 1, y), texel(x, y + 1), texel(x + 1, y + 1), at.x - 0.5f - left, at.y - 0.5f - top};
}

Rgb BitmapTexture::at(const Vec2<float>& uv) const {
  if (filter_ == TextureFilter::nearest) {
    const Vec2<float> at = in_texels(uv);
    return texel(static_cast<int>(std::floor(at.x)), static_cast<int>(std::floor(at.y)));
  }
  const Corners c = corners(uv);
  const Rgb upper = c.c00 * (1 - c.x) + c.c10 * c.x;
  const Rgb lower = c.c01 * (1 - c.x) + c.c11 * c.x;
  return upper * (1 - c.y) + lower * c.y;
}

Vec2<float> BitmapTexture::gradient(const Vec2<float>& uv, const Rgb& factor) const {
  if (filter_ == TextureFilter::nearest) return {};
  const Corners c = corners(uv);
  const float f00 = luminance(c.c00 * factor), f10 = luminance(c.c10 * factor), f01 = luminance(c.c01 * factor),
              f11 = luminance(c.c11 * factor);
  const float by_x = static_cast<float>(image_->width) * ((1 - c.y) * (f10 - f00) + c.y * (f11 - f01));
  const float by_y = static_cast<float>(image_->height) * ((1 - c.x) * (f01 - f00) + c.x * (f11 - f10));
  return {to_uv_.along_u.x * by_x + to_uv_.along_u.y * by_y, to_uv_.along_v.x * by_x + to_uv_.along_v.y * by_y};
}

Textures::Colour2 Textures::compile(const Colour& colour) {
  if (const auto* texture = std::get_if<TextureIndex>(&colour)) return {Rgb(0.0f), texture->value};
  return {Rgb(std::get<RgbD>(colour)), no_index};
}

Textures::Textures(const std::vector<TextureDescription>& descriptions, const VolumeFrame& frame) {
  for (const TextureDescription& d : descriptions)
    std::visit(Overloaded{[&](const BitmapDescription& bitmap) { textures_.emplace_back(BitmapTexture(bitmap)); },
                          [&](const CheckerboardDescription& board) {
                            textures_.emplace_back(Checkerboard{{compile(board.color0), compile(board.color1)},
                                                                UvTransform(board.to_uv, 1)});
                          },
                          [&](const MeshAttributeDescription& attribute) {
                            textures_.emplace_back(attribute);
                            has_mesh_attributes_ = true;
                          },
                          [&](const ScaledTextureDescription& scaled) {
                            textures_.emplace_back(Scaled{scaled.texture.value, Rgb(scaled.scale)});
                          },
                          [&](const VolumeTextureDescription& volume) {
                            textures_.emplace_back(Volume(volume.volume, frame));
                            has_volumes_ = true;
                          }},
               d.pattern);
}

const Textures::Colour2& Textures::square(const Checkerboard& board, const Vec2<float>& uv) {
  const Vec2<float> at = board.to_uv.apply(uv);
  const bool right = at.x - std::floor(at.x) > 0.5f, upper = at.y - std::floor(at.y) > 0.5f;
  return board.colours[right == upper ? 0 : 1];
}

Rgb Textures::colour(std::uint32_t texture, const Vec2<float>& uv, const PlacedPoint* placed) const {
  if (const auto* bitmap = std::get_if<BitmapTexture>(&textures_[texture])) return bitmap->at(uv);
  if (const auto* board = std::get_if<Checkerboard>(&textures_[texture])) {
    const Colour2& c = square(*board, uv);
    return c.texture != no_index ? colour(c.texture, uv, placed) : c.value;
  }
  if (const auto* scaled = std::get_if<Scaled>(&textures_[texture]))
    return colour(scaled->texture, uv, placed) * scaled->factor;
  if (placed == nullptr) return Rgb(0.0f);
  if (const auto* volume = std::get_if<Volume>(&textures_[texture])) return volume->at(placed->p);
  const auto& attribute = std::get<MeshAttributeDescription>(textures_[texture]);
  return placed->mesh != nullptr ? attribute_at(attribute.name, *placed) * static_cast<float>(attribute.scale)
                                 : Rgb(0.0f);
}

float Textures::number(std::uint32_t texture, const Vec2<float>& uv, const PlacedPoint* placed) const {
  return luminance(colour(texture, uv, placed));
}

Vec2<float> Textures::gradient(std::uint32_t texture, const Vec2<float>& uv) const {
  return gradient(texture, uv, Rgb(1.0f));
}

Vec2<float> Textures::gradient(std::uint32_t texture, const Vec2<float>& uv, const Rgb& factor) const {
  if (const auto* bitmap = std::get_if<BitmapTexture>(&textures_[texture])) return bitmap->gradient(uv, factor);
  if (const auto* board = std::get_if<Checkerboard>(&textures_[texture])) {
    const Colour2& c = square(*board, uv);
    return c.texture != no_index ? gradient(c.texture, uv, factor) : Vec2<float>{};
  }
  if (const auto* scaled = std::get_if<Scaled>(&textures_[texture]))
    return gradient(scaled->texture, uv, scaled->factor * factor);
  return {};
}

void Textures::visit_attributes(
    std::uint32_t texture, const std::function<void(const MeshAttributeDescription&, const Rgb& factor)>& visit) const {
  if (const auto* attribute = std::get_if<MeshAttributeDescription>(&textures_[texture])) {
    visit(*attribute, Rgb(static_cast<float>(attribute->scale)));
  } else if (const auto* board = std::get_if<Checkerboard>(&textures_[texture])) {
    for (const Colour2& colour : board->colours)
      if (colour.texture != no_index) visit_attributes(colour.texture, visit);
  } else if (const auto* scaled = std::get_if<Scaled>(&textures_[texture])) {
    visit_attributes(scaled->texture, [&](const MeshAttributeDescription& inner, const Rgb& factor) {
      visit(inner, factor * scaled->factor);
    });
  }
}

bool Textures::shows_volume(std::uint32_t texture) const {
  if (const auto* board = std::get_if<Checkerboard>(&textures_[texture]))
    return std::ranges::any_of(board->colours,
                               [&](const Colour2& c) { return c.texture != no_index && shows_volume(c.texture); });
  if (const auto* scaled = std::get_if<Scaled>(&textures_[texture])) return shows_volume(scaled->texture);
  return std::holds_alternative<Volume>(textures_[texture]);
}

Vec2<int> Textures::resolution(std::uint32_t texture) const {
  if (const auto* bitmap = std::get_if<BitmapTexture>(&textures_[texture])) return bitmap->resolution();
  if (const auto* scaled = std::get_if<Scaled>(&textures_[texture])) return resolution(scaled->texture);
  return {1, 1};
}

std::size_t Textures::bytes() const {
  std::size_t total = 0;
  for (const auto& texture : textures_)
    if (const auto* bitmap = std::get_if<BitmapTexture>(&texture)) total += bitmap->bytes();
  return total;
}

}  // namespace photonproof::inline renderer_textures
