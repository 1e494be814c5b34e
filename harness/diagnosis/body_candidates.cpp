// Of objects whose pixels say by themselves what is wrong: something else is seen in their place, or whatever is seen
// there is none of what the usual mistakes show. Renders nothing.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "harness/diagnosis/guess.h"
#include "harness/diagnosis/places.h"
#include "harness/pixels/middle_of.h"

namespace photonproof::inline harness_diagnosis {
namespace {

constexpr std::size_t least_pixels = 12;
constexpr double least_share = 0.75;  // of what differs: else the body has moved, or its light has

struct Mean {
  double sum[3] = {}, count = 0;
  void add(const float* rgb, double white) {
    for (std::size_t c = 0; c < 3; ++c) sum[c] += std::min(white, double{rgb[c]});
    count += 1;
  }
  double of(std::size_t c) const { return sum[c] / std::max(count, 1.0); }
};

/// Of the channel that differs most.
double largest_ratio(const Mean& a, const Mean& b) {
  constexpr double dark = 0.004;
  double most = 1;
  for (std::size_t c = 0; c < 3; ++c) {
    const double ratio = std::max(a.of(c), dark) / std::max(b.of(c), dark);
    most = std::max({most, ratio, 1 / ratio});
  }
  return most;
}

class BodyCandidates {
 public:
  BodyCandidates(const Guess& guess, const SceneKnowledge& knowledge, const Comparison& comparison)
      : guess_(guess), knowledge_(knowledge), comparison_(comparison) {}

  /// What is seen there continues what is seen around it, which it should not.
  void add_missing(std::vector<Candidate>& candidates) const {
    if (!is_as_seen()) return;
    for (std::size_t mark = 1; mark <= knowledge_.landmarks.size(); ++mark) {
      const std::string& name = knowledge_.landmarks[mark - 1].name;
      if (guess_.has("missing " + name)) continue;
      const std::vector<std::uint8_t> around = ring_of(mark);
      Mean here, expected, beside, expected_beside;
      for (std::size_t i = 0; i < around.size(); ++i) {
        if (!comparison_.counts(i)) continue;
        const bool inside = knowledge_.seen[i] == mark;
        if (!inside && around[i] == 0) continue;
        (inside ? here : beside).add(&comparison_.submitted().rgb[3 * i], comparison_.white());
        (inside ? expected : expected_beside).add(&guess_.light.rgb[3 * i], comparison_.white());
      }
      if (std::min(here.count, beside.count) < static_cast<double>(least_pixels)) continue;
      if (largest_ratio(here, beside) > 1.2 || largest_ratio(expected, expected_beside) < 1.6) continue;
      Candidate candidate = with_pixels(mark, "missing " + name, [&](std::size_t, std::size_t c) {
        return static_cast<float>(expected_beside.of(c));
      });
      candidate.handicap = 1.15;
      candidate.said = {{"object-missing",
                         "the " + name + " is missing",
                         "it is not in the scene, or no ray finds it: what lies behind is seen",
                         {},
                         0}};
      candidates.push_back(std::move(candidate));
    }
  }

  void add_wrong(const Excess& excess, std::vector<Candidate>& candidates) const {
    if (!is_as_seen()) return;
    for (std::size_t mark = 1; mark <= knowledge_.landmarks.size(); ++mark) {
      const std::string& name = knowledge_.landmarks[mark - 1].name;
      if (!names_body(name) || guess_.has("wrong " + name) || share_of(mark, excess) < least_share) continue;
      Candidate candidate = with_pixels(
          mark, "wrong " + name, [&](std::size_t i, std::size_t c) { return comparison_.submitted().rgb[3 * i + c]; });
      candidate.handicap = 1.6;
      candidate.said = {
          shows_others(name)
              ? words_of_wrong_view(name)
              : Finding{"object-wrong", "the " + name + " is shaded wrongly", "its normals, or its material", {}, 0}};
      candidates.push_back(std::move(candidate));
    }
  }

  /// Its light is about as much as it should be, but not what should be seen there.
  void say_distorted(std::vector<Finding>& findings) const {
    if (!is_as_seen()) return;
    const Image guess = predicted(guess_, comparison_.white());
    const double usual = middle_of(differences(guess, [this](std::size_t i) { return !shows_others(name_at(i)); }));
    for (std::size_t mark = 1; mark <= knowledge_.landmarks.size(); ++mark) {
      const std::string& name = knowledge_.landmarks[mark - 1].name;
      const auto says_it = [&](const Finding& f) { return f.sentence.find("the " + name) != std::string::npos; };
      if (!shows_others(name) || std::any_of(findings.begin(), findings.end(), says_it)) continue;
      const std::vector<std::uint8_t> edge = edge_of(mark);
      const std::vector<double> inside =
          differences(guess, [&](std::size_t i) { return knowledge_.seen[i] == mark && edge[i] == 0; });
      if (inside.size() < least_pixels) continue;
      const double mean = std::accumulate(inside.begin(), inside.end(), 0.0) / static_cast<double>(inside.size());
      if (mean > std::max(plainly_seen, 4 * usual)) findings.push_back(words_of_wrong_view(name));
    }
  }

