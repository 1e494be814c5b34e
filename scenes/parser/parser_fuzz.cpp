// Fuzzes the scene parser. Any bytes must give one InputError, or a scene that write_scene writes back exactly. Built
// with libFuzzer (preset fuzz), and run over parser_corpus/ by parser_fuzz_test.cpp. The first line may hold -D values:
// a text that starts with "-D name=value" has it cut off and defined.
#include "scenes/parser/parser_fuzz.h"

#include <cstdio>
#include <cstdlib>

#include "scenes/base/utf8.h"
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

}  // namespace

std::string check_parser(std::string_view text) {
  const ParseOptions options = take_define(text);
  SceneDescription scene;
  try {
    scene = parse_scene_text(text, kName, options);
  } catch (const InputError& error) {
    const std::string what = error.what();
    if (find_invalid_utf8(what) != std::string::npos) return "a message is not valid UTF-8";
    return error.summary().empty() || what.rfind(error.summary(), 0) != 0 ? "a message without its summary" : "";
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

}  // namespace photonproof::inline scenes_parser

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string problem = photonproof::check_parser({reinterpret_cast<const char*>(data), size});
  if (problem.empty()) return 0;
  std::fprintf(stderr, "%s\n", problem.c_str());
  std::abort();
}
