// A hash that finds damage and change.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace photonproof::inline scenes_files {

/// A 64-bit hash of bytes that arrive in pieces. It detects damage, not deliberate changes.
class Checksum {
 public:
  void add(const void* bytes, std::size_t count);
  std::uint64_t value() const;
  std::string hex() const;  ///< 16 digits

 private:
  void add_block(const char* bytes);

  static constexpr std::size_t block = 64;
  std::uint64_t lanes_[4] = {1, 2, 3, 4};
  std::uint64_t length_ = 0;
  char rest_[block] = {};
  std::size_t rest_count_ = 0;
};

}  // namespace photonproof::inline scenes_files
