#include "scenes/images/exr_sizes.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <istream>
#include <optional>
#include <string>
#include <system_error>

#include "scenes/base/input_error.h"
#include "scenes/base/utf8.h"

namespace photonproof::inline scenes_images {
namespace {

constexpr std::size_t longest_name = 255;
constexpr std::uint32_t many_parts = 0x1000;  // of the version's flags

/// Four bytes, the least significant first.
std::optional<std::uint32_t> word_in(std::istream& in) {
  unsigned char bytes[4] = {};
  if (!in.read(reinterpret_cast<char*>(bytes), 4)) return std::nullopt;
  return bytes[0] | std::uint32_t{bytes[1]} << 8 | std::uint32_t{bytes[2]} << 16 | std::uint32_t{bytes[3]} << 24;
}

/// Up to the zero byte behind it; none where there is none within the length of a name.
std::optional<std::string> name_in(std::istream& in) {
  std::string name;
  for (char c = 0; name.size() <= longest_name && in.get(c); name += c)
    if (c == 0) return name;
  return std::nullopt;
}

}  // namespace

void check_attribute_sizes(const std::string& path) {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  std::ifstream in(path, std::ios::binary);
  if (error || !word_in(in)) return;
  const std::optional<std::uint32_t> version = word_in(in);
  if (!version) return;
  bool begins_header = true;
  while (true) {
    const std::optional<std::string> name = name_in(in);
    if (!name) return;
    if (name->empty()) {  // the end of a header, and of several where another follows at once
      if (begins_header || (*version & many_parts) == 0) return;
      begins_header = true;
      continue;
    }
    begins_header = false;
    if (!name_in(in)) return;  // its type
    const std::optional<std::uint32_t> bytes = word_in(in);
    if (!bytes) return;
    const auto at = static_cast<std::uintmax_t>(in.tellg());
    if (*bytes > size - at)
      throw InputError(path, "cannot be read as an image: attribute '" + printable(*name) + "' claims " +
                                 std::to_string(*bytes) + " bytes, " + std::to_string(size - at) + " are left");
    in.seekg(*bytes, std::ios::cur);
  }
}

}  // namespace photonproof::inline scenes_images
