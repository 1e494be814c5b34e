#include "scenes/pbrt/textures.h"

#include <algorithm>
#include <cmath>

#include "scenes/base/text_numbers.h"
#include "scenes/images/image.h"

namespace photonproof::inline scenes_pbrt {
namespace {

namespace fs = std::filesystem;

constexpr int kDeepest = 32;  // textures in textures

/// Whether values of an image may exceed 1.
bool may_be_bright(const fs::path& file) {
  const std::string ending = file.extension().string();
  return ending != ".png" && ending != ".jpg" && ending != ".jpeg" && ending != ".tga" && ending != ".bmp";
}

double value_for(double v, PbrtTextures::Use use) {
  if (use == PbrtTextures::Use::root) return std::max(1e-3, std::sqrt(std::max(v, 0.0)));
  return std::clamp(v, 0.0, use == PbrtTextures::Use::share ? 1.0 : 1e30);
}

RgbD value_for(const RgbD& v, PbrtTextures::Use use) {
  return {value_for(v.x, use), value_for(v.y, use), value_for(v.z, use)};
}

}  // namespace

void PbrtTextures::define(const std::string& name, const std::string& kind, PbrtEntity entity) {
  if (kind != "float" && kind != "spectrum")
    entity.parameters.fail("the texture is of " + in_quotes(kind) + ", expected float or spectrum");
  defined_.insert_or_assign({name, kind == "float"}, std::move(entity));
}

Colour PbrtTextures::colour(const PbrtParameters& parameters, std::string_view name, const RgbD& fallback, Use use,
                            double factor) {
  const PbrtParameter* texture = parameters.find(name, {"texture"});
  if (texture == nullptr) return value_for(context_.spectra.colour(parameters, name).value_or(fallback) * factor, use);
  if (texture->strings.size() != 1) parameters.fail(*texture, "expected the name of a texture");
  const std::tuple key(texture->strings[0], false, use, factor);
  if (const auto known = made_.find(key); known != made_.end()) return known->second;
  return made_[key] = made(times(pattern(texture->strings[0], false, parameters, *texture, 0), RgbD(factor)), use);
}

Scalar PbrtTextures::number(const PbrtParameters& parameters, std::string_view name, double fallback, Use use) {
  const PbrtParameter* texture = parameters.find(name, {"texture"});
  if (texture == nullptr) return value_for(parameters.number(name, fallback), use);
  if (texture->strings.size() != 1) parameters.fail(*texture, "expected the name of a texture");
  const std::tuple key(texture->strings[0], true, use, 1.0);
  auto known = made_.find(key);
  if (known == made_.end())
    known = made_.emplace(key, made(pattern(texture->strings[0], true, parameters, *texture, 0), use)).first;
  if (const auto* index = std::get_if<TextureIndex>(&known->second)) return *index;
  return std::get<RgbD>(known->second).x;
}

PbrtTextures::Pattern PbrtTextures::pattern(const std::string& name, bool is_float, const PbrtParameters& user,
                                            const PbrtParameter& at, int depth) const {
  const auto found = defined_.find({name, is_float});
  if (found == defined_.end())
    user.fail(at, "names the texture " + in_quotes(name) + " of " + (is_float ? "float" : "spectrum") +
                      ", which is not defined");
  if (depth > kDeepest) user.fail(at, "nests too many textures");
  const PbrtEntity& texture = found->second;
  const PbrtParameters& p = texture.parameters;
  Pattern result;
  if (texture.type == "constant") {
    result = part(p, "value", 1, is_float, depth);
  } else if (texture.type == "imagemap") {
    result = image_pattern(texture);
  } else if (texture.type == "scale") {
    result = scaled_by(p, is_float, depth);
  } else if (texture.type == "mix") {
    result = mixed(p, is_float, depth);
  } else if (texture.type == "checkerboard") {
    if (p.integer("dimension", 2, 2, 3) == 3) p.fail("is a checkerboard in space, expected one of 2 dimensions");
    result.kind = Pattern::Kind::checkerboard;
    result.to_uv = mapping(p, 2);  // ours has squares of half a unit
    result.parts = {part(p, "tex1", 1, is_float, depth), part(p, "tex2", 0, is_float, depth)};
  } else {
    p.fail("is not supported, expected constant, imagemap, scale, mix or checkerboard");
  }
  p.finish();
  return result;
}

PbrtTextures::Pattern PbrtTextures::part(const PbrtParameters& parameters, std::string_view name, double fallback,
                                         bool is_float, int depth) const {
  if (const PbrtParameter* texture = parameters.find(name, {"texture"})) {
    if (texture->strings.size() != 1) parameters.fail(*texture, "expected the name of a texture");
    return pattern(texture->strings[0], is_float, parameters, *texture, depth + 1);
  }
  Pattern result;
  result.factor = context_.spectra.colour(parameters, name).value_or(RgbD(fallback));
  return result;
}

PbrtTextures::Pattern PbrtTextures::scaled_by(const PbrtParameters& p, bool is_float, int depth) const {
  const Pattern a = part(p, "tex", 1, is_float, depth);
  // The factor is a texture of floats.
  const Pattern b = part(p, "scale", 1, true, depth);
  if (b.kind == Pattern::Kind::constant) return times(a, b.factor);
  if (a.kind == Pattern::Kind::constant) return times(b, a.factor);
  p.fail("multiplies two textures that vary, expected a constant among them");
}

PbrtTextures::Pattern PbrtTextures::mixed(const PbrtParameters& p, bool is_float, int depth) const {
  const Pattern a = part(p, "tex1", 0, is_float, depth), b = part(p, "tex2", 1, is_float, depth);
  const Pattern amount = part(p, "amount", 0.5, true, depth);
  if (amount.kind == Pattern::Kind::constant) {
    const double share = amount.factor.x;
    if (share <= 0) return a;
    if (share >= 1) return b;
    if (a.kind == Pattern::Kind::constant && b.kind == Pattern::Kind::constant) {
      Pattern result;
      result.factor = a.factor * (1 - share) + b.factor * share;
      return result;
    }
  }
  p.fail("mixes textures that vary, expected constants");
}

Transform PbrtTextures::mapping(const PbrtParameters& parameters, double squares) const {
  const std::string kind = parameters.text("mapping", "uv");
  if (kind != "uv") parameters.fail("has the mapping " + in_quotes(kind) + ", expected uv");
  const double su = parameters.number("uscale", 1), sv = parameters.number("vscale", 1);
  const double du = parameters.number("udelta", 0), dv = parameters.number("vdelta", 0);
  // pbrt looks up (su u + du, sv v + dv), and image rows at 1 minus the second.
  const double top = squares == 1 ? 1 - sv - dv : sv + dv;
  const Vec3d scale(su / squares, squares == 1 ? sv : -sv / squares, 1);
  return Transform::translate({du / squares, top / squares, 0}) * Transform::scale(scale);
}

PbrtTextures::Pattern PbrtTextures::image_pattern(const PbrtEntity& texture) const {
  const PbrtParameters& p = texture.parameters;
  p.ignore({"maxanisotropy"});
  Pattern result;
  result.kind = Pattern::Kind::image;
  const PbrtParameter* name = p.find("filename", {"string"});
  if (name == nullptr || name->strings.size() != 1) p.fail("expected a \"string filename\"");
  result.file = context_.files.find(name->strings[0], name->at);
  const std::string encoding = p.text("encoding", "sRGB"), wrap = p.text("wrap", "repeat");
  result.raw = encoding == "linear";
  if (encoding != "linear" && encoding != "sRGB")
    context_.log.note(p.at(), "an image's encoding " + in_quotes(encoding) + " counts as sRGB");
  if (wrap == "clamp") result.wrap = TextureWrap::clamp;
  if (wrap != "clamp" && wrap != "repeat") {
    result.wrap = TextureWrap::clamp;
    context_.log.note(p.at(), "a texture's wrap " + in_quotes(wrap) + " counts as clamp");
  }
  if (p.text("filter", "bilinear") == "point") result.filter = TextureFilter::nearest;
  result.inner = p.number("scale", 1, 0, 1e30);
  result.invert = p.boolean("invert", false);
  result.to_uv = mapping(p, 1);
  return result;
}

PbrtTextures::Pattern PbrtTextures::times(Pattern pattern, const RgbD& factor) {
  pattern.factor *= factor;
  // A checkerboard's factor is that of its parts.
  for (Pattern& part : pattern.parts) part = times(std::move(part), factor);
  return pattern;
}

Colour PbrtTextures::made(const Pattern& pattern, Use use) {
  if (pattern.kind == Pattern::Kind::constant) return value_for(pattern.factor, use);
  if (pattern.kind == Pattern::Kind::image) return made_image(pattern, use);
  CheckerboardDescription board;
  board.color0 = made(pattern.parts[0], use);
  board.color1 = made(pattern.parts[1], use);
  board.to_uv = pattern.to_uv;
  return add(board);
}

TextureIndex PbrtTextures::made_image(const Pattern& pattern, Use use) {
  BitmapDescription bitmap;
  bitmap.raw = pattern.raw;
  bitmap.wrap = pattern.wrap;
  bitmap.filter = pattern.filter;
  bitmap.to_uv = pattern.to_uv;
  const RgbD factor = pattern.factor * pattern.inner;
  const bool too_bright = use == Use::share && (max_component(factor) > 1 || may_be_bright(pattern.file));
  if (!pattern.invert && !too_bright && use != Use::root) {
    bitmap.filename = context_.files.copy(pattern.file);
    const TextureIndex index = add(bitmap);
    return factor == RgbD(1.0) ? index : add(ScaledTextureDescription{index, factor});
  }
  Rendering changed;
  changed.mean = read_texture_image(pattern.file.string(), pattern.raw);
  for (std::size_t i = 0; i < changed.mean.rgb.size(); ++i) {
    const double stored = pattern.inner * double{changed.mean.rgb[i]};
    const double outer = i % 3 == 0 ? pattern.factor.x : i % 3 == 1 ? pattern.factor.y : pattern.factor.z;
    changed.mean.rgb[i] =
        static_cast<float>(value_for(std::max(0.0, pattern.invert ? 1 - stored : stored) * outer, use));
  }
  bitmap.filename = context_.files.write(changed, pattern.file.stem().string());
  bitmap.raw = true;
  return add(bitmap);
}

TextureIndex PbrtTextures::image(const fs::path& file, bool raw, const RgbD& factor) {
  Pattern pattern;
  pattern.kind = Pattern::Kind::image;
  pattern.file = file;
  pattern.raw = raw;
  pattern.factor = factor;
  return made_image(pattern, Use::number);
}

TextureIndex PbrtTextures::image(const Rendering& image, const std::string& stem) {
  BitmapDescription bitmap;
  bitmap.filename = context_.files.write(image, stem);
  bitmap.raw = true;
  return add(bitmap);
}

TextureIndex PbrtTextures::add(decltype(TextureDescription::pattern) pattern) {
  std::vector<TextureDescription>& textures = context_.scene.textures;
  textures.push_back({{}, "texture-" + std::to_string(textures.size()), std::move(pattern)});
  return {static_cast<std::uint32_t>(textures.size() - 1)};
}

}  // namespace photonproof::inline scenes_pbrt
