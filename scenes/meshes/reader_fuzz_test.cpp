// The corpora of the OBJ and IES fuzzers as ordinary tests, so that every build checks past findings.
#include <gtest/gtest.h>

#include <filesystem>

#include "scenes/files/atomic_file.h"
#include "scenes/meshes/ies_fuzz.h"
#include "scenes/meshes/obj_fuzz.h"

namespace photonproof::inline scenes_meshes {
namespace {

template <class Check>
void check_folder(const std::string& folder, int least, Check check) {
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(PHOTONPROOF_CORPORA "/" + folder)) {
    const std::string bytes = read_file(entry.path());
    for (std::size_t length = 0; length <= bytes.size(); ++length)
      EXPECT_EQ(check(std::string_view(bytes).substr(0, length)), "") << entry.path() << " cut at " << length;
    ++files;
  }
  EXPECT_GE(files, least);
}

TEST(reader_fuzz, obj_corpus_gives_messages_or_sound_meshes) { check_folder("obj_corpus", 40, check_obj); }

TEST(reader_fuzz, ies_corpus_gives_messages_or_sound_profiles) { check_folder("ies_corpus", 65, check_ies); }

}  // namespace
}  // namespace photonproof::inline scenes_meshes
