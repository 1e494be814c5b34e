// Names of files that a record gives. A record may come from elsewhere: it is data, and names only what lies beside it.
#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace photonproof::inline reports_record {

/// `name`, which a record gives relative to its own folder; empty where there is no file. Throws InputError when the
/// name is absolute or has a part "..", by which it would lead out of that folder.
std::string file_inside(std::string name);
/// All values of a map.
std::map<std::string, std::string> files_inside(std::map<std::string, std::string> names);

/// Throws InputError where a symbolic link leads from `name` out of the folder that it is relative to. A file that does
/// not exist, and an empty name, are inside.
void refuse_link_outside(const std::filesystem::path& folder, const std::string& name);
/// All values of a map.
void refuse_links_outside(const std::filesystem::path& folder, const std::map<std::string, std::string>& names);

}  // namespace photonproof::inline reports_record
