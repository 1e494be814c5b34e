// IES photometric files (ANSI/IES LM-63): the luminous intensity of a luminaire by direction.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace photonproof::inline scenes_meshes {

/// Candela over a grid of angles, the file's multipliers applied. Symmetry is the file's: horizontal angles end at 0
/// (rotational), 90 (quadrants), 180 (halves) or 360.
struct IesProfile {
  std::vector<double> vertical_degrees;    ///< ascending, 0 is the nadir, 180 the zenith
  std::vector<double> horizontal_degrees;  ///< ascending from 0
  std::vector<double> candela;             ///< horizontal x vertical, vertical fastest; finite, >= 0
  friend bool operator==(const IesProfile&, const IesProfile&) = default;
};

constexpr std::size_t kMaxIesBytes = std::size_t{16} << 20;

/// LM-63-1986, -1991, -1995 and -2002, photometric type C, TILT=NONE. Throws InputError with file:line:col.
IesProfile read_ies(const std::string& path);

/// The same for text already in memory; `file` stands for the file in messages.
IesProfile parse_ies(std::string_view text, const std::string& file);

}  // namespace photonproof::inline scenes_meshes
