// A guess at the origin of the picture, and possible changes of the guess.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "harness/diagnosis/diagnosis.h"
#include "harness/diagnosis/pictures/comparison.h"
#include "scenes/images/image.h"

namespace photonproof::inline harness_diagnosis {

/// The steps from the scene's light to the file: the view, then its turn, channels and values.
struct Guess {
  Image light;                                   ///< Linear.
  double shift_x = 0, shift_y = 0, zoom = 1;     ///< The view, in pixels.
  double blur = 0;                               ///< Pixels.
  std::size_t turn = 0, channels = 0, tone = 0;  ///< Rows of picture_changes.h.
  double scale = 1;
  std::vector<std::string> used;  ///< The probes and what-ifs that `light` contains.

  bool has(const std::string& name) const { return std::find(used.begin(), used.end(), name) != used.end(); }
};

Image predicted(const Guess& guess, double white);

struct Candidate {
  Guess guess;
  double left = 0;                     ///< The excess that Comparison finds beyond noise.
  double handicap = 1;                 ///< Above 1 for candidates with fitted numbers.
  std::vector<Finding> findings = {};  ///< Kind, sentence and cause of each change that it makes.
  bool placed = false;                 ///< Its sentence names the place of the difference.
  bool local = false;                  ///< It concerns only the part of the picture that differs.
  bool named = true;                   ///< It may become a sentence, and is not only a rival of others.
};

/// The share of the guess's excess that a candidate may leave if it explains nearly all.
inline constexpr double nearly_all = 0.15;

/// Adds all changes of one property of whole pictures (picture_changes.h), without the parts of the scene's light:
/// turn, channels, tone, rows of another length. `left`: the excess that the guess leaves; not all candidates that
/// leave more are added.
void add_arrangements(const Guess& guess, const Comparison& comparison, double left,
                      std::vector<Candidate>& candidates);
/// Adds other brightnesses, and other or less sharp views. As above.
void add_brightness(const Guess& guess, const Comparison& comparison, double left, std::vector<Candidate>& candidates);
void add_views(const Guess& guess, const Comparison& comparison, double left, std::vector<Candidate>& candidates);
/// Adds changes of light in the scene: features, formulas of direct light, objects.
void add_light_candidates(const Guess& guess, const SceneKnowledge& knowledge, const Comparison& comparison,
                          std::vector<Candidate>& candidates);
/// Adds what-ifs, only the rare or only the other ones. The blocks of their pixels must have a twentieth of `excess`,
/// which the guess leaves, or a fifth where they change no other pixels. No others are rendered.
void add_what_ifs(const Guess& guess, const SceneKnowledge& knowledge, const Comparison& comparison,
                  const Excess& excess, bool rare, std::vector<Candidate>& candidates);
/// "the image is shifted by 3 pixels right".
Finding shift_finding(double x, double y);

/// "0.6", "1.5", "12": a factor rounded for readers.
std::string factor_text(double factor);

}  // namespace photonproof::inline harness_diagnosis
