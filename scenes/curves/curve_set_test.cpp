// The reader of Mitsuba's curve files. Texts are made here by the format's public description.
#include "scenes/curves/curve_set.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "scenes/base/input_error.h"
#include "scenes/curves/curve_set_fuzz.h"
#include "scenes/files/atomic_file.h"

namespace photonproof::inline scenes_curves {
namespace {

const std::string kTwo = "0 0 0 0.1\n1 0.5 -2e1 0\r\n\n  \t\n\n3 4 5 .25\n6 7 8 1\n9 10 11 2";

std::string message_of(const std::string& text, std::size_t least = 2) {
  try {
    parse_curves(text, "a.txt", least);
    return "";
  } catch (const InputError& error) {
    return error.summary();
  }
}

TEST(curve_set, has_points_and_where_curves_begin) {
  const CurveSet set = parse_curves(kTwo, "a.txt", 2);
  ASSERT_EQ(set.points.size(), 5u);
  EXPECT_EQ(set.first, (std::vector<std::uint32_t>{0, 2}));
  EXPECT_EQ(set.points[1], (CurvePoint{{1, 0.5f, -20}, 0}));
  EXPECT_EQ(set.points[4], (CurvePoint{{9, 10, 11}, 2}));
}

TEST(curve_set, that_is_damaged_is_refused_at_its_place) {
  EXPECT_EQ(message_of(""), "a.txt: error: has no control points, expected at least one curve");
  EXPECT_EQ(message_of(" \n\n"), "a.txt: error: has no control points, expected at least one curve");
  EXPECT_EQ(message_of("0 0 0 1\n1 0 0\n"),
            "a.txt:2:6: error: a control point has too few numbers, expected x y z radius");
  EXPECT_EQ(message_of("0 0 0 1\n1 x 0 1\n"),
            "a.txt:2:3: error: a control point is 'x', which is not a finite decimal number");
  EXPECT_EQ(message_of("0 0 0 1\n1 nan 0 1\n"),
            "a.txt:2:3: error: a control point is 'nan', which is not a finite decimal number");
  EXPECT_EQ(message_of("0 0 0 1\n1 0 0 -1\n"), "a.txt:2:7: error: a radius is negative");
  EXPECT_EQ(message_of("0 0 0 1 2\n"),
            "a.txt:1:9: error: a control point has more than 4 numbers, expected x y z radius");
  EXPECT_EQ(message_of("0 0 0 1\n1 0 0 1\n\n  2 0 0 1\n\n"),
            "a.txt:4:3: error: a curve has 1 control point, expected at least 2");
  EXPECT_EQ(message_of(kTwo, 3), "a.txt:1:1: error: a curve has 2 control points, expected at least 3");
  EXPECT_EQ(message_of(kTwo, 2), "");
}

TEST(curve_set, corpus_gives_sound_curves_or_messages) {
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(PHOTONPROOF_CORPORA "/curve_set_corpus")) {
    EXPECT_EQ(check_curves(read_file(entry.path())), "") << entry.path();
    ++files;
  }
  EXPECT_GE(files, 8);
}

TEST(curve_set, of_any_bytes_is_sound_or_one_message) {
  for (std::size_t size = 0; size <= kTwo.size(); ++size) {
    EXPECT_EQ(check_curves(std::string_view(kTwo).substr(0, size)), "") << size;
    for (int bit = 0; bit < 8 && size < kTwo.size(); ++bit) {
      std::string bent = kTwo;
      bent[size] = static_cast<char>(bent[size] ^ (1 << bit));
      EXPECT_EQ(check_curves(bent), "") << size << " bit " << bit;
    }
  }
}

}  // namespace
}  // namespace photonproof::inline scenes_curves
