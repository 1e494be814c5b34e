#include "reports/record/file_inside.h"

#include <algorithm>
#include <filesystem>

#include "scenes/base/input_error.h"

namespace photonproof::inline reports_record {
namespace {

[[noreturn]] void refuse(const std::string& name) {
  throw InputError(name, "is outside of the folder of the record that names it");
}

}  // namespace

std::string file_inside(std::string name) {
  const std::filesystem::path path(name);
  if (path.is_absolute() || std::find(path.begin(), path.end(), "..") != path.end()) refuse(name);
  return name;
}

void refuse_link_outside(const std::filesystem::path& folder, const std::string& name) {
  if (name.empty()) return;
  std::error_code loop;  // of links that end nowhere
  const std::filesystem::path root = std::filesystem::weakly_canonical(std::filesystem::absolute(folder), loop);
  if (loop) refuse(name);
  const std::filesystem::path path = std::filesystem::weakly_canonical(root / name, loop);
  if (loop || std::mismatch(root.begin(), root.end(), path.begin(), path.end()).first != root.end()) refuse(name);
}

void refuse_links_outside(const std::filesystem::path& folder, const std::map<std::string, std::string>& names) {
  for (const auto& [role, name] : names) refuse_link_outside(folder, name);
}

void refuse_files_outside(const std::vector<std::string>& names, const std::optional<std::filesystem::path>& folder) {
  for (const std::string& name : names) {
    file_inside(name);
    if (folder) refuse_link_outside(*folder, name);
  }
}

}  // namespace photonproof::inline reports_record
