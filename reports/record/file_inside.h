// Checks the names of files in a record. A record may come from elsewhere: it is data, and may name only files beside
// it.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace photonproof::inline reports_record {

/// `name`, which a record gives relative to its own folder; empty if there is no file. Throws InputError when the name
/// is absolute or has a part "..", which would lead out of that folder.
std::string file_inside(std::string name);

/// Throws InputError if a symbolic link leads from `name` out of the folder that it is relative to. A file that does
/// not exist and an empty name count as inside.
void refuse_link_outside(const std::filesystem::path& folder, const std::string& name);
/// Checks all values of a map.
void refuse_links_outside(const std::filesystem::path& folder, const std::map<std::string, std::string>& names);

/// Throws InputError at the first name outside of its record's folder, or, if `folder` is given, at one that leads out
/// of it.
void refuse_files_outside(const std::vector<std::string>& names,
                          const std::optional<std::filesystem::path>& folder = std::nullopt);

}  // namespace photonproof::inline reports_record
