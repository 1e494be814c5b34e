// The images of a scene that a page shows, in its order: the reference, each engine's, those that gates looked at.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "reports/view/view.h"

namespace photonproof::reports::inline reports_page {

struct SceneImage {
  std::string title;                            ///< "reference", the engine's or the gate's name
  std::string caption;                          ///< budget and time, or what the gate decided
  std::string subject;                          ///< for alternative texts: "box rendered by path"
  std::optional<std::size_t> engine;            ///< index into View::engines, for its style; none for the reference
  std::string image;                            ///< EXR, relative to results.json; may be empty
  std::map<std::string, std::string> pictures;  ///< as Result::pictures
  std::map<std::string, std::string> scores;    ///< "FLIP 0.0625" by the role of the map it belongs to
  std::string problem;                          ///< why there is no picture; empty when there should be one
  const GateRecord* gate = nullptr;             ///< whose image it is, if a gate's
  bool is_reference = false;
};

/// Gates that looked at an image that another gate of the scene looked at already are not repeated.
std::vector<SceneImage> scene_images(const View& view, const SceneView& scene);

/// Which of them a gate's tiles are to be seen in: its own image, or the same engine's.
std::optional<std::size_t> image_of_gate(const std::vector<SceneImage>& images, const View& view,
                                         const GateRecord& gate);

}  // namespace photonproof::reports::inline reports_page
