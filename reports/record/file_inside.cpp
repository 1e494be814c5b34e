#include "reports/record/file_inside.h"

#include <algorithm>
#include <filesystem>

#include "scenes/text/input_error.h"

namespace photonproof {

std::string file_inside(std::string name) {
  const std::filesystem::path path(name);
  if (path.is_absolute() || std::find(path.begin(), path.end(), "..") != path.end())
    throw InputError(name, "is outside of the folder of the record that names it");
  return name;
}

std::map<std::string, std::string> files_inside(std::map<std::string, std::string> names) {
  for (auto& [role, name] : names) name = file_inside(std::move(name));
  return names;
}

}  // namespace photonproof
