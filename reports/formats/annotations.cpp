#include "reports/formats/annotations.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string_view>
#include <vector>

namespace photonproof::reports::inline reports_formats {
namespace {

/// Escapes what ends a workflow command or, in a property, its value.
std::string escaped(std::string_view text, bool property) {
  std::string out;
  for (const char c : text) {
    if (c == '%')
      out += "%25";
    else if (c == '\r')
      out += "%0D";
    else if (c == '\n')
      out += "%0A";
    else if (property && c == ':')
      out += "%3A";
    else if (property && c == ',')
      out += "%2C";
    else
      out += c;
  }
  return out;
}

std::string annotation(const char* kind, const std::string& file, const std::string& title, const std::string& text) {
  return fmt::format("::{} file={},title={}::{}\n", kind, escaped(file, true), escaped(title, true),
                     escaped(text, false));
}

}  // namespace

std::string github_annotations(const View& view, const std::string& file) {
  constexpr std::size_t most = 10;
  std::vector<const GateRecord*> open;
  std::ranges::copy_if(view.gates, std::back_inserter(open),
                       [](const GateRecord* gate) { return gate->verdict != GateVerdict::pass; });
  const std::size_t shown = open.size() > most ? most - 1 : open.size();
  std::string lines;
  for (std::size_t i = 0; i < shown; ++i)
    lines += annotation(open[i]->verdict == GateVerdict::fail ? "error" : "warning", file, "gate " + open[i]->name,
                        open[i]->sentence);
  if (shown < open.size())
    lines += annotation("notice", file, "gates",
                        fmt::format("{} more gates do not pass; the report has them all", open.size() - shown));
  return lines;
}

}  // namespace photonproof::reports::inline reports_formats
