// Lowers a scene to Mitsuba 3.9's own scene language, whose path tracers share no code with ours. Everything written is
// meant to be physically equal to the scene; anything else is refused by name.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "reference/engines/batches.h"
#include "reference/engines/not_representable.h"
#include "scenes/description/description.h"

namespace photonproof::inline reference_mitsuba {

struct MitsubaOptions {
  int width = 0;    ///< In pixels. 0: the scene's film.
  int height = 0;   ///< In pixels. 0: the scene's film.
  int samples = 0;  ///< Per pixel. 0: the scene's sampler.
  int threads = 0;  ///< 0: every core.
  std::uint64_t seed = 1;
  std::string variant = "auto";  ///< Mitsuba's name of one, or "auto": llvm_ad_rgb where LLVM is found.
  std::string stem = "scene";    ///< Prefix of the files that the text reads from its folder.
};

/// An image, or a mesh.
struct MitsubaFile {
  std::string name;
  std::shared_ptr<const Image> image;
  std::shared_ptr<const TriangleMesh> mesh;
};

struct MitsubaExport {
  std::string text;                       ///< The scene file.
  std::vector<MitsubaFile> files;         ///< Files that it reads from its own folder.
  std::vector<std::string> explanations;  ///< Every conversion; a comment at the head of `text`.
  /// Kinds of plugin that Mitsuba lacks and our script registers before it loads the scene; mitsuba_plugins.py.
  std::vector<std::string> plugins;
  int samples = 0;
  int threads = 0;
  std::string variant;
  BatchedPicture picture;  ///< the whole film's size, and the batches
};

/// Throws NotRepresentable with the place of what Mitsuba cannot express.
MitsubaExport export_mitsuba(const SceneDescription& scene, const MitsubaOptions& options);

/// Writes the scene file and the files that it reads beside it, each whole or not at all. Throws InputError when one
/// cannot be written.
void write_mitsuba(const MitsubaExport& scene, const std::filesystem::path& target);

/// The script that renders such a file: `python3 render.py SCENE.xml OPTIONS.json FOLDER`.
std::string mitsuba_script();
/// The options that the script reads.
std::string mitsuba_job(const MitsubaExport& scene);

}  // namespace photonproof::inline reference_mitsuba
