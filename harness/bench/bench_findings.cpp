#include "harness/bench/bench_findings.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "scenes/base/input_error.h"
#include "scenes/description/film_part.h"

namespace photonproof::inline harness_bench {
namespace {

std::optional<Image> image_in_folder(const Result& result, const std::filesystem::path& folder) {
  try {
    return read_stored((folder / result.image).string()).mean;
  } catch (const InputError&) {
    return std::nullopt;
  }
}

std::string label_without_seed(const Cell& cell) { return cell.scene + "/" + cell.engine + "/" + cell.budget.label(); }

bool may_be_the_same(const Result& a, const Result& b) {
  return std::ranges::equal(a.metrics, b.metrics,
                            [](const MetricValue& x, const MetricValue& y) { return x.value == y.value; });
}

// Groups of two seeds or more with the same image. Different images have different metrics, so few files are read.
std::vector<std::vector<const Result*>> groups_of_same(std::vector<const Result*> seeds,
                                                       const std::filesystem::path& folder) {
  std::vector<std::vector<const Result*>> groups;
  while (seeds.size() > 1) {
    const Result* first = seeds.front();
    seeds.erase(seeds.begin());
    std::vector<const Result*> same{first};
    std::optional<Image> image;
    std::erase_if(seeds, [&](const Result* other) {
      if (!may_be_the_same(*first, *other)) return false;
      if (!image) image = image_in_folder(*first, folder);
      const std::optional<Image> again = image_in_folder(*other, folder);
      const bool equal = image && again && again->rgb == image->rgb;
      if (equal) same.push_back(other);
      return equal;
    });
    if (same.size() > 1) groups.push_back(std::move(same));
  }
  return groups;
}

std::string sentence_of(const std::vector<const Result*>& same, std::size_t seeds) {
  if (same.size() == seeds)
    return fmt::format("all {} seeds gave the same image; its noise is unknown, and need not be zero", seeds);
  std::string list;
  for (const Result* result : same) list += (list.empty() ? "" : ", ") + std::to_string(result->cell.seed);
  return fmt::format("seeds {} gave the same image, which counts once; other seeds may not be independent either",
                     list);
}

bool is_reference_itself(const Result& result) {
  return std::ranges::any_of(result.metrics,
                             [](const MetricValue& metric) { return metric.name == "max_abs" && metric.value == 0; });
}

}  // namespace

std::vector<std::string> findings_of_bench(const Results& results, const std::filesystem::path& folder) {
  std::vector<std::string> findings;
  std::vector<std::vector<const Result*>> groups;  // grouped by everything except the seed
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
    for (const auto& same : groups_of_same(seeds, folder))
      findings.push_back(label_without_seed(seeds.front()->cell) + ": " + sentence_of(same, seeds.size()));
  return findings;
}

void note_absent_instructions(Results& results) {
  const auto finished = [](const Result& result) { return result.status == Status::ok; };
  if (std::ranges::any_of(results.results, finished) &&
      std::ranges::none_of(results.results, [](const Result& result) { return result.instructions.has_value(); }))
    results.versions["instructions"] = "not counted by this kernel";
}

}  // namespace photonproof::inline harness_bench
