// Words as a POSIX shell reads them.
#pragma once

#include <string>
#include <vector>

namespace photonproof::inline scenes_base {

/// One word of a command line, quoted where it has to be.
std::string shell_word(const std::string& text);

/// A command that a shell would run with exactly these arguments.
std::string shell_line(const std::vector<std::string>& arguments);

}  // namespace photonproof::inline scenes_base
