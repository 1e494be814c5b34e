// Fuzzes the scene parser. Any bytes must give one InputError, or a scene that write_scene writes back exactly. Built
// with libFuzzer (preset fuzz), and run over parser_corpus/ by parser_fuzz_test.cpp. The first line may hold -D values:
// a text that starts with "-D name=value" has it cut off and defined.
#include "scenes/parser/parser_fuzz.h"

#include <cstdio>
#include <cstdlib>

#include "scenes/base/test_fuzz.h"
#include "scenes/parser/parser.h"
#include "scenes/parser/test_same_scene.h"
#include "scenes/xml/writer.h"

namespace photonproof::inline scenes_parser {
namespace {

// No file exists below it, so that an include can name none.
const char* const kName = "/nonexistent-folder-of-the-fuzzer/scene.xml";

ParseOptions take_define(std::string_view& text) {
  constexpr std::string_view kPrefix = "-D ";
  ParseOptions options;
  const auto end = text.find('\n');
  if (text.substr(0, kPrefix.size()) != kPrefix || end == std::string_view::npos) return options;
  const std::string_view define = text.substr(kPrefix.size(), end - kPrefix.size());
  const auto equals = define.find('=');
  text.remove_prefix(end + 1);
  if (equals != std::string_view::npos)
    options.defines[std::string(define.substr(0, equals))] = std::string(define.substr(equals + 1));
  return options;
}

/// The promise for these options.
std::string check_parser(std::string_view text, const ParseOptions& options) {
  SceneDescription scene;
  try {
    scene = parse_scene_text(text, kName, options);
    // Shapes that are left out may leave BSDFs without a use, which are not written.
    if (options.lenient) scene = parse_scene_text(write_scene(scene), kName);
  } catch (const InputError& error) {
    return problem_with_message(error);
  }
  const std::string written = write_scene(scene);
  try {
    const SceneDescription again = parse_scene_text(written, kName);
    const std::string difference = first_difference(scene, again);
    if (!difference.empty()) return "writing and reading changes " + difference + ":\n" + written;
    if (write_scene(again) != written) return "writing twice differs:\n" + written;
  } catch (const InputError& error) {
    return "the written scene is refused: " + std::string(error.what()) + "\n" + written;
  }
  return {};
}

}  // namespace

std::string check_parser(std::string_view text) {
  ParseOptions options = take_define(text);
  std::string problem = check_parser(text, options);
  options.lenient = true;
  return problem.empty() ? check_parser(text, options) : problem;
}

}  // namespace photonproof::inline scenes_parser

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string problem = photonproof::check_parser({reinterpret_cast<const char*>(data), size});
  if (problem.empty()) return 0;
  std::fprintf(stderr, "%s\n", problem.c_str());
  std::abort();
}
