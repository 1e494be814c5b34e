// The inputs of the faults' works: one scene, two suites, and a course of two submissions.
#pragma once

#include <filesystem>

namespace photonproof::inline harness_stress_faults {

/// Pixels of every image except those of `render`.
inline constexpr int work_width = 16, work_height = 16;

/// Writes all inputs except the scene's reference. The folder exists.
void write_work_inputs(const std::filesystem::path& inputs);

}  // namespace photonproof::inline harness_stress_faults
