// The parts of an assignment with sources of their own, and the reading of values for both. All throw InputError with
// the value's place.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "harness/grading/assignment.h"
#include "harness/suites/toml_table.h"

namespace photonproof::inline harness_grading {

double positive_number(const TomlTable& table, const std::string& key);
std::string one_of(const TomlTable& table, const std::string& key, const std::vector<std::string>& known);
/// Empty for "srgb", 1 for "linear", else the gamma.
std::optional<double> transfer_of(const TomlTable& table, const std::string& key);

/// Reads [[scene]] and [[hidden]] into assignment.scenes, after the rest of the assignment.
void read_assignment_scenes(const TomlTable& document, Assignment& assignment);

/// Reads [performance], after the assignment's scenes.
PerformanceRule performance_rule(const TomlTable& table, const Assignment& assignment);

}  // namespace photonproof::inline harness_grading
