// Which images are right, and who is fastest, in words: for the page, Markdown and the console.
#pragma once

#include <string>
#include <vector>

#include "reports/view/view.h"

namespace photonproof::reports::inline reports_view {

/// "right within 0.3 %", "biased +0.8 %", "biased in places", "noisy ±5 %", "unknown"; "right (regression only)" where
/// the reference shares the engine's sampling.
std::string verdict_text(const CorrectnessRecord& record);

/// Its sentence, and why it can only notice changes where that is so.
std::string sentence_of(const CorrectnessRecord& record);

/// The verdict on a budget of an engine on a scene; null when there is none.
const CorrectnessRecord* correctness_of(const SceneView& scene, const Cell& cell);

/// "finished" and not "ok": that an engine ended well says nothing of its image.
std::string status_text(Status status);

/// What makes right green, and nothing else.
const char* verdict_class(Correctness verdict);
/// One that is not told by its colour alone.
const char* verdict_symbol(Correctness verdict);

/// " †" where the scene's reference may not be believed: goes beside every number that was measured against it.
std::string doubt_mark(const SceneView& scene);
/// What the mark means; empty where there is none.
std::string doubt_text(const SceneView& scene);

/// "path" and its verdicts at the largest budgets: "right on 5 of 7 scenes; noisy on caustic-glass (±12 %)".
struct EngineGlance {
  std::size_t engine = 0;  ///< index into View::engines
  std::string text;
};
std::vector<EngineGlance> glances(const View& view);

/// "cornell: photonmapper reaches relMSE 0.0004 in 0.3 s, path in 1.2 s (4.0 times as long)": a line a race.
std::vector<std::string> race_texts(const View& view);

/// For the console: a line an engine and scene with its largest budget's verdict, error and time, then what marks mean.
std::string verdict_lines(const View& view);

}  // namespace photonproof::reports::inline reports_view
