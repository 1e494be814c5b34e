// Messages about command lines that name an unknown verb, option or value: one line, with the nearest name.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace photonproof::inline harness_verbs_usage {

/// One line about a command line that `program` failed to parse.
std::string complaint_about(const CLI::App& program, const CLI::ParseError& error);

/// A check that a value is one of `names`; its message has the nearest one.
CLI::Validator one_of(const std::vector<std::string>& names);

}  // namespace photonproof::inline harness_verbs_usage
