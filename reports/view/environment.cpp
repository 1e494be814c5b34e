#include "reports/view/environment.h"

#include <fmt/format.h>

#include "reports/view/numbers.h"

namespace photonproof::reports::inline reports_view {
namespace {

void append_known(std::string& list, const std::string& item) {
  if (!item.empty()) list += (list.empty() ? "" : ", ") + item;
}

std::string processor_text(const Host& host) {
  std::string text;
  append_known(text, host.cpu);
  if (host.cores > 0) append_known(text, fmt::format("{} core{}", host.cores, host.cores == 1 ? "" : "s"));
  return text;
}

}  // namespace

std::string machine_text(const Host& host) {
  const std::string text = processor_text(host);
  return text.empty() ? undefined_number : text;
}

std::string host_text(const Host& host) {
  std::string text = processor_text(host);
  if (host.memory_bytes > 0) append_known(text, gibibytes(host.memory_bytes) + " GiB");
  append_known(text, host.os);
  append_known(text, host.kernel);
  return text.empty() ? undefined_number : text;
}

std::string versions_text(const std::map<std::string, std::string>& versions) {
  std::string text;
  for (const auto& [name, version] : versions)
    append_known(text, version.starts_with(name + " ") ? version : name + " " + version);
  return text.empty() ? undefined_number : text;
}

}  // namespace photonproof::reports::inline reports_view
