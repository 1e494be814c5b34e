// The identity and the order of the cells of a run.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "harness/suites/engines.h"
#include "reports/record/results.h"

namespace photonproof::inline harness_cells {

/// 32 hexadecimal digits that identify named texts in their order (a version 5 UUID, 122 bits of SHA-1). Lists that
/// differ have different keys, even if the joined texts are equal.
std::string content_key(const std::vector<std::pair<std::string, std::string>>& parts);

/// Joins the texts with the length before each, so that different lists never join to the same text.
std::string length_prefixed(const std::vector<std::string>& texts);
/// The parts of an engine's row that decide its images, for content_key: its command, and its layer if it has one.
std::string engine_content(const Engine& engine);

/// Orders the cells so that engines take turns. Every other round has a random order, and the next round reverses it (C
/// A B, B A C, A C B, ...). So a slow drift of the machine's speed affects all engines alike. Within an engine, scenes,
/// budgets and seeds are shuffled, in the same way for all engines. Both depend on `seed` alone.
std::vector<Cell> interleaved_by_engine(const std::vector<Cell>& cells, std::uint64_t seed);

}  // namespace photonproof::inline harness_cells
