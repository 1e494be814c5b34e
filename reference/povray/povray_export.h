// Lowers a scene to POV-Ray 3.7 scene description language. Everything written is meant to be physically equal to the
// scene. Anything else is refused; losses by POV-Ray's methods are declared with their size.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "reference/povray/povray_options.h"
#include "reference/povray/povray_pigments.h"
#include "reference/povray/sdl_text.h"
#include "scenes/description/description.h"

namespace photonproof::inline reference_povray {

struct PovrayExport {
  SdlText sdl;
  int width = 0, height = 0;              ///< Size of the whole film, of which a crop is kept.
  int grid = 1;                           ///< POV-Ray renders grid x width by grid x height.
  int margin = 0;                         ///< Pixels around the image, which its filter reaches.
  FilmDescription film{};                 ///< The film of that size.
  std::vector<PovFile> files{};           ///< Images that the text reads from its own folder.
  std::vector<std::string> antialias;     ///< POV-Ray's options for how it samples its pixels.
  bool is_noisy = false;                  ///< Made by paths: sub-pixels differ by chance.
  double exposure = 1;                    ///< POV-Ray's pixels are the scene's radiance times this power of two.
  std::vector<std::string> explanations;  ///< Every conversion; the comments of `sdl`.
  std::vector<std::string> skipped;       ///< Passes POV-Ray need not run, with the reason.
  std::vector<std::string> losses;        ///< Light that the image lacks, with its size.
  std::vector<PovrayExport> besides{};    ///< Exports whose images are added: PovrayOptions::lights_apart.
};

/// Writes the scene's text to a file and its images beside it, each whole or not at all. Throws InputError when one
/// cannot be written.
void write_sdl(const PovrayExport& scene, const std::filesystem::path& target);

/// Throws Unrepresentable with the place in a scene that POV-Ray cannot express, InputError for a bad option.
PovrayExport export_povray(const SceneDescription& scene, const PovrayOptions& options);

}  // namespace photonproof::inline reference_povray
