// The fuzzer's corpus as an ordinary test, so that every build checks past findings.
#include "scenes/meshes/ply_fuzz.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "scenes/files/atomic_file.h"

namespace photonproof::inline scenes_meshes {
namespace {

namespace fs = std::filesystem;

TEST(ply_fuzz, corpus_gives_messages_or_meshes_that_survive_writing_also_truncated) {
  int files = 0;
  for (const auto& entry : fs::directory_iterator(PHOTONPROOF_CORPORA "/ply_corpus")) {
    const std::string bytes = read_file(entry.path());
    for (std::size_t length = 0; length <= bytes.size(); ++length)
      EXPECT_EQ(check_ply(std::string_view(bytes).substr(0, length)), "") << entry.path() << " cut at " << length;
    EXPECT_EQ(LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()), 0);
    ++files;
  }
  EXPECT_GE(files, 70);
}

}  // namespace
}  // namespace photonproof::inline scenes_meshes
