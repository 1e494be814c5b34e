#include "scenes/files/inside_folder.h"

#include <gtest/gtest.h>

#include "scenes/files/test_folder.h"

namespace photonproof::inline scenes_files {
namespace {

namespace fs = std::filesystem;

class InsideFolder : public FolderTest {
 protected:
  bool inside(const fs::path& path, const fs::path& folder) const {
    std::error_code error;
    return is_inside(real_path(path, error), folder);
  }
};

TEST_F(InsideFolder, is_told_by_where_links_lead) {
  fs::create_directories(folder_ / "in");
  put("in/a", "");
  put("secret", "");
  fs::create_symlink(folder_ / "secret", folder_ / "in/out");
  fs::create_symlink(folder_ / "in", folder_ / "link");
  const fs::path in = folder_ / "in";
  EXPECT_TRUE(inside(in / "a", in));
  EXPECT_TRUE(inside(in, in));
  EXPECT_TRUE(inside(in / "../link/a", in));
  EXPECT_TRUE(inside(in / "a", folder_ / "link"));
  EXPECT_FALSE(inside(in / "out", in));
  EXPECT_FALSE(inside(in / "../secret", in));
  EXPECT_FALSE(inside(folder_ / "in-other", in));
}

TEST_F(InsideFolder, is_told_of_what_does_not_exist) {
  EXPECT_TRUE(inside("missing", ""));
  EXPECT_TRUE(inside("missing/part", "."));
  EXPECT_FALSE(inside("../missing", ""));
}

}  // namespace
}  // namespace photonproof::inline scenes_files
