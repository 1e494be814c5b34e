#include "harness/diagnosis/self_shadowing.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>

#include "harness/diagnosis/pictures/luminance.h"

namespace photonproof::inline harness_diagnosis {
namespace {

/// As logarithms of luminance over what is expected.
constexpr double lost = -0.15, gained = 0.15, kept = 0.08, step = 0.15;

class WallPixels {
 public:
  WallPixels(const Image& light, const SceneKnowledge& knowledge, const Comparison& comparison)
      : knowledge_(knowledge), width_(light.width), height_(light.height), ratio_(light.pixels()) {
    usable_.resize(light.pixels());
    for (std::size_t i = 0; i < usable_.size(); ++i) {
      const double now = luminance_of_pixel(&comparison.submitted().rgb[3 * i]);
      const double expected = luminance_of_pixel(&light.rgb[3 * i]), white = comparison.white();
      usable_[i] =
          comparison.counts(i) && is_wall(knowledge.seen[i]) && expected > 0.02 * white && expected < 0.95 * white;
      if (usable_[i]) ratio_[i] = std::log(std::max(now, 1e-3) / expected);
    }
  }

  /// Those whose neighbours are on the same wall.
  template <class Do>
  void for_each_inner(const Do& act) const {
    for (int y = 1; y + 1 < height_; ++y)
      for (int x = 1; x + 1 < width_; ++x)
        if (usable(x, y, 0, 0) && usable(x, y, 1, 0) && usable(x, y, -1, 0) && usable(x, y, 0, 1) &&
            usable(x, y, 0, -1))
          act(index(x, y));
  }
  /// 0 elsewhere.
  double ratio(std::size_t pixel) const { return ratio_[pixel]; }
  std::size_t right_of(std::size_t pixel) const { return pixel + 1; }
  std::size_t below(std::size_t pixel) const { return pixel + static_cast<std::size_t>(width_); }

 private:
  bool is_wall(std::uint16_t mark) const {
    if (mark == 0) return false;
    const std::string& name = knowledge_.landmarks[mark - 1u].name;
    return name.ends_with("wall") || name.ends_with("floor") || name.ends_with("ceiling") || name.ends_with("ground");
  }
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }
  bool usable(int x, int y, int dx, int dy) const {
    const std::size_t at = index(x + dx, y + dy);
    return usable_[at] != 0 && knowledge_.seen[at] == knowledge_.seen[index(x, y)];
  }

  const SceneKnowledge& knowledge_;
  int width_, height_;
  std::vector<double> ratio_;  ///< logarithms
  std::vector<std::uint8_t> usable_;
};

struct Losses {
  double all = 0, lost = 0, gained = 0, kept = 0;
  double edges = 0;  ///< pairs of neighbours, one lost and one that has kept far more

  bool are_of_self_shadowing() const {
    constexpr double least_pixels = 64, least_lost = 0.05, least_kept = 0.15, least_edges = 0.25;
    return all >= least_pixels && lost > least_lost * all && kept > least_kept * all && gained < 0.25 * lost &&
           edges > least_edges * lost;
  }
};

Losses losses_of(const WallPixels& walls) {
  Losses sum;
  walls.for_each_inner([&](std::size_t i) {
    const double r = walls.ratio(i);
    sum.all += 1;
    sum.lost += r < lost ? 1 : 0;
    sum.gained += r > gained ? 1 : 0;
    sum.kept += std::abs(r) < kept ? 1 : 0;
    for (const std::size_t next : {walls.right_of(i), walls.below(i)}) {
      const double other = walls.ratio(next);
      sum.edges += std::min(r, other) < lost && std::abs(r - other) > step ? 1 : 0;
    }
  });
  return sum;
}

}  // namespace

void add_self_shadowing(const Guess& guess, const SceneKnowledge& knowledge, const Comparison& comparison,
                        std::vector<Candidate>& candidates) {
  const char* const name = "self-shadowing";
  const Image& submitted = comparison.submitted();
  if (knowledge.seen.size() != submitted.pixels() || !guess.shows_scene_as_it_is() || guess.has(name)) return;
  const WallPixels walls(guess.light, knowledge, comparison);
  if (!losses_of(walls).are_of_self_shadowing()) return;
  Candidate candidate;
  candidate.guess = guess;
  for (std::size_t i = 0; i < submitted.pixels(); ++i)
    if (walls.ratio(i) < lost)
      for (std::size_t c = 0; c < 3; ++c) candidate.guess.light.rgb[3 * i + c] = submitted.rgb[3 * i + c];
  candidate.guess.used.push_back(name);
  candidate.left = comparison.total(predicted(candidate.guess, comparison.white()));
  candidate.handicap = 1.4;
  candidate.said = {{name,
                     "dark specks and blotches where surfaces shadow themselves (acne)",
                     "rays meet the surface that they start from: leave out what is nearer than an epsilon",
                     {},
                     0}};
  candidate.placed = candidate.local = true;
  candidates.push_back(std::move(candidate));
}

}  // namespace photonproof::inline harness_diagnosis
