// The chunks of Portable Network Graphics (ISO/IEC 15948:2004, clause 5; the checksum is its annex D).
#include "scenes/png_check.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <vector>

#include "scenes/input_error.h"

namespace photonproof {
namespace {

constexpr std::array<std::uint32_t, 256> make_crc_table() {
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t n = 0; n < 256; ++n) {
    std::uint32_t c = n;
    for (int bit = 0; bit < 8; ++bit) c = (c & 1) != 0 ? 0xedb88320u ^ (c >> 1) : c >> 1;
    table[n] = c;
  }
  return table;
}
constexpr std::array<std::uint32_t, 256> crc_table = make_crc_table();

class Chunks {
 public:
  explicit Chunks(const std::string& path) : path_(path), in_(path, std::ios::binary) {}

  bool has_signature() {
    unsigned char bytes[8] = {};
    in_.read(reinterpret_cast<char*>(bytes), sizeof bytes);
    constexpr unsigned char signature[8] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
    return in_ && std::equal(std::begin(bytes), std::end(bytes), std::begin(signature));
  }
  /// Reads one; false after the last.
  bool next() {
    std::uint32_t length = big_endian();
    crc_ = 0xffffffffu;
    char name[4] = {};
    read(name, sizeof name);
    std::vector<char> piece(std::size_t{1} << 16);
    while (length > 0) {
      const std::uint32_t count = std::min(length, static_cast<std::uint32_t>(piece.size()));
      read(piece.data(), count);
      length -= count;
    }
    const std::uint32_t crc = ~crc_;
    if (big_endian() != crc) fail("the checksum of chunk " + shown(name) + " does not fit");
    return std::string(name, sizeof name) != "IEND";
  }

 private:
  void read(char* to, std::uint32_t count) {
    in_.read(to, count);
    if (!in_) fail("it ends before its last chunk");
    for (std::uint32_t i = 0; i < count; ++i)
      crc_ = crc_table[(crc_ ^ static_cast<unsigned char>(to[i])) & 0xffu] ^ (crc_ >> 8);
  }
  std::uint32_t big_endian() {
    char b[4] = {};
    read(b, sizeof b);
    std::uint32_t value = 0;
    for (const char c : b) value = value << 8 | static_cast<unsigned char>(c);
    return value;
  }
  static std::string shown(const char (&name)[4]) {
    std::string text;
    for (const char c : name) text += (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') ? c : '?';
    return text;
  }
  [[noreturn]] void fail(const std::string& why) const {
    throw InputError(path_, "cannot be read, truncated or damaged: " + why);
  }

  std::string path_;
  std::ifstream in_;
  std::uint32_t crc_ = 0;
};

}  // namespace

void check_png(const std::string& path) {
  Chunks chunks(path);
  if (!chunks.has_signature()) return;
  while (chunks.next()) {
  }
}

}  // namespace photonproof
