// Arranges results.json for a reader: by scene, engine, budget and seed. Both report formats print this view. It
// selects and sorts; it computes no number.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "reports/record/results.h"

namespace photonproof::reports::inline reports_view {

/// The results of one engine on one scene.
struct EngineOutcome {
  std::size_t engine = 0;            ///< index into View::engines
  std::vector<const Result*> cells;  ///< by budget, then seed; without the reference
  std::size_t finished = 0;          ///< number of them that are ok
  /// The finished cell of the largest budget and its first seed, which pictures and the summary show. Budgets of
  /// several kinds have no order, so it is the kind that the record names last.
  const Result* shown = nullptr;
};

/// A metric and the parameters it was computed with.
struct MetricParameters {
  std::string metric;
  std::string parameters;
  friend bool operator==(const MetricParameters&, const MetricParameters&) = default;
};

struct SceneView {
  SceneRecord record;
  const Result* reference = nullptr;         ///< null when there is no finished one
  std::string reference_problem;             ///< the reason in that case, one sentence
  std::vector<EngineOutcome> engines;        ///< one for each of View::compared
  std::vector<MetricParameters> parameters;  ///< those that differ within the page, merged
  std::vector<const GateRecord*> gates;      ///< worst first
  std::optional<GateVerdict> verdict;        ///< the worst of its gates
  std::vector<const Convergence*> curves;
};

/// A failing tile and the gate that found it.
struct RankedTile {
  const GateRecord* gate = nullptr;
  const FailingTile* tile = nullptr;
};

/// Cells of one engine on one scene that ended in the same way for the same reason.
struct Failure {
  std::vector<const Result*> cells;  ///< at least one
};

struct View {
  std::vector<EngineRecord> engines;
  std::vector<std::size_t> compared;  ///< the engines to compare, without those that only made references
  std::vector<SceneView> scenes;
  std::vector<MetricParameters> parameters;  ///< those that hold for every number of the page
  std::vector<Failure> failures;             ///< all cells that are not ok, references included, in the page's order
  std::vector<const GateRecord*> gates;      ///< of all scenes, worst first
  std::vector<RankedTile> tiles;             ///< of all gates, largest score first
  std::vector<const ChangeRecord*> changes;  ///< regressions first
  std::vector<const RaceRecord*> races;
};

/// The view points into `results`, which must outlive it. Scenes and engines that only cells name are kept after the
/// listed ones, so that no measurement is left out. Scenes with failing gates come first, then those with inconclusive
/// gates.
View arrange(const Results& results);

/// Metrics of equal parameters as one entry, named "a, b".
std::vector<MetricParameters> merged(const std::vector<MetricParameters>& parameters);

/// Whether the scene has a reference: a finished cell or a stored image.
bool has_reference(const SceneView& scene);
/// "path, 4096 spp", "stored: path, 65536 samples", or "none".
std::string reference_text(const SceneView& scene);
/// The same with its time or its accuracy.
std::string reference_caption(const SceneView& scene);
/// Its PNG and its EXR, relative to the results folder; empty when there is none.
std::string reference_picture(const SceneView& scene);
std::string reference_image(const SceneView& scene);

/// The file of a picture's role, as in Result::pictures; empty where there is none.
std::string picture_file(const std::map<std::string, std::string>& pictures, const std::string& role);

/// The scene of this name; null where the view has none.
const SceneView* find_scene(const View& view, const std::string& name);

/// "wall-clock seconds" or "processor seconds of all threads".
std::string clock_text(Clock clock);
/// The clock of a record's curves, which one suite sets for all of them; wall time without curves.
Clock clock_of(const View& view);

/// The value of a metric, if the cell has it.
std::optional<double> metric(const Result& result, const std::string& name);

/// "64 spp", "1 000 000 photons", "10 seconds", "quality 3".
std::string budget_text(const Budget& budget);

/// "quality 4, seed 1", or "4 images, first quality 1, seed 1".
std::string failed_cells_text(const Failure& failure);

/// "exposure +1.5 EV" as every picture of the scene is shown.
std::string exposure_text(double stops);

/// ISO 8601 UTC as "2026-11-21 02:45:35 UTC"; other texts unchanged.
std::string time_text(const std::string& created);

/// The suite's title, or its name if the record has no title.
const std::string& heading(const Results& results);

/// "9 images: 8 finished, 1 did not", over the whole record.
std::string totals_text(const Results& results);

/// "10 gates: 8 pass, 1 fails, 1 inconclusive"; empty when there are none.
std::string verdicts_text(const std::vector<const GateRecord*>& gates);

/// The worst failing gate and the first clause of its sentence: "box by photon: light is missing: -42 % over 1698 px at
/// (0, 28)". Empty where none fails.
std::string failing_text(const View& view);

/// Index into View::engines of the engine with this name, which must occur in the record.
std::size_t engine_index(const View& view, const std::string& name);

}  // namespace photonproof::reports::inline reports_view
