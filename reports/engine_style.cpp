// Colours: Okabe and Ito, "Color Universal Design" (2008), told apart by colour-blind readers; their yellow is left out
// for its contrast on white.
#include "reports/engine_style.h"

#include <iterator>

namespace photonproof::reports {

EngineStyle engine_style(std::size_t index) {
  constexpr const char* colors[] = {"#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000"};
  struct Marker {
    int gnuplot_point;
    const char* svg_shape;
  };
  constexpr Marker markers[] = {
      {7, "<circle cx=\"6\" cy=\"6\" r=\"4.5\"/>"}, {5, "<rect x=\"2\" y=\"2\" width=\"8\" height=\"8\"/>"},
      {9, "<path d=\"M6 .5L11 10H1z\"/>"},          {13, "<path d=\"M6 .5L11.5 6L6 11.5L.5 6z\"/>"},
      {11, "<path d=\"M6 11.5L11 2H1z\"/>"},
  };
  const Marker& marker = markers[index % std::size(markers)];
  return {colors[index % std::size(colors)], marker.gnuplot_point, marker.svg_shape};
}

}  // namespace photonproof::reports
