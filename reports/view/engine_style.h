// Style of an engine on all pages: one colour and one marker, in plots and beside its name.
#pragma once

#include <cstddef>
#include <string>

namespace photonproof::reports::inline reports_view {

struct EngineStyle {
  const char* color;      ///< "#rrggbb"
  const char* svg_shape;  ///< the same marker as SVG in a 12 x 12 box, filled with currentColor
};

/// The style of the n-th engine of a record. Colours repeat after seven engines, markers after five, so that the first
/// 35 differ in one or the other.
EngineStyle engine_style(std::size_t index);

/// The colour as CSS: a variable, for which style.css has lighter colours on dark pages, else EngineStyle::color.
std::string engine_color(std::size_t index);

}  // namespace photonproof::reports::inline reports_view
