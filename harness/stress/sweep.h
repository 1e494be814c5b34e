// A stress sweep: one feature of the renderer, climbed by one number until it breaks. Every level says what its picture
// has to be, by an invariance (another scene's picture) or a closed form (one radiance everywhere).
#pragma once

#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "scenes/description/description.h"

namespace photonproof::inline harness_stress {

class StressRunner;
struct LevelVerdict;

/// What has to be rendered for one level, or for what it is compared with.
struct StressScene {
  SceneDescription scene;
  int width = 24, height = 24;             ///< pixels
  std::vector<std::string> arguments{};    ///< of `photonproof render`, beside those that every level gets
  std::string replaced{}, replacement{};   ///< in the scene's text, for what no description can hold (nan, 1e400)
  std::vector<std::string> unlike_path{};  ///< arguments that only the level's own engine gets
};

struct Sweep {
  std::string feature;          ///< "shape sphere"
  std::string sweep_run;        ///< "scale up"
  std::string measure;          ///< what a level's height k means: "a unit of length of 10^k"
  std::vector<double> heights;  ///< ascending
  double wanted = 0;            ///< the height up to which pictures should be right; -1: none has to be
  std::function<StressScene(double)> level;
  /// What has this picture; empty where `radiance` is the closed form.
  std::function<StressScene(double)> alike{};
  std::optional<double> radiance{};
  /// The level's picture over what it is compared with.
  std::function<double(double)> factor = [](double) { return 1.0; };
  std::vector<std::string> engines{};  ///< empty: all
  bool goes_on = false;                ///< beyond a level that is refused: heights are a list, not a size
  bool is_turned = false;              ///< no face lies along an axis
  bool takes_long = false;             ///< is begun first, so that no core has to wait for it at the end
  bool must_refuse = false;            ///< a picture without a warning is wrong
  std::string compared_with{};         ///< the engine that renders `alike`; empty: the level's own
  /// In place of a render: a level that another verb of the program decides.
  std::function<LevelVerdict(double, const StressRunner&)> measured{};
  double quick = std::numeric_limits<double>::quiet_NaN();  ///< the height that --quick climbs to; NaN: `wanted`
  std::string name() const { return feature + ", " + sweep_run; }
};

/// Each level's scene turned as a whole (climbs.h), what it is compared with not. Where a level is text, it stays.
/// Precondition: levels are scenes.
Sweep turned(Sweep sweep);

/// The integrators that climb where nothing else is said.
const std::vector<std::string>& stress_engines();

/// All sweeps. What scenes need beside their text (meshes, images) is written to `assets`, which exists.
std::vector<Sweep> stress_sweeps(const std::filesystem::path& assets);

}  // namespace photonproof::inline harness_stress
