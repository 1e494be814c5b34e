// Lowers a scene to Python for Blender 3.4, whose Cycles is a second unbiased path tracer that shares no code with
// ours. Everything written is meant to be physically equal to the scene; anything else is refused by name.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "reference/cycles/cycles_options.h"
#include "reference/cycles/cycles_script.h"
#include "reference/engines/batches.h"
#include "scenes/description/description.h"

namespace photonproof::inline reference_cycles {

struct CyclesExport {
  std::string text;                       ///< The scene's own lines.
  std::vector<CyclesFile> files;          ///< Files that the lines read from the text's own folder.
  std::vector<std::string> explanations;  ///< Every conversion; the comments of `text`.
  int width = 0, height = 0;              ///< Size of the whole film, of which a crop is kept.
  FilmDescription film;                   ///< The film of that size.
  int samples = 0;
  int threads = 0;
  std::vector<EngineBatch> batches;  ///< picture i goes to batch_i.exr in the text's own folder
};

/// Throws NotRepresentable with the place of what Cycles cannot express.
CyclesExport export_cycles(const SceneDescription& scene, const CyclesOptions& options);

/// The building blocks (blender_*.py) followed by the scene's lines: the script that `blender -b --python` runs.
std::string whole_script(const CyclesExport& scene);

/// Writes the whole script and the files that it reads beside it, each whole or not at all. Throws InputError when one
/// cannot be written.
void write_script(const CyclesExport& scene, const std::filesystem::path& target);

}  // namespace photonproof::inline reference_cycles