 private:
  static constexpr double plainly_seen = 0.04;  // of white's square root

  static bool shows_others(const std::string& name) {
    return name.find("glass") != std::string::npos || name.find("mirror") != std::string::npos;
  }
  static Finding words_of_wrong_view(const std::string& name) {
    return {"object-wrong",
            "what the " + name + " shows is wrong",
            "its normals, or the directions of its reflected and refracted rays",
            {},
            0};
  }
  std::string name_at(std::size_t pixel) const {
    const std::size_t mark = knowledge_.seen[pixel];
    return mark > 0 ? knowledge_.landmarks[mark - 1].name : "";
  }

  /// Between the picture and the guess, of each pixel that is `wanted`.
  template <class Wanted>
  std::vector<double> differences(const Image& guess, const Wanted& wanted) const {
    std::vector<double> all;
    for (std::size_t i = 0; i < guess.pixels(); ++i) {
      if (!comparison_.counts(i) || !wanted(i)) continue;
      double sum = 0;
      for (std::size_t c = 0; c < 3; ++c)
        sum += std::abs(comparison_.shown(comparison_.submitted().rgb[3 * i + c]) -
                        comparison_.shown(guess.rgb[3 * i + c]));
      all.push_back(sum / 3);
    }
    return all;
  }

  /// Its pixels beside others' pixels.
  std::vector<std::uint8_t> edge_of(std::size_t mark) const {
    std::vector<std::uint8_t> edge(knowledge_.seen.size());
    for (std::size_t other = 0; other <= knowledge_.landmarks.size(); ++other)
      if (other != mark) for_each_near(other, 1, [&](std::size_t i) { edge[i] = knowledge_.seen[i] == mark; });
    return edge;
  }

  bool is_as_seen() const { return knowledge_.seen.size() == guess_.light.pixels() && guess_.shows_scene_as_it_is(); }

  /// Pixels that are not its own, two pixels around.
  std::vector<std::uint8_t> ring_of(std::size_t mark) const {
    std::vector<std::uint8_t> ring(knowledge_.seen.size());
    for_each_near(mark, 2, [&](std::size_t i) { ring[i] = knowledge_.seen[i] != mark; });
    return ring;
  }

  template <class Do>
  void for_each_near(std::size_t mark, int reach, const Do& act) const {
    const int width = comparison_.width(), height = comparison_.height();
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        if (knowledge_.seen[index(x, y)] != mark) continue;
        for (int ny = std::max(0, y - reach); ny <= std::min(height - 1, y + reach); ++ny)
          for (int nx = std::max(0, x - reach); nx <= std::min(width - 1, x + reach); ++nx) act(index(nx, ny));
      }
  }
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(comparison_.width()) + static_cast<std::size_t>(x);
  }

  /// Of what differs, in the blocks that it lies in.
  double share_of(std::size_t mark, const Excess& excess) const {
    std::vector<std::uint8_t> inside(excess.block.size());
    for_each_near(mark, 0, [&](std::size_t i) {
      const std::size_t width = static_cast<std::size_t>(comparison_.width());
      inside[i / width / Comparison::side * static_cast<std::size_t>(comparison_.across()) +
             i % width / Comparison::side] = 1;
    });
    double sum = 0, all = 0;
    for (std::size_t i = 0; i < inside.size(); ++i) {
      all += excess.block[i];
      sum += inside[i] * excess.block[i];
    }
    return all > 0 ? sum / all : 0;
  }

  /// The guess with other light there and in the pixels beside, whose edge may lie in them.
  template <class Light>
  Candidate with_pixels(std::size_t mark, const std::string& name, const Light& light) const {
    Candidate candidate;
    candidate.guess = guess_;
    for_each_near(mark, 1, [&](std::size_t i) {
      for (std::size_t c = 0; c < 3; ++c) candidate.guess.light.rgb[3 * i + c] = light(i, c);
    });
    candidate.guess.used.push_back(name);
    candidate.left = comparison_.total(predicted(candidate.guess, comparison_.white()));
    candidate.local = true;
    return candidate;
  }

  const Guess& guess_;
  const SceneKnowledge& knowledge_;
  const Comparison& comparison_;
};

}  // namespace

void add_missing_objects(const Guess& guess, const SceneKnowledge& knowledge, const Comparison& comparison,
                         std::vector<Candidate>& candidates) {
  BodyCandidates(guess, knowledge, comparison).add_missing(candidates);
}

void say_distorted_bodies(const Guess& guess, const SceneKnowledge& knowledge, const Comparison& comparison,
                          std::vector<Finding>& findings) {
  BodyCandidates(guess, knowledge, comparison).say_distorted(findings);
}

void add_wrong_bodies(const Guess& guess, const SceneKnowledge& knowledge, const Comparison& comparison,
                      const Excess& excess, std::vector<Candidate>& candidates) {
  BodyCandidates(guess, knowledge, comparison).add_wrong(excess, candidates);
}

}  // namespace photonproof::inline harness_diagnosis
