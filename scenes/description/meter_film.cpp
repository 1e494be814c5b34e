#include "scenes/description/meter_film.h"

namespace photonproof::inline scenes_description {

bool is_meter(const SensorDescription& sensor) {
  return std::holds_alternative<RadianceMeterDescription>(sensor.camera) ||
         std::holds_alternative<IrradianceMeterDescription>(sensor.camera) ||
         std::holds_alternative<DistantDescription>(sensor.camera);
}

std::string film_problem(const SensorDescription& sensor) {
  const std::string size = std::to_string(sensor.film.width) + " x " + std::to_string(sensor.film.height) + " pixels";
  if (const auto* batch = std::get_if<BatchDescription>(&sensor.camera)) {
    const int views = static_cast<int>(batch->views.size());
    if (sensor.film.width % views != 0)
      return "has " + std::to_string(views) + " cameras and a film of " + size +
             ", expected a width that is a multiple of " + std::to_string(views);
  }
  if (is_meter(sensor) && (sensor.film.width != 1 || sensor.film.height != 1))
    return "has a film of " + size + ", expected 1 x 1";
  return "";
}

}  // namespace photonproof::inline scenes_description
