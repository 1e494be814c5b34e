// The identity and the order of the cells of a run.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "harness/suites/engines.h"
#include "reports/record/results.h"

namespace photonproof::inline harness_cells {

/// 32 hexadecimal digits that stand for named texts in their order (a version 5 UUID, that is 122 bits of SHA-1): equal
/// for equal lists, different for different ones, however the texts are cut into pieces.
std::string content_key(const std::vector<std::pair<std::string, std::string>>& parts);

/// The texts as one, the length before each, so that none can pose as the next.
std::string length_prefixed(const std::vector<std::string>& texts);
/// The parts of an engine's row that decide its images, for content_key: its command, and its layer where it has one.
std::string engine_content(const Engine& engine);

/// The cells so that engines take turns, in an order that is drawn for every other round and reversed in between (C A
/// B, B A C, A C B, ...): a machine that slowly gets slower or faster is shared by all of them. Within an engine,
/// scenes, budgets and seeds are shuffled, all engines' in the same way. Both depend on `seed` alone.
std::vector<Cell> interleaved_by_engine(const std::vector<Cell>& cells, std::uint64_t seed);

}  // namespace photonproof::inline harness_cells
