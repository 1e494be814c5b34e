// A scene as Mitsuba can express it, with an explanation of every change.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "reference/mitsuba/mitsuba_export.h"
#include "scenes/description/description.h"

namespace photonproof::inline reference_mitsuba {

class MitsubaLowering {
 public:
  /// Keeps a reference to the scene. `stem` starts the names of files.
  MitsubaLowering(const SceneDescription& scene, std::string stem);

  const SceneDescription& scene() const { return scene_; }
  SceneDescription& lowered() { return lowered_; }

  void explain(std::string_view text);
  [[noreturn]] void refuse(const SourceLoc& loc, const std::string& why) const;
  /// The name of the file that stores the image or the mesh; equal ones share a file.
  std::string file_of(const std::shared_ptr<const Image>& image);
  std::string file_of(const std::shared_ptr<const TriangleMesh>& mesh);
  /// Declares that the scene needs a plugin of our script's.
  void need(const std::string& plugin);

  const std::vector<MitsubaFile>& files() const { return files_; }
  const std::vector<std::string>& explanations() const { return explanations_; }
  const std::vector<std::string>& plugins() const { return plugins_; }

 private:
  const SceneDescription& scene_;
  SceneDescription lowered_;
  std::string stem_;
  std::vector<MitsubaFile> files_;
  std::vector<std::string> explanations_, plugins_;
};

// Each lowers one part of the scene, in this order.
void lower_view(MitsubaLowering& lowering);
void lower_textures(MitsubaLowering& lowering);
void lower_bsdfs(MitsubaLowering& lowering);
void lower_media(MitsubaLowering& lowering);
void lower_shapes(MitsubaLowering& lowering);
void lower_lights(MitsubaLowering& lowering);

}  // namespace photonproof::inline reference_mitsuba
