#include "harness/diagnosis/guess.h"

#include <cmath>
#include <cstdio>

#include "harness/diagnosis/pictures/picture_changes.h"

namespace photonproof::inline harness_diagnosis {

Image predicted(const Guess& guess, double white) {
  Image image = guess.light;
  if (guess.shift_x != 0 || guess.shift_y != 0 || guess.zoom != 1)
    image = viewed(image, guess.shift_x, guess.shift_y, guess.zoom);
  if (guess.blur > 0) image = blurred(image, guess.blur);
  if (guess.turn != 0) image = turned(image, turn_rows()[guess.turn]);
  if (guess.scale != 1)
    for (float& v : image.rgb) v *= static_cast<float>(guess.scale);
  if (guess.channels != 0) image = with_channels(image, channel_rows()[guess.channels]);
  if (guess.tone != 0) image = toned(image, tone_rows()[guess.tone], white);
  return image;
}

std::string factor_text(double factor) {
  char text[32];
  std::snprintf(text, sizeof(text), factor < 10 ? "%.1f" : "%.0f", factor);
  if (factor < 0.095) std::snprintf(text, sizeof(text), "%.2f", factor);
  return text;
}

Finding shift_finding(double x, double y) {
  std::string words;
  const auto add = [&](double by, const char* more, const char* less) {
    if (std::abs(by) < 0.1) return;
    words += (words.empty() ? "" : " and ") + factor_text(std::abs(by)) + " pixels " + (by > 0 ? more : less);
  };
  add(x, "right", "left");
  add(y, "down", "up");
  return {"shifted",
          "the image is shifted by " + words,
          "pixels' middles are taken half a pixel off, or the camera points elsewhere",
          {},
          0};
}

}  // namespace photonproof::inline harness_diagnosis
