#include "scenes/images/test_image_promises.h"

#include <algorithm>
#include <cstring>
#include <vector>

#include "scenes/base/test_fuzz.h"
#include "scenes/images/image.h"

namespace photonproof::inline scenes_images {
namespace {

constexpr std::size_t most_values = std::size_t{1} << 18;

/// Rows that are read twice must be the same, bit for bit.
std::string problem_with_rows(ImageRows& rows) {
  const auto row = 3 * static_cast<std::size_t>(rows.width());
  const int count = std::min(rows.height(), static_cast<int>(std::max<std::size_t>(most_values / row, 1)));
  std::vector<float> at_once(row * static_cast<std::size_t>(count)), single(row);
  for (const int begin : {0, rows.height() - count}) {
    std::fill(at_once.begin(), at_once.end(), -1.0f);
    rows.read(begin, begin + count, at_once.data());
    for (const int i : {count - 1, count / 2, 0}) {
      std::fill(single.begin(), single.end(), -2.0f);
      rows.read(begin + i, begin + i + 1, single.data());
      if (std::memcmp(single.data(), at_once.data() + row * static_cast<std::size_t>(i), row * sizeof(float)) != 0)
        return "row " + std::to_string(begin + i) + " is another when it is read alone";
    }
  }
  return {};
}

}  // namespace

std::string problem_with_image(const std::filesystem::path& file) {
  try {
    ImageRows rows(file.string());
    if (rows.width() <= 0 || rows.height() <= 0) return "an image without pixels was opened";
    const auto pixels = static_cast<std::size_t>(rows.width()) * static_cast<std::size_t>(rows.height());
    if (std::string problem = problem_with_rows(rows); !problem.empty()) return problem;
    if (3 * pixels > most_values) return {};
    const Rendering rendering = read_rendering(file.string());
    if (rendering.mean.pixels() != pixels) return "another size as a whole than by rows";
    if (rendering.variance && rendering.variance->pixels() != pixels) return "a variance of another size";
  } catch (const InputError& error) {
    return problem_with_message(error);
  }
  return {};
}

}  // namespace photonproof::inline scenes_images
