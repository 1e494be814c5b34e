// The fuzzer's corpus as an ordinary test, so that every build checks past findings.
#include "scenes/parser/parser_fuzz.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "scenes/files/atomic_file.h"

namespace photonproof::inline scenes_parser {
namespace {

namespace fs = std::filesystem;

int check_folder(const std::string& folder) {
  int files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    const std::string text = read_file(entry.path());
    EXPECT_EQ(check_parser(text), "") << entry.path();
    EXPECT_EQ(LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()), 0);
    ++files;
  }
  return files;
}

TEST(parser_fuzz, corpus_gives_messages_or_scenes_that_survive_writing) {
  EXPECT_GE(check_folder(PHOTONPROOF_CORPORA "/parser_corpus"), 90);
}

TEST(parser_fuzz, malformed_and_library_scenes_do_too) {
  EXPECT_GE(check_folder(PHOTONPROOF_SOURCE_DIR "/scenes/malformed"), 20);
  EXPECT_GE(check_folder(PHOTONPROOF_SOURCE_DIR "/scenes/library"), 7);
}

TEST(parser_fuzz, truncated_library_scenes_do_too) {
  const std::string text = read_file(PHOTONPROOF_SOURCE_DIR "/scenes/library/course-1/scene.xml");
  for (std::size_t length = 0; length <= text.size(); length += 7)
    EXPECT_EQ(check_parser(std::string_view(text).substr(0, length)), "") << length;
}

}  // namespace
}  // namespace photonproof::inline scenes_parser
