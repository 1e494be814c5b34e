#include "harness/verbs/scene_options.h"

#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>
#include <cstdint>

#include "harness/verbs/usage/verb_usage.h"
#include "scenes/description/sensors.h"
#include "scenes/dialect/model_file.h"
#include "scenes/parser/parser.h"

namespace photonproof::inline harness_verbs {

void apply_size(const std::string& size, FilmDescription& film) {
  const char* end = size.data() + size.size();
  int width = 0;
  int height = 0;
  const auto [after_width, width_error] = std::from_chars(size.data(), end, width);
  const bool has_x = width_error == std::errc{} && after_width != end && *after_width == 'x';
  const auto [after_height, height_error] = std::from_chars(has_x ? after_width + 1 : end, end, height);
  constexpr int largest = 65536;
  if (!has_x || height_error != std::errc{} || after_height != end || width < 1 || height < 1 || width > largest ||
      height > largest || std::int64_t{width} * height > (std::int64_t{1} << 28))
    throw InputError("--size",
                     "'" + size + "' is not a size, expected WIDTHxHEIGHT, e.g. 256x256 (at most 2^28 pixels)");
  film.resize(width, height);
}

void add_scene_options(CLI::App& verb, SceneOptions& options) {
  begin_option_group(verb, input_group);
  verb.add_option("SCENE", options.path, "scene XML")->required();
  verb.add_option("-D,--define", options.defines, "value for the scene's $name; may be repeated")
      ->type_name("NAME=VALUE")
      ->take_all()
      ->allow_extra_args(false);
  verb.add_option("--size", options.size,
                  "size of the whole film (default: the scene's); a crop in the scene keeps its share")
      ->type_name("WxH");
  verb.add_flag("--allow-outside", options.allow_outside, "let the scene name files outside its folder");
  verb.add_option("--sensor", options.sensor, "the scene's camera with this number, counted from 0 (default: 0)")
      ->type_name("N")
      ->check(CLI::NonNegativeNumber);
  verb.add_flag("--lenient", options.lenient, "leave out what cannot be read, with a warning for each");
}

void add_mitsuba_option(CLI::App& verb, SceneOptions& options) {
  verb.add_flag("--as-mitsuba", options.as_mitsuba, "follow Mitsuba 3.9.1 where it is wrong, with a warning for each");
}

std::string is_seed(const std::string& text) {
  std::uint64_t seed = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), seed);
  const bool good = error == std::errc{} && end == text.data() + text.size();
  return good ? "" : "'" + text + "' is not a seed, expected a whole number from 0 to 2^64 - 1";
}

std::string is_finite_number(const std::string& text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool good = error == std::errc{} && end == text.data() + text.size() && std::isfinite(value);
  return good ? "" : "'" + text + "' is not a finite number";
}

std::function<std::string(std::string)> whole_number(std::int64_t least, std::int64_t most) {
  return [least, most](const std::string& text) {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool whole = error == std::errc{} && end == text.data() + text.size() && value == std::floor(value);
    if (!whole || value < static_cast<double>(least) || value > static_cast<double>(most))
      throw CLI::ValidationError("'" + text + "' is not a whole number from " + std::to_string(least) + " to " +
                                 std::to_string(most));
    return std::to_string(static_cast<std::int64_t>(value));
  };
}

std::vector<std::string> scene_arguments(const SceneOptions& options) {
  std::vector<std::string> words{options.path};
  for (const std::string& define : options.defines) words.insert(words.end(), {"-D", define});
  if (options.allow_outside) words.emplace_back("--allow-outside");
  if (options.lenient) words.emplace_back("--lenient");
  if (options.as_mitsuba) words.emplace_back("--as-mitsuba");
  if (options.sensor != 0) words.insert(words.end(), {"--sensor", std::to_string(options.sensor)});
  return words;
}

namespace {

ParseOptions parse_options(const SceneOptions& options) {
  ParseOptions parse;
  parse.allow_outside = options.allow_outside;
  parse.lenient = options.lenient;
  parse.as_mitsuba = options.as_mitsuba;
  parse.sensor = options.sensor;
  for (const std::string& define : options.defines) {
    const std::size_t equals = define.find('=');
    if (equals == std::string::npos || equals == 0)
      throw InputError("-D", "'" + define + "' is not a definition, expected name=value");
    if (!parse.defines.emplace(define.substr(0, equals), define.substr(equals + 1)).second)
      throw InputError("-D", "'" + define.substr(0, equals) + "' is defined twice");
  }
  return parse;
}

SceneDescription sized(SceneDescription scene, const std::string& size) {
  if (size.empty()) return scene;
  apply_size(size, scene.sensor.film);
  const std::string problem = film_problem(scene.sensor);
  if (!problem.empty()) throw InputError("--size", "the scene's sensor " + problem);
  return scene;
}

}  // namespace

SceneDescription load_scene(const SceneOptions& options) {
  return sized(parse_scene_file(options.path, parse_options(options)), options.size);
}

SceneDescription load_scene_into(const SceneOptions& options, const std::string& folder) {
  if (!is_model(options.path)) return load_scene(options);
  return sized(parse_model_file(options.path, folder, parse_options(options)), options.size);
}

}  // namespace photonproof::inline harness_verbs
