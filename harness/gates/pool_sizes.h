// How many images of each stream a self-test draws: an image costs a thousand times more here than there.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace photonproof::inline harness_gates {

struct PoolSizes {
  int usual = 0;
  std::vector<std::pair<std::string, int>> special{};  ///< of streams whose label contains the text; the first counts

  int of(const std::string& stream) const;
};

/// From "4000" and "photonmapper=160", in any order; without a number alone, `usual`. Throws InputError about `option`
/// for what is neither, and for fewer than 2 images.
PoolSizes read_pool_sizes(const std::string& option, const std::vector<std::string>& texts, int usual);

}  // namespace photonproof::inline harness_gates
