// Light of a scene that an integrator cannot find by any number of samples.
#pragma once

#include <string>
#include <vector>

namespace photonproof::inline renderer_passes {

struct LostLight {
  std::string integrator;              ///< that misses it
  std::string what;                    ///< which light, a phrase
  double share = 0;                    ///< of the image's light, about; 0 where it is not known
  std::vector<std::string> finders{};  ///< integrators that find it and all other light of the scene, best first

  /// A sentence without its full stop, which names the best of them.
  std::string text() const;
};

}  // namespace photonproof::inline renderer_passes
