// Texts about right images, for the page, Markdown and the console.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "reports/view/view.h"

namespace photonproof::reports::inline reports_view {

/// "right within 0.3 %", "biased +0.8 %", "biased −3 % in a block", "noisy ±5 %", "unknown". "right (regression only)"
/// if the reference shares the engine's sampling.
std::string verdict_text(const CorrectnessRecord& record);

/// Size of the bias that was seen, as a share of the image's light, or else the most that it can be of a block's. Empty
/// without one.
struct SeenBias {
  double size = 0;
  bool of_block = false;
};
std::optional<SeenBias> seen_bias(const CorrectnessRecord& record);

/// "1.9 % of a block's light".
std::string bias_text(const SeenBias& bias);

/// The verdict's sentence, with the reason if it can only detect changes.
std::string sentence_of(const CorrectnessRecord& record);

/// The verdict on a budget of an engine on a scene; null when there is none.
const CorrectnessRecord* correctness_of(const SceneView& scene, const Cell& cell);

/// "finished" instead of "ok": an engine may end well with a wrong image.
/// A verdict on images in words.
struct VerdictWord {
  const char *word, *brief, *meaning;  ///< `brief` has at most ten words
};
/// right, noisy, biased, unknown.
std::span<const VerdictWord> verdict_words();

std::string status_text(Status status);

/// A bias of at most this share of a block is shown without alarm.
inline constexpr double small_bias = 0.01;
/// CSS class of a verdict: "good" only for right, "poor" for a bias above small_bias, else "open".
const char* verdict_class(const CorrectnessRecord& record);
/// Symbol that shows the verdict without its colour.
const char* verdict_symbol(Correctness verdict);

/// " †" if the scene's reference is unreliable; follows every number that was measured against it.
std::string doubt_mark(const SceneView& scene);
/// Explanation of the mark; empty if there is none.
std::string doubt_text(const SceneView& scene);

/// "path" and its verdicts at the largest budgets: "right on 5 of 7 scenes; noisy on caustic-glass (±12 %)".
struct EngineGlance {
  std::size_t engine = 0;  ///< index into View::engines
  std::string text;
};
std::vector<EngineGlance> glances(const View& view);

/// Losses that engines declare, then the marks' meanings.
std::vector<std::string> verdict_notes(const View& view);

}  // namespace photonproof::reports::inline reports_view
