// The scene `million`: a landscape with a chosen number of triangles, to measure how engines scale with size.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace photonproof::inline scenes_generators {

constexpr std::uint64_t kFewestTriangles = 1'000, kMostTriangles = 10'000'000;

/// The number of triangles of each part; their sum is within 1 % of the requested number.
struct MillionPlan {
  std::uint32_t columns = 0, rows = 0;  ///< cells of the ground
  std::uint32_t rocks = 0;
  int rock_level = 0;
  std::uint64_t triangles() const;
};

/// Precondition: kFewestTriangles <= triangles <= kMostTriangles.
MillionPlan plan_million(std::uint64_t triangles);

/// The names write_million gives its files.
std::vector<std::string> million_files();

/// Writes scene.xml, expect.toml and the two meshes into an existing folder, each file whole or not at all. Throws
/// InputError when one cannot be written.
void write_million(const std::filesystem::path& folder, const MillionPlan& plan);

}  // namespace photonproof::inline scenes_generators
