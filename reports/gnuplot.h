// Runs gnuplot as a child process.
#pragma once

#include <string>

namespace photonproof::reports {

struct PlotOutcome {
  std::string svg;      ///< the document gnuplot wrote; empty on failure
  std::string problem;  ///< one sentence, empty on success
};

/// Runs `program` (looked up on PATH) on `script`, with `set output` to an SVG file put in front of it. The script is
/// code: it must hold no text from outside.
PlotOutcome run_gnuplot(const std::string& script, const std::string& program = "gnuplot");

/// The drawing inside a gnuplot SVG document, for placing in an HTML page that holds several: without its prolog,
/// titles (browsers show them as tooltips) and filters, and with every id prefixed. Ends with "</svg>"; empty when the
/// document is not laid out as gnuplot does.
std::string inline_svg(const std::string& svg, const std::string& id_prefix, const std::string& attributes);

}  // namespace photonproof::reports
