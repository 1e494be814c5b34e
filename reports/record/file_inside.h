// Names of files that a record gives. A record may come from elsewhere: it is data, and names only what lies beside it.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace photonproof::inline reports_record {

/// `name`, which a record gives relative to its own folder; empty where there is no file. Throws InputError when the
/// name is absolute or has a part "..", by which it would lead out of that folder.
std::string file_inside(std::string name);

/// Throws InputError where a symbolic link leads from `name` out of the folder that it is relative to. A file that does
/// not exist, and an empty name, are inside.
void refuse_link_outside(const std::filesystem::path& folder, const std::string& name);
/// All values of a map.
void refuse_links_outside(const std::filesystem::path& folder, const std::map<std::string, std::string>& names);

/// Throws InputError at the first name that is outside of its record's folder, or leads out of `folder`, where that is
/// given.
void refuse_files_outside(const std::vector<std::string>& names,
                          const std::optional<std::filesystem::path>& folder = std::nullopt);

}  // namespace photonproof::inline reports_record
