// A stress sweep varies one feature of the renderer by one number until it breaks. Every level has an expected picture,
// by an invariance (another scene's picture) or a closed form (one radiance everywhere).
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

/// The scene and options of one level, or of the picture that it is compared with.
struct StressScene {
  SceneDescription scene;
  int width = 24, height = 24;             ///< Pixels.
  std::vector<std::string> arguments{};    ///< Arguments of `photonproof render`, in addition to those of every level.
  std::string replaced{}, replacement{};   ///< A replacement in the scene's text, for values that no description can
                                           ///< hold (nan, 1e400).
  std::vector<std::string> unlike_path{};  ///< Arguments that only the level's own engine gets.
};

struct Sweep {
  std::string feature;          ///< "shape sphere".
  std::string sweep_run;        ///< "scale up".
  std::string measure;          ///< The meaning of a level k: "a unit of length of 10^k".
  std::vector<double> heights;  ///< The levels, ascending.
  double wanted = 0;            ///< The level up to which pictures should be right; -1: no level.
  std::function<StressScene(double)> level;
  /// The scene with the same picture; empty where `radiance` is the closed form.
  std::function<StressScene(double)> alike{};
  std::optional<double> radiance{};
  /// The ratio of the level's picture to its expected picture.
  std::function<double(double)> factor = [](double) { return 1.0; };
  std::vector<std::string> engines{};  ///< Empty: all.
  bool goes_on = false;                ///< Continues beyond a refused level: the levels are a list, not a size.
  bool is_turned = false;              ///< No face lies along an axis.
  bool takes_long = false;             ///< Starts first, so that no core waits for it at the end.
  bool must_refuse = false;            ///< A picture without a warning is wrong.
  std::string compared_with{};         ///< The engine that renders `alike`; empty: the level's own.
  /// Replaces the render: another verb of the program decides the level.
  std::function<LevelVerdict(double, const StressRunner&)> measured{};
  double quick = std::numeric_limits<double>::quiet_NaN();  ///< The level that --quick runs up to; NaN: `wanted`.
  std::string name() const { return feature + ", " + sweep_run; }
};

/// Turns each level's scene as a whole (sweep_runs.h), but not the scene it is compared with. A level that is text
/// stays as it is. Precondition: levels are scenes.
Sweep turned(Sweep sweep);

/// The integrators of a sweep that names none.
const std::vector<std::string>& stress_engines();

/// All sweeps. The scenes' other files (meshes, images) are written to `assets`, which exists.
std::vector<Sweep> stress_sweeps(const std::filesystem::path& assets);

}  // namespace photonproof::inline harness_stress
