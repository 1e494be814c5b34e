// Where, by how much and in which pass of light an engine is wrong: against one that is believed.
#pragma once

#include <string>
#include <vector>

#include "harness/verify/engine_renderer.h"
#include "harness/verify/picture_pair.h"
#include "reports/verify/verify_record.h"
#include "scenes/description/description.h"

namespace photonproof::inline harness_verify {

/// What is compared.
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

  /// `right`: those who agree, the first first; one that cannot render a pass is passed over. Precondition: not empty.
  VerifyFault locate(const Suspect& odd, const std::vector<Believed>& right) const;

 private:
  void look_for_pass(const Suspect& odd, const std::vector<Believed>& right, const PairTest& whole,
                     VerifyFault& fault) const;
  RenderedScene write_pass(const std::string& name, const SceneDescription& pass) const;
  void draw(const EnginePicture& right, const EnginePicture& odd, const std::string& name, VerifyFault& fault) const;

  const EngineRenderer& renderer_;
  const RenderedScene& scene_;
  const SceneDescription& description_;
};

/// PNG of how the second differs from the first: orange where it is brighter, blue where darker, relative to the
/// first's mean.
Image signed_difference(const Image& first, const Image& second);

}  // namespace photonproof::inline harness_verify
