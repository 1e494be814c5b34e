#include "scenes/base/shell_text.h"

#include <gtest/gtest.h>

namespace photonproof::inline scenes_base {
namespace {

TEST(ShellText, what_a_shell_would_change_is_quoted) {
  EXPECT_EQ(shell_word("cells/a-1/image.exr"), "cells/a-1/image.exr");
  EXPECT_EQ(shell_word("a b"), "'a b'");
  EXPECT_EQ(shell_word("it's $HOME"), "'it'\\''s $HOME'");
  EXPECT_EQ(shell_word(""), "''");
  EXPECT_EQ(shell_line({"a", "", "b c", "it's", "$HOME", "x=1"}), "a '' 'b c' 'it'\\''s' '$HOME' x=1");
}

}  // namespace
}  // namespace photonproof::inline scenes_base
