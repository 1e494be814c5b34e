// The Python script by which Blender builds a scene: lines, explanations of conversions, and the files they read.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "reference/engines/not_representable.h"
#include "scenes/description/description.h"

namespace photonproof::inline reference_cycles {

/// An image, or a mesh. A mesh has single-precision positions, 32-bit corners of triangles, and uv and normals per
/// vertex where it has them, in this order and the machine's byte order.
struct CyclesFile {
  std::string name;
  std::shared_ptr<const Image> image;
  std::shared_ptr<const TriangleMesh> mesh;
  bool turned = false;  ///< the mesh's triangles in reverse order, its normals negated
  bool flip_v = false;  ///< v becomes 1 - v
};

/// Writes a file into a folder, whole or not at all. Throws InputError when it cannot be written.
void write_cycles_file(const CyclesFile& file, const std::filesystem::path& folder);

class CyclesScript {
 public:
  /// `stem` starts the names of files.
  CyclesScript(const SceneDescription& scene, std::string stem) : scene_(scene), stem_(std::move(stem)) {}

  const SceneDescription& scene() const { return scene_; }
  /// A comment line that is also kept as an explanation of the conversion.
  void explain(std::string_view text);
  void line(std::string_view python);
  /// The name of the file that stores the image; equal images share a file.
  std::string file_of(const std::shared_ptr<const Image>& image);
  std::string file_of(const CyclesFile& mesh);

  const std::string& text() const { return text_; }
  const std::vector<std::string>& explanations() const { return explanations_; }
  const std::vector<CyclesFile>& files() const { return files_; }

  [[noreturn]] void refuse(const SourceLoc& loc, const std::string& why) const {
    throw NotRepresentable("Cycles", scene_.where(loc), why);
  }

 private:
  const SceneDescription& scene_;
  std::string stem_;
  std::string text_;
  std::vector<std::string> explanations_;
  std::vector<CyclesFile> files_;
};

}  // namespace photonproof::inline reference_cycles
