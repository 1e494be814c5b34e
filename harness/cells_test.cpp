#include "harness/cells.h"

#include <gtest/gtest.h>

namespace photonproof {
namespace {

std::string order_of(const std::string& engines) {
  std::vector<Cell> cells;
  std::uint64_t seed = 0;
  for (const char engine : engines) cells.push_back({"s", std::string(1, engine), {"spp", 1}, seed++});
  std::string order;
  for (const Cell& cell : interleaved_by_engine(cells)) order += cell.engine + std::to_string(cell.seed) + " ";
  return order;
}

TEST(Cells, engines_take_turns_in_reversing_rounds) {
  // Six cells of A (0..2), B (3, 4) and C (5): A B C, then C is exhausted and the round runs backwards: B A, then A.
  EXPECT_EQ(order_of("AAABBC"), "A0 B3 C5 B4 A1 A2 ");
}

TEST(Cells, one_engine_keeps_its_order) { EXPECT_EQ(order_of("AAA"), "A0 A1 A2 "); }

TEST(Cells, no_cells_stay_no_cells) { EXPECT_EQ(order_of(""), ""); }

TEST(Cells, key_is_the_published_uuid_of_its_content) {
  // Python: uuid.uuid5(uuid.NAMESPACE_OID, "5:scene3:xyz").hex
  EXPECT_EQ(content_key({{"scene", "xyz"}}), "1d7191555dc1595aaa2b92b3d7625a30");
}

TEST(Cells, key_depends_on_every_part_its_name_and_where_it_is_cut) {
  const std::string key = content_key({{"a", "1"}, {"b", "2"}});
  EXPECT_EQ(key.size(), 32u);
  EXPECT_EQ(key, content_key({{"a", "1"}, {"b", "2"}}));
  EXPECT_NE(key, content_key({{"b", "2"}, {"a", "1"}}));
  EXPECT_NE(key, content_key({{"a", "1"}, {"b", "3"}}));
  EXPECT_NE(key, content_key({{"a", "1"}, {"c", "2"}}));
  EXPECT_NE(content_key({{"a", "12"}, {"", ""}}), content_key({{"a", "1"}, {"", "2"}}));
}

}  // namespace
}  // namespace photonproof
