// Locates an engine's error against engines that are believed: where in the image, by how much, and in which pass of
// light.
#pragma once

#include <string>
#include <vector>

#include "harness/verify/engine_renderer.h"
#include "harness/verify/picture_pair.h"
#include "reports/verify/verify_record.h"
#include "scenes/description/description.h"

namespace photonproof::inline harness_verify {

/// A picture under suspicion, with its engine.
struct Suspect {
  const VerifyEngine& engine;
  const EnginePicture& picture;
};

struct Believed {
  const VerifyEngine* engine = nullptr;
  const EnginePicture* picture = nullptr;
};

class FaultLocator {
 public:
  /// Renders passes of `description` in the renderer; their scenes and pictures go into its folder.
  FaultLocator(const EngineRenderer& renderer, const RenderedScene& scene, const SceneDescription& description);

  /// `right`: engines that agree, best first; one that cannot render a pass is skipped. Precondition: not empty.
  VerifyFault locate(const Suspect& odd, const std::vector<Believed>& right) const;

 private:
  /// `of_whole`: the largest relative difference of the whole scene.
  void look_for_pass(const Suspect& odd, const std::vector<Believed>& right, double of_whole, VerifyFault& fault) const;
  RenderedScene write_pass(const std::string& name, const SceneDescription& pass) const;
  void draw(const EnginePicture& right, const EnginePicture& odd, const std::string& name, VerifyFault& fault) const;

  const EngineRenderer& renderer_;
  const RenderedScene& scene_;
  const SceneDescription& description_;
};

/// PNG of the difference: orange where the second is brighter, blue where it is darker, relative to the first's mean.
Image signed_difference(const Image& first, const Image& second);

}  // namespace photonproof::inline harness_verify
