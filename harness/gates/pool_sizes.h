// The number of images that a self-test draws of each stream: an image of one may cost a thousand times another's.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace photonproof::inline harness_gates {

struct PoolSizes {
  int usual = 0;
  std::vector<std::pair<std::string, int>> special{};  ///< for streams whose label contains the text; the first match
                                                       ///< counts

  int of(const std::string& stream) const;
};

/// Reads "4000" and "photonmapper=160", in any order; `usual` is the default for the number alone. Throws InputError
/// about `option` for other texts, and for fewer than 2 images.
PoolSizes read_pool_sizes(const std::string& option, const std::vector<std::string>& texts, int usual);

}  // namespace photonproof::inline harness_gates
