#include <cmath>
#include <string>

#include "harness/diagnosis/faint.h"

namespace photonproof::inline harness_diagnosis {

Finding feature_finding(const std::string& feature, double factor) {
  const bool caustic = feature == "caustic", direct = feature == "direct";
  const std::string name = caustic ? "caustic" : direct ? "direct light" : "indirect light";
  // Without caustic photons, global ones and gather rays still bring some light through glass.
  if (factor < (caustic ? 0.3 : 0.15)) {
    const char* why = caustic  ? "no caustic photons are shot or looked up"
                      : direct ? "lamps are not sampled, or every shadow ray is blocked"
                               : "no global photons are shot or gathered";
    return {feature + "-missing", name + " missing", why, {}, 0};
  }
  if (std::abs(factor - 2) < 0.2)
    return {feature + "-twice",
            name + " counted twice",
            caustic  ? "caustic photons are looked up in both maps"
            : direct ? "lamps are added by sampling and by photons, too"
                     : "direct light's photons are gathered, too",
            {},
            0};
  if (std::abs(std::log(factor * M_PI)) < 0.12 || std::abs(std::log(factor / M_PI)) < 0.12)
    return {feature + "-energy",
            factor_text(factor) + "\u00d7 " + name,
            factor > 1 ? "the 1/pi of the diffuse BRDF is missing" : "it is divided by pi twice",
            {},
            0};
  return {feature + "-energy",
          factor_text(factor) + "\u00d7 " + name,
          caustic  ? "photons' power, their number or the look-up's area is wrong"
          : direct ? "the lamp's power, area or sampling density is wrong"
                   : "photons' power, their number or the gather's weight is wrong",
          {},
          0};
}

}  // namespace photonproof::inline harness_diagnosis
