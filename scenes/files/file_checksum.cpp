#include "scenes/files/file_checksum.h"

#include <fstream>
#include <vector>

#include "scenes/files/checksum.h"

namespace photonproof::inline scenes_files {

std::string file_checksum(const std::filesystem::path& file) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored)) return {};
  std::ifstream in(file, std::ios::binary);
  Checksum checksum;
  std::vector<char> piece(std::size_t{1} << 20);
  while (in.read(piece.data(), static_cast<std::streamsize>(piece.size())) || in.gcount() > 0)
    checksum.add(piece.data(), static_cast<std::size_t>(in.gcount()));
  return in.eof() ? checksum.hex() : std::string();
}

}  // namespace photonproof::inline scenes_files
