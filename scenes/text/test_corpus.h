// The corpus of a fuzz target as an ordinary test: every file whole, and cut short at a few places.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <string_view>

#include "scenes/text/atomic_file.h"

namespace photonproof {

/// `folder` within the sources; it has `least` files at least.
template <class Check>
void check_corpus(const std::string& folder, int least, Check check) {
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(std::string(PHOTONPROOF_SOURCE_DIR) + "/" + folder)) {
    const std::string bytes = read_file(entry.path());
    for (const std::size_t part : {1, 3, 7, 8})
      EXPECT_EQ(check(std::string_view(bytes).substr(0, bytes.size() * part / 8)), "") << entry.path() << ", " << part;
    ++files;
  }
  EXPECT_GE(files, least);
}

}  // namespace photonproof
