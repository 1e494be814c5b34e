// The sweeps of a single feature, by topic, a row each. All take the folder for files that scenes name.
#pragma once

#include <filesystem>
#include <vector>

#include "harness/stress/sweep.h"

namespace photonproof::inline harness_stress {

/// Huge, tiny and far shapes, slivers, duplicates, coincident faces, shells.
std::vector<Sweep> shape_sweeps(const std::filesystem::path& assets);
/// Indices of refraction, roughness, albedo, optical depth, textures.
std::vector<Sweep> material_sweeps(const std::filesystem::path& assets);
/// Lights that are tiny, huge, near, far and grazing.
std::vector<Sweep> light_sweeps(const std::filesystem::path& assets);
/// Lights 12 above a floor, up to sizes at which their own points have no better precision.
std::vector<Sweep> huge_light_sweeps(const std::filesystem::path& assets);
/// Fields of view, clipping planes, sizes of images.
std::vector<Sweep> camera_sweeps(const std::filesystem::path& assets);
/// Numbers and radii of photons.
std::vector<Sweep> photon_sweeps(const std::filesystem::path& assets);
/// Values that are not numbers, or that no float holds.
std::vector<Sweep> input_sweeps(const std::filesystem::path& assets);
/// `compare` on images whose metrics are known.
std::vector<Sweep> metric_sweeps(const std::filesystem::path& assets);
/// `compare` on one picture in two formats.
std::vector<Sweep> format_sweeps(const std::filesystem::path& assets);

}  // namespace photonproof::inline harness_stress
