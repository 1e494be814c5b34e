// Versions of the libraries that this program was built with, for the record of a run.
#pragma once

#include <map>
#include <string>

namespace photonproof::inline harness_verbs {

/// The versions of what can change an image or a timing: this program, its compiler, and its libraries.
std::map<std::string, std::string> program_versions();

}  // namespace photonproof::inline harness_verbs
