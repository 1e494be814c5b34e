// What is planted to learn what gates find: mutants, which they must find, and nulls, of which they must not complain.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "scenes/images/image.h"

namespace photonproof::inline harness_gates {

/// Where a mutant is: a fault (scenes/base/faults.h) of the engine, of what draws and reads images here, of what judges
/// them, or an edit of the finished image.
enum class PlantedIn { renderer, drawing, judging, image, nothing };

/// Something done to an engine's images, to the engine, or to us.
struct GateVariant {
  std::string name{};  ///< "one-pixel shift"; of a fault, the one by which it is planted
  std::string what{};  ///< in plain words
  PlantedIn planted = PlantedIn::nothing;
  Image (*change)(const Image& image) = nullptr;  ///< of an edit
  /// Those of our engines that can have the fault or know the arguments, by the value of --integrator; empty: all.
  std::vector<std::string> integrators{};
  std::vector<std::string> further{};  ///< arguments after the engine's own
  int threads = 0;                     ///< of the engine; 0: the suite's

  bool is_mutant() const { return planted != PlantedIn::nothing; }
  bool is_fault_of_harness() const { return planted == PlantedIn::drawing || planted == PlantedIn::judging; }
  /// Variants whose images come out of the engine as they do without them share those.
  bool draws_its_own() const {
    return planted == PlantedIn::renderer || planted == PlantedIn::drawing || !further.empty() || threads > 0;
  }
};

/// Mutants first: the renderer's, the harness's, edits of images.
std::span<const GateVariant> gate_variants();

/// Arguments for those kernels that photonproof-faulty has faults in (renderer/CMakeLists.txt). None for integrators
/// without.
std::vector<std::string> kernels_with_faults(const std::string& integrator);

}  // namespace photonproof::inline harness_gates
