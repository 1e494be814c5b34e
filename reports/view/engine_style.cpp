// Colours: Okabe and Ito, "Color Universal Design" (2008), which colour-blind readers can distinguish. Their yellow is
// left out because of its contrast on white.
#include "reports/view/engine_style.h"

#include <fmt/format.h>

#include <iterator>

namespace photonproof::reports::inline reports_view {

namespace {

constexpr const char* colors[] = {"#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000"};
constexpr const char* shapes[] = {
    "<circle cx=\"6\" cy=\"6\" r=\"4.5\"/>", "<rect x=\"2\" y=\"2\" width=\"8\" height=\"8\"/>",
    "<path d=\"M6 .5L11 10H1z\"/>",          "<path d=\"M6 .5L11.5 6L6 11.5L.5 6z\"/>",
    "<path d=\"M6 11.5L11 2H1z\"/>",
};

}  // namespace

EngineStyle engine_style(std::size_t index) {
  return {colors[index % std::size(colors)], shapes[index % std::size(shapes)]};
}

std::string engine_color(std::size_t index) {
  return fmt::format("var(--engine-{}, {})", index % std::size(colors), engine_style(index).color);
}

}  // namespace photonproof::reports::inline reports_view
