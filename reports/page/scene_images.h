// The images of a scene on its page, in order: the reference, each engine's, and those that gates tested.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "reports/view/view.h"

namespace photonproof::reports::inline reports_page {

struct SceneImage {
  std::string title;                            ///< "reference", the engine's or the gate's name
  std::string caption;                          ///< budget and time, or the gate's decision
  std::string subject;                          ///< for alternative texts: "box rendered by path"
  std::optional<std::size_t> engine;            ///< index into View::engines, for its style; none for the reference
  std::string image;                            ///< EXR, relative to results.json; may be empty
  std::map<std::string, std::string> pictures;  ///< as Result::pictures
  std::map<std::string, std::string> scores;    ///< "FLIP 0.0625" by the role of the map it belongs to
  std::string problem;                          ///< why there is no picture; empty if one is expected
  const GateRecord* gate = nullptr;             ///< the gate whose image it is, if any
  bool is_reference = false;
};

/// Leaves out gates that tested an image that is already in the list.
std::vector<SceneImage> scene_images(const View& view, const SceneView& scene);

/// The image that shows a gate's tiles: its own, or the same engine's.
std::optional<std::size_t> image_of_gate(const std::vector<SceneImage>& images, const View& view,
                                         const GateRecord& gate);

}  // namespace photonproof::reports::inline reports_page
