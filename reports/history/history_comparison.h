// Two commits of a history against each other, as a pull request's comment shows them. It is made by harness/history.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "reports/history/history_view.h"

namespace photonproof::reports::inline reports_history {

enum class ChangeSide { better, worse };

/// A series that changed beyond its noise.
struct HistoryChange {
  SeriesKey key;
  ChangeSide side = ChangeSide::worse;
  HistoryStep step;  ///< from the base's level to the head; its `point` is not used
};

/// A gate whose verdict at the head is another than at the base, or is not a pass.
struct GateChange {
  SeriesKey key;
  std::optional<GateVerdict> base, head;
};

/// Pictures of one cell that differ; files are relative to the comment's folder.
struct PictureChange {
  std::string scene, engine, budget;
  std::string old_file, new_file, difference_file;  ///< the last is empty where sizes differ
  double flip = 0;                                  ///< mean FLIP of both pictures, 0 to 1
  std::string problem{};                            ///< why there is no difference; else empty
};

struct HistoryComparison {
  HistoryCommit base, head;
  std::vector<HistoryChange> changes;  ///< worse first, then the largest
  std::vector<GateChange> gates;
  std::vector<PictureChange> pictures;  ///< the largest FLIP first; at most as many as asked for
  std::size_t pictures_compared = 0, pictures_changed = 0;
  std::size_t compared = 0;   ///< series with a value at both commits that noise is known of
  std::size_t undecided = 0;  ///< series with too few commits or seeds to know their noise
  std::size_t only_base = 0, only_head = 0;
};

/// Whether a series changed for the worse, or a gate fails that did not fail before.
bool is_worse(const HistoryComparison& comparison);

/// "relMSE of path on cornell rose 12 % [9, 15]; 2 gates fail", or that nothing changed.
std::string comparison_sentence(const HistoryComparison& comparison);

/// The comment in GitHub's Markdown. `picture_url` comes before the names of pictures; empty: they lie beside it.
std::string comparison_markdown(const HistoryComparison& comparison, const std::string& picture_url);

}  // namespace photonproof::reports::inline reports_history
