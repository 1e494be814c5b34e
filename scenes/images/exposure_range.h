// The exposures that HDR-FLIP evaluates, fixed for a scene by its expect.toml or for one comparison by its command
// line.
#pragma once

namespace photonproof::inline scenes_images {

/// `count` exposures, evenly spaced from start to stop, in stops.
struct ExposureRange {
  double start = 0, stop = 0;
  int count = 0;
  friend bool operator==(const ExposureRange&, const ExposureRange&) = default;
};

inline constexpr const char* expected_exposures =
    "expected a first and a last exposure from -64 to 64 and their number from 1 to 100";

/// Within `expected_exposures`; 2^64 is beyond any radiance, and every exposure costs as much as LDR-FLIP.
inline bool is_usable(const ExposureRange& range) {
  return range.start >= -64 && range.stop <= 64 && range.start <= range.stop && range.count >= 1 && range.count <= 100;
}

}  // namespace photonproof::inline scenes_images
