// Variants planted to measure gates: mutants, which gates must find, and nulls, on which no gate may fail.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "scenes/images/image.h"

namespace photonproof::inline harness_gates {

/// The place of a mutant: a fault (scenes/base/faults.h) of the engine, of our drawing and reading of images, or of our
/// judging; or an edit of the finished image.
enum class PlantedIn { renderer, drawing, judging, image, nothing };

/// A change of an engine's images, of the engine, or of the harness.
struct GateVariant {
  std::string name{};  ///< "one-pixel shift", or the name that plants the fault
  std::string what{};  ///< description in plain words
  PlantedIn planted = PlantedIn::nothing;
  Image (*change)(const Image& image) = nullptr;  ///< for an edit
  /// Our engines that can have the fault or know the arguments, by the value of --integrator; empty: all.
  std::vector<std::string> integrators{};
  std::vector<std::string> further{};  ///< arguments after the engine's own
  int threads = 0;                     ///< the engine's threads; 0: the suite's

  bool is_mutant() const { return planted != PlantedIn::nothing; }
  bool is_fault_of_harness() const { return planted == PlantedIn::drawing || planted == PlantedIn::judging; }
  /// False for variants that share the unchanged images of the engine.
  bool draws_its_own() const {
    return planted == PlantedIn::renderer || planted == PlantedIn::drawing || !further.empty() || threads > 0;
  }
};

/// Mutants first: the renderer's, the harness's, edits of images.
std::span<const GateVariant> gate_variants();

/// Arguments that select the kernels with faults in photonproof-faulty (renderer/CMakeLists.txt). Empty for integrators
/// without such kernels.
std::vector<std::string> kernels_with_faults(const std::string& integrator);

}  // namespace photonproof::inline harness_gates
