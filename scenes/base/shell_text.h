// Quoting for a POSIX shell.
#pragma once

#include <string>
#include <vector>

namespace photonproof::inline scenes_base {

/// One word of a command line, quoted where necessary.
std::string shell_word(const std::string& text);

/// A command that a shell would run with exactly these arguments.
std::string shell_line(const std::vector<std::string>& arguments);

}  // namespace photonproof::inline scenes_base
