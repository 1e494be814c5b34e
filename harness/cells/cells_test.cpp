#include "harness/cells/cells.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace photonproof::inline harness_cells {
namespace {

// `seeds` cells by each of the engines A, B and C.
std::vector<Cell> ordered(std::uint64_t seeds, std::uint64_t order_seed) {
  std::vector<Cell> cells;
  for (const char* engine : {"A", "B", "C"})
    for (std::uint64_t seed = 0; seed < seeds; ++seed) cells.push_back({"s", engine, {"spp", 1}, seed});
  return interleaved_by_engine(cells, order_seed);
}

std::string engines_of(const std::vector<Cell>& cells, std::size_t first, std::size_t count) {
  std::string engines;
  for (std::size_t i = first; i < first + count; ++i) engines += cells[i].engine;
  return engines;
}

TEST(Cells, every_other_round_reverses_the_one_before) {
  const std::vector<Cell> cells = ordered(8, 1);
  std::set<std::string> rounds;
  for (std::size_t i = 0; i < 24; i += 6) {
    const std::string there = engines_of(cells, i, 3), back = engines_of(cells, i + 3, 3);
    EXPECT_EQ(std::string(there.rbegin(), there.rend()), back);
    EXPECT_EQ(std::set<char>(there.begin(), there.end()).size(), 3u);
    rounds.insert(there);
  }
  EXPECT_GT(rounds.size(), 1u);  // shuffled anew: four equal orders of six have probability 1/216, and seed 1 is fixed
}

TEST(Cells, engines_of_a_round_do_the_same_work_in_shuffled_order) {
  const std::vector<Cell> cells = ordered(8, 1);
  std::vector<std::uint64_t> seeds;
  for (std::size_t i = 0; i < 24; i += 3) {
    EXPECT_EQ(cells[i].seed, cells[i + 1].seed);
    EXPECT_EQ(cells[i].seed, cells[i + 2].seed);
    seeds.push_back(cells[i].seed);
  }
  EXPECT_FALSE(std::is_sorted(seeds.begin(), seeds.end()));
}

TEST(Cells, order_is_that_of_its_seed) {
  const auto labels = [](const std::vector<Cell>& cells) {
    std::string all;
    for (const Cell& cell : cells) all += cell.label() + "\n";
    return all;
  };
  EXPECT_EQ(labels(ordered(8, 1)), labels(ordered(8, 1)));
  EXPECT_NE(labels(ordered(8, 1)), labels(ordered(8, 2)));
}

TEST(Cells, engine_with_fewer_cells_is_done_earlier) {
  const std::vector<Cell> cells =
      interleaved_by_engine({{"s", "A", {"spp", 1}, 1}, {"s", "A", {"spp", 1}, 2}, {"s", "B", {"spp", 1}, 1}}, 1);
  ASSERT_EQ(cells.size(), 3u);
  EXPECT_EQ(cells[2].engine, "A");
}

TEST(Cells, no_cells_stay_no_cells) { EXPECT_TRUE(interleaved_by_engine({}, 1).empty()); }

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
}  // namespace photonproof::inline harness_cells
