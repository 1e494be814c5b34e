// The identity and the order of the cells of a run.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "harness/results.h"

namespace photonproof {

/// 32 hexadecimal digits that stand for named texts in their order (a version 5 UUID, that is 122 bits of SHA-1): equal
/// for equal lists, different for different ones, however the texts are cut into pieces.
std::string content_key(const std::vector<std::pair<std::string, std::string>>& parts);

/// The cells so that engines take turns and the turn reverses each round (A B C, C B A, A ...): a machine that slowly
/// gets slower or faster is shared by all of them. Within an engine the order stays.
std::vector<Cell> interleaved_by_engine(const std::vector<Cell>& cells);

}  // namespace photonproof
