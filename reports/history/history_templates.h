// The files of reports/templates/ for the page of a history, compiled in (see embed_templates.cmake).
#pragma once

#include <string_view>

namespace photonproof::reports::history_templates {

extern const std::string_view history, history_style;
/// All of its *.js as one function, and its SHA-256 in hexadecimal.
extern const std::string_view script, script_sha256;

}  // namespace photonproof::reports::history_templates
