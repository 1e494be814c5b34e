#include "harness/gates/pool_sizes.h"

#include <charconv>
#include <optional>

#include "scenes/base/input_error.h"

namespace photonproof::inline harness_gates {
namespace {

constexpr int least = 2, most = 1'000'000;

std::optional<int> count_in(const std::string& text) {
  int count = 0;
  const char* end = text.data() + text.size();
  const auto [stopped, error] = std::from_chars(text.data(), end, count);
  if (error != std::errc() || stopped != end || count < least || count > most) return std::nullopt;
  return count;
}

}  // namespace

int PoolSizes::of(const std::string& stream) const {
  for (const auto& [part, count] : special)
    if (stream.find(part) != std::string::npos) return count;
  return usual;
}

PoolSizes read_pool_sizes(const std::string& option, const std::vector<std::string>& texts, int usual) {
  PoolSizes sizes{usual};
  for (const std::string& text : texts) {
    const std::size_t equals = text.rfind('=');  // labels contain it, too: cornell/path/spp=16
    const std::string number = equals == std::string::npos ? text : text.substr(equals + 1);
    const std::optional<int> count = count_in(number);
    if (!count || equals == 0)
      throw InputError(option, "is '" + text + "', expected a number of images from 2 to 1000000, or a part of the " +
                                   "names of gates and a number: photonmapper=160");
    if (equals == std::string::npos)
      sizes.usual = *count;
    else
      sizes.special.emplace_back(text.substr(0, equals), *count);
  }
  return sizes;
}

}  // namespace photonproof::inline harness_gates
