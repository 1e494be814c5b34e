#include "harness/suites/toml_table.h"

#include "scenes/files/test_folder.h"

namespace photonproof::inline harness_suites {
namespace {

TomlTable parse(const std::string& text) { return TomlTable::parse(text, "t.toml"); }

TEST(TomlTable, values_of_every_kind_are_read) {
  const TomlTable table = parse(
      "s = 'x'\ni = -3\nf = 0.5\na = ['p', 'q']\nn = [1, 2]\nd = [0.5, -2]\nl = [['a', 'b'], []]\ny = true\n[t]\ni = "
      "1");
  EXPECT_EQ(table.string("s"), "x");
  EXPECT_EQ(table.integer("i"), -3);
  EXPECT_EQ(table.number("f"), 0.5);
  EXPECT_EQ(table.number("i"), -3.0);
  EXPECT_EQ(table.strings("a"), (std::vector<std::string>{"p", "q"}));
  EXPECT_EQ(table.numbers("d"), (std::vector<double>{0.5, -2}));
  EXPECT_EQ(table.integers("n"), (std::vector<std::int64_t>{1, 2}));
  EXPECT_EQ(table.string_lists("l"), (std::vector<std::vector<std::string>>{{"a", "b"}, {}}));
  EXPECT_TRUE(table.boolean("y"));
  EXPECT_EQ(table.table("t").integer("i"), 1);
  EXPECT_TRUE(table.has("s"));
  EXPECT_FALSE(table.has("nothing"));
  EXPECT_TRUE(table.tables("rows").empty());
  table.expect_no_other_keys();
}

TEST(TomlTable, array_of_tables_is_read_in_order) {
  const std::vector<TomlTable> rows = parse("[[row]]\ni = 1\n[[row]]\ni = 2").tables("row");
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[1].integer("i"), 2);
}

TEST(TomlTable, syntax_error_has_its_place) {
  const std::string error = input_error_of([] { parse("a = 1\nb = ["); });
  EXPECT_TRUE(error.starts_with("t.toml:2:6: error: not valid TOML: ")) << error;
}

TEST(TomlTable, letters_beyond_ascii_stand_in_quotes_and_comments_alone) {
  EXPECT_EQ(parse("a = 'é ϝ'  # ü").string("a"), "é ϝ");
  for (const char* letter : {"é", "ϝ", "ҙ", "日", "\u2040"}) {
    const std::string error = input_error_of([&] { parse("a = 1\nb = " + std::string(letter)); });
    EXPECT_TRUE(error.starts_with("t.toml:2:5: error: not valid TOML: ")) << error;
  }
}

TEST(TomlTable, missing_key_is_named_at_the_table) {
  EXPECT_EQ(input_error_of([] { parse("[t]\nb = 1").table("t").integer("a"); }),
            "t.toml:1:1: error: 'a' is missing\n  [t]\n  ^");
}

TEST(TomlTable, wrong_types_are_named_at_the_value) {
  const TomlTable table = parse("i = 1\ns = 'x'\nf = 1.5\na = [1, 'x']\ninf = inf\nempty = ''");
  EXPECT_EQ(input_error_of([&] { table.string("i"); }),
            "t.toml:1:5: error: 'i' must be a string, not an integer\n  i = 1\n      ^");
  EXPECT_EQ(input_error_of([&] { table.integer("f"); }),
            "t.toml:3:5: error: 'f' must be an integer, not a float\n  f = 1.5\n      ^");
  EXPECT_EQ(input_error_of([&] { table.number("s"); }),
            "t.toml:2:5: error: 's' must be a finite number, not a string\n  s = 'x'\n      ^");
  EXPECT_EQ(input_error_of([&] { table.number("inf"); }),
            "t.toml:5:7: error: 'inf' must be a finite number, not a float\n  inf = inf\n        ^");
  EXPECT_EQ(input_error_of([&] { table.boolean("i"); }),
            "t.toml:1:5: error: 'i' must be true or false, not an integer\n  i = 1\n      ^");
  EXPECT_EQ(input_error_of([&] { table.integers("a"); }),
            "t.toml:4:9: error: 'a' must be an integer, not a string\n  a = [1, 'x']\n          ^");
  EXPECT_EQ(input_error_of([&] { table.numbers("a"); }),
            "t.toml:4:9: error: 'a' must be a finite number, not a string\n  a = [1, 'x']\n          ^");
  EXPECT_EQ(input_error_of([&] { table.strings("s"); }),
            "t.toml:2:5: error: 's' must be an array of strings, not a string\n  s = 'x'\n      ^");
  EXPECT_EQ(input_error_of([&] { table.table("s"); }),
            "t.toml:2:5: error: 's' must be a table, not a string\n  s = 'x'\n      ^");
  EXPECT_EQ(input_error_of([&] { table.tables("a"); }),
            "t.toml:4:6: error: 'a' must be an array of tables, not an integer\n  a = [1, 'x']\n       ^");
  EXPECT_EQ(input_error_of([&] { table.string("empty"); }),
            "t.toml:6:9: error: 'empty' must not be empty\n  empty = ''\n          ^");
}

TEST(TomlTable, unknown_key_is_refused_with_the_known_ones) {
  const TomlTable table = parse("a = 1\nsecnds = 2");
  table.integer("a");
  table.has("seconds");
  EXPECT_EQ(
      input_error_of([&] { table.expect_no_other_keys(); }),
      "t.toml:2:1: error: unknown key 'secnds' (did you mean 'seconds'?); known here: a, seconds\n  secnds = 2\n  ^");
}

}  // namespace
}  // namespace photonproof::inline harness_suites
