// An assignment's declaration about the images that submissions write.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace photonproof::inline harness_submissions {

enum class SubmittedFormat { exr, pfm, hdr, png, bmp, tga, ppm };
inline constexpr std::array<const char*, 7> submitted_format_names{"exr", "pfm", "hdr", "png", "bmp", "tga", "ppm"};
inline const char* name_of(SubmittedFormat format) { return submitted_format_names[static_cast<std::size_t>(format)]; }
inline std::optional<SubmittedFormat> submitted_format(std::string_view name) {
  for (std::size_t i = 0; i < submitted_format_names.size(); ++i)
    if (name == submitted_format_names[i]) return static_cast<SubmittedFormat>(i);
  return std::nullopt;
}

/// How radiance became the numbers in the file; numbers of 8- and 16-bit formats range from 0 to 1.
struct Transfer {
  enum class Kind { linear, srgb, gamma } kind = Kind::linear;
  double gamma = 1;  ///< radiance = number ^ gamma
};

struct ImageDeclaration {
  SubmittedFormat format = SubmittedFormat::bmp;
  Transfer transfer{};
  bool bottom_up = false;  ///< the row that the format places on top is the picture's lowest
  double scale = 1;        ///< numbers are radiance times this
  int width = 0, height = 0;
};

}  // namespace photonproof::inline harness_submissions
