#include "renderer/passes/lost_light.h"

#include <cstdio>

namespace photonproof::inline renderer_passes {

std::string LostLight::text() const {
  std::string share_text;
  if (share > 0) {
    char text[48];
    std::snprintf(text, sizeof text, ", about %.2g %% of the image's light", 100 * share);
    share_text = text;
  }
  return "integrator '" + integrator + "' cannot find " + what + share_text + ": " +
         (finders.empty() ? "no integrator of this program finds all light of this scene"
                          : "'" + finders.front() + "' finds it");
}

}  // namespace photonproof::inline renderer_passes
