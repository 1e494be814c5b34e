// Writes a zip archive for current unpackers and Info-ZIP of 1990: deflated members, Unix permissions, one size limit
// of 4 GiB. (PKWARE, APPNOTE.TXT 6.3.10, sections 4.3.7, 4.3.12, 4.3.16.)
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace photonproof::inline reports_grades {

struct ZipMember {
  std::string name;  ///< with '/' between folders
  std::string bytes;
  bool executable = false;
};

/// The archive's bytes. Members have one fixed date, so that the same members make the same bytes. Precondition: names
/// are relative and distinct.
std::string zip_bytes(const std::vector<ZipMember>& members);

}  // namespace photonproof::inline reports_grades
