// The options every verb that reads a scene shares.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "scenes/description/description.h"

namespace CLI {
class App;
}

namespace photonproof::inline harness_verbs {

struct SceneOptions {
  std::string path;
  std::vector<std::string> defines;  ///< "name=value"
  std::string size;                  ///< "WxH", empty: the scene's
  bool allow_outside = false;
  bool lenient = false;
  bool as_mitsuba = false;
  int sensor = 0;
};

/// SCENE, -D, --size, --sensor, --allow-outside, --lenient.
void add_scene_options(CLI::App& verb, SceneOptions& options);

/// --as-mitsuba, for verbs that render by this program's own integrators.
void add_mitsuba_option(CLI::App& verb, SceneOptions& options);

/// "WxH" to a film size; throws InputError on anything else.
void apply_size(const std::string& size, FilmDescription& film);

/// Option checks: empty when the text is good, else what is wrong. CLI11's own numbers let "-1" through as the largest
/// seed and NaN through every range.
std::string is_seed(const std::string& text);
std::string is_finite_number(const std::string& text);

/// The whole number a user may also write as 1e6, in digits. Throws CLI::ValidationError when it is none from `least`
/// to `most`, which are below 2^53.
std::function<std::string(std::string)> whole_number(std::int64_t least, std::int64_t most);

/// The options without --size, as they were given, for another process of this program.
std::vector<std::string> scene_arguments(const SceneOptions& options);

/// Parses the scene or model; its film has the size asked for. Throws InputError.
SceneDescription load_scene(const SceneOptions& options);
/// The same; what a model's reader makes goes into `folder` and stays there.
SceneDescription load_scene_into(const SceneOptions& options, const std::string& folder);

}  // namespace photonproof::inline harness_verbs
