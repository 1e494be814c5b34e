// Light of a scene that an integrator cannot find with any number of samples.
#pragma once

#include <string>
#include <vector>

namespace photonproof::inline renderer_passes {

struct LostLight {
  std::string integrator;              ///< The integrator that misses it.
  std::string what;                    ///< The light, as a phrase.
  double share = 0;                    ///< Approximate share of the image's light; 0 where it is unknown.
  std::vector<std::string> finders{};  ///< Integrators that find it and all other light of the scene, best first.

  /// A sentence without its full stop, which names the best of them.
  std::string text() const;
};

}  // namespace photonproof::inline renderer_passes
