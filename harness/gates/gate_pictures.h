// The pictures that reports show beside a gate: the mean of its images, maps of its differences, and the reference.
#pragma once

#include <filesystem>
#include <string>

#include "harness/metrics/metric_parameters.h"
#include "reference/store/reference_store.h"
#include "reports/record/results.h"

namespace photonproof::inline harness_gates {

/// Writes gates/<name of the gate>/ under `folder` and sets the record's image and pictures. These are the image at the
/// scene's `exposure` (stops), and maps by the gate's metrics. `mean` has the reference's size and is finite.
void store_pictures(const Image& mean, const StoredReference& reference, double exposure, const ParameterValues& judged,
                    const std::filesystem::path& folder, GateRecord& record);

/// Removes the files of store_reference from an earlier run: engines write near them.
void remove_reference(const std::string& scene, const std::filesystem::path& folder);

/// Writes references/<scene>.exr and .png under `folder`.
ReferenceRecord store_reference(const StoredReference& reference, const std::string& scene, double exposure,
                                const std::filesystem::path& folder);

}  // namespace photonproof::inline harness_gates
