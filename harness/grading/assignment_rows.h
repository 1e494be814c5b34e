// The parts of an assignment that have a source of their own, and how both read values. All throw InputError with the
// value's place.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "harness/grading/assignment.h"
#include "harness/suites/toml_table.h"

namespace photonproof::inline harness_grading {

double positive_number(const TomlTable& table, const std::string& key);
std::string one_of(const TomlTable& table, const std::string& key, const std::vector<std::string>& known);
/// "linear", a gamma, or "srgb", which is empty.
std::optional<double> transfer_of(const TomlTable& table, const std::string& key);

/// [[scene]] and [[hidden]], into assignment.scenes; the rest of it is read.
void read_assignment_scenes(const TomlTable& document, Assignment& assignment);

/// [performance] of an assignment whose scenes are read.
PerformanceRule performance_rule(const TomlTable& table, const Assignment& assignment);

}  // namespace photonproof::inline harness_grading
