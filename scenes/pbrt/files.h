// Files that a pbrt scene names, and those that are written for it.
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>

#include "scenes/curves/curve_set.h"
#include "scenes/images/image.h"
#include "scenes/meshes/mesh.h"
#include "scenes/meshes/vol.h"
#include "scenes/pbrt/parameters.h"

namespace photonproof::inline scenes_pbrt {

/// Without a made folder nothing is written.
class PbrtFiles {
 public:
  PbrtFiles(const PbrtSources& sources, std::filesystem::path scene_folder, std::filesystem::path made_folder,
            bool allow_outside)
      : sources_(sources),
        scene_folder_(std::move(scene_folder)),
        made_folder_(std::move(made_folder)),
        allow_outside_(allow_outside) {}

  /// The path of an existing file that is spelled relative to the scene's folder. Throws InputError at `at` where it is
  /// missing, or outside that folder without leave.
  std::filesystem::path find(const std::string& name, const Place& at) const;
  /// Copies a file to the made folder, once; its name there.
  std::string copy(const std::filesystem::path& file);
  /// Writes a mesh, a grid, curves or an image to the made folder; its name there.
  std::string write(const TriangleMesh& mesh);
  std::string write(const VolumeGrid& grid);
  std::string write(const CurveSet& curves);
  std::string write(const Rendering& image, const std::string& stem);

 private:
  /// A new name in the made folder, "stem-N.ending".
  std::string new_name(const std::string& stem, const std::string& ending);

  const PbrtSources& sources_;
  std::filesystem::path scene_folder_, made_folder_;
  bool allow_outside_;
  std::map<std::string, std::string> copied_;
  std::set<std::string> taken_;
  std::map<std::string, int> count_;
};

/// The content of a PLY file, which may be compressed by gzip. Throws InputError about the file.
TriangleMesh read_plain_or_packed_ply(const std::filesystem::path& file);

}  // namespace photonproof::inline scenes_pbrt
