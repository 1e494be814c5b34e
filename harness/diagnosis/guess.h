// A guess at how the picture came about, and what may be changed about it.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "harness/diagnosis/diagnosis.h"
#include "harness/diagnosis/pictures/comparison.h"
#include "scenes/images/image.h"

namespace photonproof::inline harness_diagnosis {

/// From the light in the scene to the file: what is seen, then turned, its channels, its values.
struct Guess {
  Image light;                                   ///< linear
  double shift_x = 0, shift_y = 0, zoom = 1;     ///< the view, in pixels
  double blur = 0;                               ///< pixels
  std::size_t turn = 0, channels = 0, tone = 0;  ///< rows of picture_changes.h
  double scale = 1;
  std::vector<std::string> used;  ///< probes and what-ifs that are in `light`

  bool has(const std::string& name) const { return std::find(used.begin(), used.end(), name) != used.end(); }
};

Image predicted(const Guess& guess, double white);

struct Candidate {
  Guess guess;
  double left = 0;                 ///< what Comparison finds beyond noise
  double handicap = 1;             ///< above 1 for what has numbers to fit
  std::vector<Finding> said = {};  ///< kind, sentence and cause, for each change that it makes
  bool placed = false;             ///< where it differs is to be said
  bool local = false;              ///< it concerns the part of the picture that differs
};

/// A candidate that leaves no more than this share of what the guess leaves explains nearly all.
inline constexpr double nearly_all = 0.15;

/// All changes of one thing. Of whole pictures (picture_changes.h), without what the scene's light is made of: turned,
/// channels, tone, rows of another length.
/// `left`: by the guess. Those that leave more are not all among the candidates.
void add_arrangements(const Guess& guess, const Comparison& comparison, double left,
                      std::vector<Candidate>& candidates);
/// Another brightness; another view, or less sharp. As above.
void add_brightness(const Guess& guess, const Comparison& comparison, double left, std::vector<Candidate>& candidates);
void add_views(const Guess& guess, const Comparison& comparison, double left, std::vector<Candidate>& candidates);
/// Of light in the scene: features, formulas of direct light, objects.
void add_light_candidates(const Guess& guess, const SceneKnowledge& knowledge, const Comparison& comparison,
                          std::vector<Candidate>& candidates);
/// What-ifs that change pixels in whose blocks is a twentieth of `excess`, which the guess leaves, or a fifth where
/// they change no others: the rest is not rendered. Rare ones, or the others.
void add_what_ifs(const Guess& guess, const SceneKnowledge& knowledge, const Comparison& comparison,
                  const Excess& excess, bool rare, std::vector<Candidate>& candidates);
/// "the image is shifted by 3 pixels right".
Finding words_of_shift(double x, double y);

/// "0.6", "1.5", "12": a factor as people say it.
std::string factor_text(double factor);

}  // namespace photonproof::inline harness_diagnosis
