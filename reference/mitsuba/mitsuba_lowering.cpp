#include "reference/mitsuba/mitsuba_lowering.h"

#include <algorithm>
#include <utility>

namespace photonproof::inline reference_mitsuba {

MitsubaLowering::MitsubaLowering(const SceneDescription& scene, std::string stem)
    : scene_(scene), lowered_(scene), stem_(std::move(stem)) {}

void MitsubaLowering::explain(std::string_view text) {
  std::string comment(text);
  for (char& c : comment)
    if (c < ' ' || c > '~') c = '?';
  for (std::size_t at = comment.find("--"); at != std::string::npos; at = comment.find("--"))
    comment.replace(at, 2, "- -");  // XML's comments have none
  explanations_.push_back(comment);
}

void MitsubaLowering::refuse(const SourceLoc& loc, const std::string& why) const {
  throw NotRepresentable("Mitsuba", scene_.where(loc), why);
}

std::string MitsubaLowering::file_of(const std::shared_ptr<const Image>& image) {
  for (const MitsubaFile& file : files_)
    if (file.image == image) return file.name;
  files_.push_back({stem_ + "_image_" + std::to_string(files_.size()) + ".exr", image, nullptr});
  return files_.back().name;
}

std::string MitsubaLowering::file_of(const std::shared_ptr<const TriangleMesh>& mesh) {
  for (const MitsubaFile& file : files_)
    if (file.mesh == mesh) return file.name;
  files_.push_back({stem_ + "_mesh_" + std::to_string(files_.size()) + ".ply", nullptr, mesh});
  return files_.back().name;
}

void MitsubaLowering::need(const std::string& plugin) {
  if (std::find(plugins_.begin(), plugins_.end(), plugin) == plugins_.end()) plugins_.push_back(plugin);
}

}  // namespace photonproof::inline reference_mitsuba
