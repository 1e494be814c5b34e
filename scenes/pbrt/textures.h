// pbrt's textures. Texture coordinates of ours are (u, 1 - v) of pbrt's, so that images lie as they are.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "scenes/pbrt/state.h"

namespace photonproof::inline scenes_pbrt {

class PbrtTextures {
 public:
  /// The use of a texture's values. Shares are at most 1; a root is that of a roughness, which is an alpha.
  enum class Use { share, number, root };

  explicit PbrtTextures(PbrtContext& context) : context_(context) {}

  /// The directive Texture; `kind` is float or spectrum.
  void define(const std::string& name, const std::string& kind, PbrtEntity entity);
  /// A parameter that is a colour or a texture, times `factor`.
  Colour colour(const PbrtParameters& parameters, std::string_view name, const RgbD& fallback, Use use,
                double factor = 1);
  /// A parameter that is a number or a texture.
  Scalar number(const PbrtParameters& parameters, std::string_view name, double fallback, Use use);
  /// An image as a texture.
  TextureIndex image(const std::filesystem::path& file, bool raw, const RgbD& factor);
  /// An image that was made for the scene.
  TextureIndex image(const Rendering& image, const std::string& stem);

 private:
  /// A texture's meaning, before it is known what its values are for.
  struct Pattern {
    enum class Kind { constant, image, checkerboard } kind = Kind::constant;
    RgbD factor{1.0};  ///< a constant's value
    std::filesystem::path file;
    bool raw = false, invert = false;
    double inner = 1;  ///< factor before inversion
    TextureWrap wrap = TextureWrap::repeat;
    TextureFilter filter = TextureFilter::bilinear;
    Transform to_uv;
    std::vector<Pattern> parts;
  };

  Pattern pattern(const std::string& name, bool is_float, const PbrtParameters& user, const PbrtParameter& at,
                  int depth) const;
  Pattern part(const PbrtParameters& parameters, std::string_view name, double fallback, bool is_float,
               int depth) const;
  Pattern image_pattern(const PbrtEntity& texture) const;
  Pattern mixed(const PbrtParameters& p, bool is_float, int depth) const;
  Pattern scaled_by(const PbrtParameters& p, bool is_float, int depth) const;
  Transform mapping(const PbrtParameters& parameters, double squares) const;
  static Pattern times(Pattern pattern, const RgbD& factor);
  Colour made(const Pattern& pattern, Use use);
  TextureIndex made_image(const Pattern& pattern, Use use);
  TextureIndex add(decltype(TextureDescription::pattern) pattern);

  PbrtContext& context_;
  std::map<std::pair<std::string, bool>, PbrtEntity> defined_;
  std::map<std::tuple<std::string, bool, Use, double>, Colour> made_;
};

}  // namespace photonproof::inline scenes_pbrt
