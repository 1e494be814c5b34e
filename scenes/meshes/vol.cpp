#include "scenes/meshes/vol.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <utility>

#include "scenes/base/input_error.h"

namespace photonproof::inline scenes_meshes {
namespace {

static_assert(std::endian::native == std::endian::little, "the files are little-endian");

constexpr std::size_t kVolHeaderBytes = 48;
constexpr int kMostCells = 1 << 20;  ///< along an axis

template <class T>
T word(std::string_view bytes, std::size_t at) {
  T value;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

/// The grid without its values.
VolumeGrid parse_header(std::string_view bytes, const std::string& file) {
  if (bytes.size() < 4 || bytes.substr(0, 3) != "VOL") throw InputError(file, "is not a volume of Mitsuba");
  if (const auto version = static_cast<unsigned char>(bytes[3]); version != 3)
    throw InputError(file, "has version " + std::to_string(version) + " of volumes, expected 3");
  if (bytes.size() < kVolHeaderBytes) throw InputError(file, "the header ends too early");
  if (const auto type = word<std::int32_t>(bytes, 4); type != 1)
    throw InputError(file, "has values of type " + std::to_string(type) + ", expected 1 (32-bit floats)");
  VolumeGrid grid;
  int* const cells[] = {&grid.width, &grid.height, &grid.depth};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    *cells[axis] = word<std::int32_t>(bytes, 8 + 4 * axis);
    if (*cells[axis] < 1 || *cells[axis] > kMostCells)
      throw InputError(file, "has " + std::to_string(*cells[axis]) + " cells along " + "xyz"[axis] +
                                 ", expected 1 to " + std::to_string(kMostCells));
  }
  grid.channels = word<std::int32_t>(bytes, 20);
  if (grid.channels != 1 && grid.channels != 3)
    throw InputError(file, "has " + std::to_string(grid.channels) + " channels, expected 1 or 3");
  const auto corner = [&](std::size_t at) {
    return Vec3f(word<float>(bytes, at), word<float>(bytes, at + 4), word<float>(bytes, at + 8));
  };
  grid.low = corner(24);
  grid.high = corner(36);
  const Vec3f extent = grid.high - grid.low;
  for (const auto& [name, length] : {std::pair{"x", extent.x}, {"y", extent.y}, {"z", extent.z}})
    if (!(length > 0) || !std::isfinite(length)) throw InputError(file, std::string("has no extent along ") + name);
  return grid;
}

}  // namespace

VolumeGrid parse_vol(std::string_view bytes, const std::string& file, VolValues allowed) {
  VolumeGrid grid = parse_header(bytes, file);
  // At most 2^62: each factor is at most 2^20, and there are 3 channels.
  const std::uint64_t count =
      std::uint64_t(grid.width) * std::uint64_t(grid.height) * std::uint64_t(grid.depth) * std::uint64_t(grid.channels);
  const std::uint64_t there = (bytes.size() - kVolHeaderBytes) / sizeof(float);
  if (there < count)
    throw InputError(file, "has " + std::to_string(there) + " values, expected " + std::to_string(count));
  grid.values.resize(count);
  std::memcpy(grid.values.data(), bytes.data() + kVolHeaderBytes, count * sizeof(float));
  grid.largest = allowed == VolValues::any ? std::numeric_limits<float>::lowest() : 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (!std::isfinite(grid.values[i]) || (allowed == VolValues::not_negative && grid.values[i] < 0))
      throw InputError(file, "byte " + std::to_string(kVolHeaderBytes + i * sizeof(float)) +
                                 " begins a value that is " +
                                 (allowed == VolValues::any ? "not finite" : "negative or not finite"));
    grid.largest = std::max(grid.largest, grid.values[i]);
  }
  return grid;
}

}  // namespace photonproof::inline scenes_meshes
