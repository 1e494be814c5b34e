#include "harness/diagnosis/black_lines.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

#include "harness/pixels/middle_of.h"

namespace photonproof::inline harness_diagnosis {
namespace {

/// The picture, read along rows or along columns.
struct Lines {
  const Image& image;
  bool rows;
  int count() const { return rows ? image.height : image.width; }
  int length() const { return rows ? image.width : image.height; }
  const float* pixel(int line, int at) const { return rows ? image.pixel(at, line) : image.pixel(line, at); }
};

double seen(float v) { return std::sqrt(std::clamp(v, 0.0f, 1.0f)); }

double black_share(const Lines& lines, int line) {
  double black = 0;
  for (int i = 0; i < lines.length(); ++i) {
    const float* p = lines.pixel(line, i);
    black += p[0] <= 1.5f / 255 && p[1] <= 1.5f / 255 && p[2] <= 1.5f / 255;
  }
  return black / lines.length();
}

/// Brightness of the line over the mean of its two neighbours, as the median over pixels and channels.
double step_of(const Lines& lines, int line) {
  std::vector<double> steps;
  for (int i = 0; i < lines.length(); ++i)
    for (int c = 0; c < 3; ++c)
      steps.push_back(seen(lines.pixel(line, i)[c]) -
                      (seen(lines.pixel(line - 1, i)[c]) + seen(lines.pixel(line + 1, i)[c])) / 2);
  return middle_of(std::move(steps));
}

/// Black lines beside which the picture is hardly black: a dark part of a picture has black lines by chance.
std::vector<int> black_lines(const Lines& lines) {
  constexpr double most_black = 0.2;
  std::vector<double> share;
  for (int line = 0; line < lines.count(); ++line) share.push_back(black_share(lines, line));
  std::vector<int> found;
  for (int line = 0; line < lines.count(); ++line) {
    if (share[static_cast<std::size_t>(line)] < 0.85) continue;
    double before = 1, after = 1;
    for (int d = 1; d <= 3; ++d) {
      if (line - d >= 0) before = std::min(before, share[static_cast<std::size_t>(line - d)]);
      if (line + d < lines.count()) after = std::min(after, share[static_cast<std::size_t>(line + d)]);
    }
    const bool first = line < 2, last = line >= lines.count() - 2;
    if ((before < most_black || first) && (after < most_black || last) && std::min(before, after) < most_black)
      found.push_back(line);
  }
  // The surroundings of a scene may be black: lines at the image's edge alone are no seam.
  if (std::all_of(found.begin(), found.end(), [&](int line) { return line < 2 || line >= lines.count() - 2; }))
    found.clear();
  return found;
}

/// Evenly spaced lines that stand out from their neighbours, in the picture and not in the reference.
std::vector<int> seams(const Lines& lines, const Lines& expected) {
  std::vector<int> found;
  std::vector<double> steps;
  for (int line = 1; line + 1 < lines.count(); ++line) steps.push_back(step_of(lines, line));
  std::vector<double> sizes;
  for (const double step : steps) sizes.push_back(std::abs(step));
  const double usual = std::max(0.002, middle_of(std::move(sizes)));
  for (int line = 2; line + 2 < lines.count(); ++line) {
    const double step = steps[static_cast<std::size_t>(line - 1)];
    if (std::abs(step) > 0.04 && std::abs(step) > 8 * usual && std::abs(step_of(expected, line)) < std::abs(step) / 3)
      found.push_back(line);
  }
  // A line that deviates makes its neighbours deviate the other way.
  std::erase_if(found, [&](int line) {
    const double own = std::abs(steps[static_cast<std::size_t>(line - 1)]);
    for (const int near : {line - 1, line + 1})
      if (near >= 1 && near + 1 < lines.count() && std::abs(steps[static_cast<std::size_t>(near - 1)]) > own)
        return true;
    return false;
  });
  return found;
}

/// The one distance between lines, 0 where there is none; neighbours count as one line.
int period_of(const std::vector<int>& lines, std::size_t least = 2) {
  std::vector<int> starts;
  for (const int line : lines)
    if (starts.empty() || line > starts.back() + 2) starts.push_back(line);
  if (starts.size() < least) return 0;
  const int period = starts[1] - starts[0];
  for (std::size_t i = 1; i + 1 < starts.size(); ++i)
    if (starts[i + 1] - starts[i] != period) return 0;
  return period;
}

std::string ordinal(int n) {
  const int tens = n % 100;
  const char* ending = tens >= 11 && tens <= 13 ? "th"
                       : n % 10 == 1            ? "st"
                       : n % 10 == 2            ? "nd"
                       : n % 10 == 3            ? "rd"
                                                : "th";
  return std::to_string(n) + ending;
}

/// "every 75th row", "row 75", "3 rows"
std::string words_for(const std::vector<int>& lines, int period, const char* name) {
  if (lines.size() == 1) return std::string(name) + " " + std::to_string(lines.front() + 1);
  return period > 0 ? "every " + ordinal(period) + " " + name : std::to_string(lines.size()) + " " + name + "s";
}

std::string sentence_of(const std::vector<int>& rows, const std::vector<int>& columns, const std::string& what) {
  const int row_period = period_of(rows), column_period = period_of(columns);
  if (!rows.empty() && !columns.empty() && row_period == column_period && row_period > 0)
    return "every " + ordinal(row_period) + " row and column " + "is " + what;
  std::string words;
  if (!rows.empty()) words = words_for(rows, row_period, "row");
  if (!columns.empty()) words += (words.empty() ? "" : " and ") + words_for(columns, column_period, "column");
  const bool one =
      rows.empty() != columns.empty() && (rows.size() + columns.size() == 1 || row_period + column_period > 0);
  return words + (one ? " is " : " are ") + what;
}

}  // namespace

std::optional<Finding> find_lines(const Image& submitted, const Image& reference, std::vector<std::uint8_t>& ignored) {
  if (std::min(submitted.width, submitted.height) < 8) return std::nullopt;
  const Lines rows{submitted, true}, columns{submitted, false};
  std::vector<int> odd_rows = black_lines(rows), odd_columns = black_lines(columns);
  std::string kind = "black-lines", what = "black";
  if (odd_rows.empty() && odd_columns.empty()) {
    odd_rows = seams(rows, {reference, true});
    odd_columns = seams(columns, {reference, false});
    if (period_of(odd_rows, 3) == 0) odd_rows.clear();
    if (period_of(odd_columns, 3) == 0) odd_columns.clear();
    kind = "seams";
    what = "off from its neighbours";
  }
  if (odd_rows.empty() && odd_columns.empty()) return std::nullopt;
  for (const int y : odd_rows)
    for (int x = 0; x < submitted.width; ++x)
      ignored[static_cast<std::size_t>(y) * static_cast<std::size_t>(submitted.width) + static_cast<std::size_t>(x)] =
          1;
  for (const int x : odd_columns)
    for (int y = 0; y < submitted.height; ++y)
      ignored[static_cast<std::size_t>(y) * static_cast<std::size_t>(submitted.width) + static_cast<std::size_t>(x)] =
          1;
  const double share = static_cast<double>(odd_rows.size()) / submitted.height +
                       static_cast<double>(odd_columns.size()) / submitted.width;
  return Finding{kind,
                 sentence_of(odd_rows, odd_columns, what),
                 "seams between tiles: their last row or column is left out or done twice",
                 {0, 0, submitted.width, submitted.height},
                 std::min(1.0, share)};
}

}  // namespace photonproof::inline harness_diagnosis
