#include "renderer/passes/lost_light.h"

#include "scenes/base/percent_text.h"

namespace photonproof::inline renderer_passes {

std::string LostLight::text() const {
  const std::string share_text = share > 0 ? ", about " + percent_text(share) + " of the image's light" : "";
  return "integrator '" + integrator + "' cannot find " + what + share_text + ": " +
         (finders.empty() ? "no integrator of this program finds all light of this scene"
                          : "'" + finders.front() + "' finds it");
}

}  // namespace photonproof::inline renderer_passes
