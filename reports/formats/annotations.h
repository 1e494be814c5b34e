// A gate run's annotations for GitHub Actions: https://docs.github.com/actions, workflow commands.
#pragma once

#include <string>

#include "reports/view/view.h"

namespace photonproof::reports::inline reports_formats {

/// A line "::error file=...,title=...::sentence" for each gate that does not pass, worst first, and a warning for an
/// inconclusive one. GitHub shows ten of a step, so with more gates the tenth line counts the rest. Empty if all pass.
/// `file` is the suite's path in the repository.
std::string github_annotations(const View& view, const std::string& file);

}  // namespace photonproof::reports::inline reports_formats
