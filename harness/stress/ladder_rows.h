// The ladders that climb one thing alone, by topic: each a row. All take the folder for files that scenes name.
#pragma once

#include <filesystem>
#include <vector>

#include "harness/stress/ladder.h"

namespace photonproof::inline harness_stress {

/// Huge, tiny and far shapes, slivers, duplicates, coincident faces, shells.
std::vector<Ladder> shape_ladders(const std::filesystem::path& assets);
/// Indices of refraction, roughness, albedo, optical depth, textures.
std::vector<Ladder> material_ladders(const std::filesystem::path& assets);
/// Lamps that are tiny, huge, near, far and grazing.
std::vector<Ladder> light_ladders(const std::filesystem::path& assets);
/// Lamps 12 above a floor, up to where their own points are known to no better.
std::vector<Ladder> huge_lamp_ladders(const std::filesystem::path& assets);
/// Fields of view, clipping planes, sizes of images.
std::vector<Ladder> camera_ladders(const std::filesystem::path& assets);
/// Numbers and radii of photons.
std::vector<Ladder> photon_ladders(const std::filesystem::path& assets);
/// Numbers that are none, or that no float holds.
std::vector<Ladder> input_ladders(const std::filesystem::path& assets);
/// `compare` on images whose metrics are known.
std::vector<Ladder> metric_ladders(const std::filesystem::path& assets);
/// `compare` on one picture in two formats.
std::vector<Ladder> format_ladders(const std::filesystem::path& assets);

}  // namespace photonproof::inline harness_stress
