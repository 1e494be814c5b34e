// Fuzzes scenes that include others. Built with libFuzzer (preset fuzz), and run over include_corpus/ by
// include_fuzz_test.cpp. A line "=== name" begins a file of that name; what is before the first is the scene.
#include "scenes/parser/include_fuzz.h"

#include <algorithm>
#include <vector>

#include "scenes/base/test_fuzz.h"
#include "scenes/parser/parser.h"
#include "scenes/parser/test_same_scene.h"
#include "scenes/xml/writer.h"

namespace photonproof::inline scenes_parser {
namespace {

constexpr std::string_view mark = "=== ";
constexpr std::size_t most_files = 6;

/// Letters, digits, '.', '-' and '_': no other folder.
bool is_plain_name(std::string_view name) {
  return !name.empty() && name.size() < 40 && name.front() != '.' && std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' || c == '-' ||
           c == '_';
  });
}

/// Files of one input, gone with the object.
class SceneFiles {
 public:
  SceneFiles(const FuzzFolder& folder, std::string_view bytes) {
    std::string_view name = "scene.xml";
    while (files_.size() < most_files) {
      const bool starts_with_mark = bytes.starts_with(mark);
      const std::size_t found = starts_with_mark ? 0 : bytes.find("\n" + std::string(mark));
      const std::size_t end = found == std::string_view::npos ? bytes.size() : found;
      if (is_plain_name(name)) files_.push_back(folder.put(std::string(name), bytes.substr(0, end)));
      if (end == bytes.size()) return;
      bytes.remove_prefix(end + mark.size() + (starts_with_mark ? 0 : 1));
      const std::size_t line = std::min(bytes.find('\n'), bytes.size());
      name = bytes.substr(0, line);
      bytes.remove_prefix(std::min(line + 1, bytes.size()));
    }
  }
  ~SceneFiles() {
    std::error_code ignored;
    for (const std::filesystem::path& file : files_) std::filesystem::remove(file, ignored);
  }
  SceneFiles(const SceneFiles&) = delete;
  SceneFiles& operator=(const SceneFiles&) = delete;

 private:
  std::vector<std::filesystem::path> files_;
};

}  // namespace

std::string check_include(std::string_view bytes) {
  static const FuzzFolder folder;
  const SceneFiles files(folder, bytes);
  SceneDescription scene;
  try {
    scene = parse_scene_file((folder.path() / "scene.xml").string());
  } catch (const InputError& error) {
    return problem_with_message(error);
  }
  const std::string written = write_scene(scene);
  try {
    const SceneDescription again = parse_scene_text(written, (folder.path() / "scene.xml").string());
    const std::string difference = first_difference(scene, again);
    return difference.empty() ? "" : "writing and reading changes " + difference + ":\n" + written;
  } catch (const InputError& error) {
    return "the written scene is refused: " + std::string(error.what()) + "\n" + written;
  }
}

}  // namespace photonproof::inline scenes_parser

#ifdef PHOTONPROOF_FUZZER
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return photonproof::fuzz_input(photonproof::check_include, data, size);
}
#endif
