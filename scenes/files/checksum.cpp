#include "scenes/files/checksum.h"

#include <algorithm>
#include <bit>
#include <cstdio>
#include <cstring>

namespace photonproof::inline scenes_files {
namespace {

std::uint64_t mixed(std::uint64_t x) {
  x = (x ^ x >> 32) * 0x9e3779b97f4a7c15u;
  return x ^ x >> 29;
}

}  // namespace
void Checksum::add_block(const char* bytes) {
  std::uint64_t words[block / 8];
  std::memcpy(words, bytes, block);
  for (std::size_t i = 0; i < block / 8; ++i) {
    std::uint64_t& lane = lanes_[i % 4];
    lane = std::rotl((lane ^ words[i]) * 0x9e3779b97f4a7c15u, 29);
  }
}

void Checksum::add(const void* bytes, std::size_t count) {
  const auto* from = static_cast<const char*>(bytes);
  length_ += count;
  if (rest_count_ > 0) {
    const std::size_t taken = std::min(count, block - rest_count_);
    std::memcpy(rest_ + rest_count_, from, taken);
    rest_count_ += taken;
    from += taken;
    count -= taken;
    if (rest_count_ < block) return;
    add_block(rest_);
    rest_count_ = 0;
  }
  for (; count >= block; from += block, count -= block) add_block(from);
  if (count > 0) std::memcpy(rest_, from, count);
  rest_count_ = count;
}

std::uint64_t Checksum::value() const {
  Checksum end = *this;
  if (end.rest_count_ > 0) {
    std::memset(end.rest_ + end.rest_count_, 0, block - end.rest_count_);
    end.add_block(end.rest_);
  }
  std::uint64_t hash = mixed(end.length_);
  for (const std::uint64_t lane : end.lanes_) hash = mixed(hash ^ lane);
  return hash;
}

std::string Checksum::hex() const {
  char digits[17];
  std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(value()));
  return digits;
}

}  // namespace photonproof::inline scenes_files
