// Reads POV-Ray's output of a run: the +GS statistics file and the console.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace photonproof::inline reference_povray {

struct PovrayStatistics {
  std::map<std::string, double> phases;      ///< wall seconds: "parse", "bounding", "photon", "radiosity", "trace"
  std::map<std::string, double> cpu_phases;  ///< CPU seconds of the same
  /// "pixels", "rays", "shadow_rays", "photons_shot", "photons_stored", "radiosity_samples", "radiosity_rays"
  std::map<std::string, double> counts;
};

/// Reads the statistics. Values that the text does not mention are absent from the maps.
PovrayStatistics parse_povray_statistics(std::string_view text);

/// "3.7.0.10.unofficial", from the banner every run prints; empty when there is none.
std::string povray_version(std::string_view console);

/// Share of pixels done, from the last "Rendered N of M pixels" of a piece of the console.
std::optional<double> povray_progress(std::string_view console);

/// The lines of an error ("File 'scene.pov' line 3: Parse Error: ..."), joined; empty when there are none.
std::string povray_errors(std::string_view console);

}  // namespace photonproof::inline reference_povray
