#include "scenes/meshes/ies.h"

#include <gtest/gtest.h>

#include "scenes/base/input_error.h"

namespace photonproof::inline scenes_meshes {
namespace {

IesProfile parse(const std::string& text) { return parse_ies(text, "a.ies"); }

std::string message(const std::string& text) {
  try {
    parse(text);
    return "no error";
  } catch (const InputError& error) {
    return error.summary();
  }
}

// Lights, lumens, multiplier, vertical and horizontal angles, type, units, width, length, height. Then ballast and
// light factors, watts. Then angles, candela.
const std::string kHead = "IESNA:LM-63-2002\n[TEST] none\nTILT=NONE\n";
const std::string kNumbers = "1 1000 2 3 2 1 2 0 0 0\n0.5 1 60\n0 45 90\n0 180\n";

TEST(ies, gives_the_grid_with_all_factors_applied) {
  const IesProfile profile = parse(kHead + kNumbers + "100 80 0\n60 50\n10\n");
  EXPECT_EQ(profile.vertical_degrees, (std::vector<double>{0, 45, 90}));
  EXPECT_EQ(profile.horizontal_degrees, (std::vector<double>{0, 180}));
  // 2 x 0.5 x 1 = 1.
  EXPECT_EQ(profile.candela, (std::vector<double>{100, 80, 0, 60, 50, 10}));
}

TEST(ies, reads_commas_windows_lines_and_the_end_mark_of_dos) {
  const IesProfile profile = parse("TILT=NONE\r\n1,1000,1,2,1,1,2,0,0,0\r\n1,1,60\r\n90,180\r\n0\r\n7,8\r\n\x1A");
  EXPECT_EQ(profile.candela, (std::vector<double>{7, 8}));
}

TEST(ies, says_what_is_wrong_and_where) {
  EXPECT_EQ(message(""), "a.ies:1:1: error: no line TILT= found, expected an IES LM-63 file");
  EXPECT_EQ(message("TILT=INCLUDE\n"), "a.ies:1:1: error: TILT is 'INCLUDE', expected NONE");
  EXPECT_EQ(message("TILT=NONE\n1 x"),
            "a.ies:2:3: error: the lumens per light is 'x', which is not a finite decimal number");
  EXPECT_EQ(message("TILT=NONE\n1 1000 1 3 2 3"), "a.ies:2:14: error: the photometric type is 3, expected 1 (type C)");
  EXPECT_EQ(message("TILT=NONE\n1 1000 1 1 2 1"),
            "a.ies:2:10: error: the number of vertical angles is 1, expected a whole number from 2 to 10000");
  EXPECT_EQ(message("TILT=NONE\n1 1000 0 3 2 1"),
            "a.ies:2:8: error: the candela multiplier is 0, expected more than 0");
  EXPECT_EQ(message(kHead + "1 1000 1 3 2 1 2 0 0 0\n1 1 60\n0 45 40\n0 180\n1 1 1 1 1 1"),
            "a.ies:6:6: error: the angle 40 does not ascend from 0 to 360");
  EXPECT_EQ(message(kHead + "1 1000 1 3 2 1 2 0 0 0\n1 1 60\n0 45 80\n0 180\n1 1 1 1 1 1"),
            "a.ies:6:6: error: the vertical angles go from 0 to 80, expected 0 or 90 to 90 or 180");
  EXPECT_EQ(message(kHead + "1 1000 1 3 2 1 2 0 0 0\n1 1 60\n0 45 90\n0 100\n1 1 1 1 1 1"),
            "a.ies:7:3: error: the horizontal angles go from 0 to 100, expected 0 to 0, 90, 180 or 360");
  EXPECT_EQ(message(kHead + kNumbers + "1 2 3 4 5"), "a.ies:8:10: error: the file ends before a candela value");
  EXPECT_EQ(message(kHead + kNumbers + "1 2 3 4 5 -6"),
            "a.ies:8:11: error: the candela value is negative or out of range");
  EXPECT_EQ(message(kHead + kNumbers + "1 2 3 4 5 6 7"),
            "a.ies:8:13: error: unexpected text after the last candela value, expected the end of the file");
}

TEST(ies, does_not_believe_a_promise_the_file_cannot_hold) {
  EXPECT_EQ(message("TILT=NONE\n1 1000 1 9999 9999 1 2 0 0 0\n1 1 60\n0"),
            "a.ies:4:2: error: the file ends within the candela values, of which 99980001 were promised");
}

}  // namespace
}  // namespace photonproof::inline scenes_meshes
