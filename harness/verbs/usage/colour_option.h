// Colours on a terminal: the option --color, and the convention of NO_COLOR (no-color.org).
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace photonproof::inline harness_verbs_usage {

/// Adds --color with the values auto, always and never.
void add_colour_option(CLI::App& verb, std::string& colour);

/// Whether to write escape sequences to the file descriptor. "auto" does on a terminal, unless NO_COLOR is set to
/// anything or TERM is "dumb".
bool colours_on(const std::string& colour, int descriptor);

}  // namespace photonproof::inline harness_verbs_usage
