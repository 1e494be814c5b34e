#include "harness/bench/bench_findings.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "scenes/images/image.h"
#include "scenes/text/input_error.h"

namespace photonproof {
namespace {

std::optional<Image> image_in_folder(const Result& result, const std::filesystem::path& folder) {
  try {
    return read_image((folder / result.image).string());
  } catch (const InputError&) {
    return std::nullopt;
  }
}

std::string label_without_seed(const Cell& cell) { return cell.scene + "/" + cell.engine + "/" + cell.budget.label(); }

bool all_the_same(const std::vector<const Result*>& seeds, const std::filesystem::path& folder) {
  const std::optional<Image> first = image_in_folder(*seeds.front(), folder);
  return first && std::all_of(seeds.begin() + 1, seeds.end(), [&](const Result* result) {
           const std::optional<Image> other = image_in_folder(*result, folder);
           return other && other->rgb == first->rgb;
         });
}

bool is_reference_itself(const Result& result) {
  return std::ranges::any_of(result.metrics,
                             [](const MetricValue& metric) { return metric.name == "max_abs" && metric.value == 0; });
}

}  // namespace

std::vector<std::string> findings_of_bench(const Results& results, const std::filesystem::path& folder) {
  std::vector<std::string> findings;
  std::vector<std::vector<const Result*>> groups;  // by all but the seed
  for (const Result& result : results.results) {
    if (result.status != Status::ok || result.image.empty()) continue;
    if (is_reference_itself(result))
      findings.push_back(result.cell.label() + ": its image is the reference itself, bit for bit");
    const auto same = std::ranges::find_if(groups, [&](const auto& group) {
      return label_without_seed(group.front()->cell) == label_without_seed(result.cell);
    });
    if (same == groups.end())
      groups.push_back({&result});
    else
      same->push_back(&result);
  }
  for (const auto& seeds : groups)
    if (seeds.size() > 1 && all_the_same(seeds, folder))
      findings.push_back(
          fmt::format("{}: all {} seeds gave the same image; its noise is not known, and not zero for that",
                      label_without_seed(seeds.front()->cell), seeds.size()));
  return findings;
}

}  // namespace photonproof
