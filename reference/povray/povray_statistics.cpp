#include "reference/povray/povray_statistics.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>
#include <vector>

namespace photonproof::inline reference_povray {
namespace {

/// The first number at or after `from`.
std::optional<double> number_after(std::string_view text, std::size_t from) {
  const std::size_t digit = text.find_first_of("0123456789", from);
  if (digit == std::string_view::npos) return std::nullopt;
  double value = 0;
  const auto [end, error] = std::from_chars(text.data() + digit, text.data() + text.size(), value);
  if (error != std::errc{}) return std::nullopt;
  return value;
}

/// The console rewrites its progress line with carriage returns.
std::vector<std::string_view> lines(std::string_view text) {
  std::vector<std::string_view> result;
  while (!text.empty()) {
    const std::size_t end = text.find_first_of("\r\n");
    result.push_back(text.substr(0, end));
    if (end == std::string_view::npos) break;
    text.remove_prefix(end + 1);
  }
  return result;
}

constexpr std::array<std::pair<std::string_view, const char*>, 5> kPhases{{{"Parse Time:", "parse"},
                                                                           {"Bounding Time:", "bounding"},
                                                                           {"Photon Time:", "photon"},
                                                                           {"Radiosity Time:", "radiosity"},
                                                                           {"Trace Time:", "trace"}}};

constexpr std::array<std::pair<std::string_view, const char*>, 7> kCounts{
    {{"Pixels:", "pixels"},
     {"Rays:", "rays"},
     {"Shadow Ray Tests:", "shadow_rays"},
     {"Number of photons shot:", "photons_shot"},
     {"Surface photons stored:", "photons_stored"},
     {"Radiosity samples calculated:", "radiosity_samples"},
     {"Radiosity sample rays shot:", "radiosity_rays"}}};

}  // namespace

PovrayStatistics parse_povray_statistics(std::string_view text) {
  PovrayStatistics result;
  const char* phase = nullptr;  // whose "using n thread(s) with s CPU-seconds" comes next
  for (std::string_view line : lines(text)) {
    line.remove_prefix(std::min(line.find_first_not_of(' '), line.size()));
    for (const auto& [label, name] : kPhases) {
      if (!line.starts_with(label)) continue;
      phase = name;
      if (const auto seconds = number_after(line, line.find('('))) result.phases[name] = *seconds;
    }
    for (const auto& [label, name] : kCounts)
      if (line.starts_with(label))
        if (const auto count = number_after(line, label.size())) result.counts[name] = *count;
    if (phase && line.starts_with("using "))
      if (const auto seconds = number_after(line, line.find("with "))) result.cpu_phases[phase] = *seconds;
  }
  return result;
}

std::string povray_version(std::string_view console) {
  constexpr std::string_view label = "Ray Tracer Version ";
  const std::size_t at = console.find(label);
  if (at == std::string_view::npos) return {};
  console.remove_prefix(at + label.size());
  return std::string(console.substr(0, console.find_first_of(" \r\n")));
}

std::optional<double> povray_progress(std::string_view console) {
  constexpr std::string_view label = "Rendered ";
  const std::size_t at = console.rfind(label);
  if (at == std::string_view::npos) return std::nullopt;
  const std::size_t of = console.find(" of ", at);
  if (of == std::string_view::npos) return std::nullopt;
  const auto done = number_after(console, at);
  const auto total = number_after(console, of);
  if (!done || !total || !(*total > 0)) return std::nullopt;
  return *done / *total;
}

std::string povray_errors(std::string_view console) {
  std::string result;
  for (std::string_view line : lines(console)) {
    if (line.find("rror") == std::string_view::npos && line.find("annot") == std::string_view::npos) continue;
    if (line.find("user configuration file") != std::string_view::npos) continue;  // its absence is normal
    if (!result.empty()) result += "; ";
    result += line;
  }
  return result;
}

}  // namespace photonproof::inline reference_povray
