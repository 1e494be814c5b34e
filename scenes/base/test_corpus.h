// The corpus of a fuzz target as an ordinary test: every file whole, cut short, and with bytes changed at random. The
// mutations are the same each time; PHOTONPROOF_MUTATIONS sets a number of them that may exceed a test's time.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "scenes/files/atomic_file.h"

namespace photonproof::inline scenes_base {

/// A few changes such as fuzzers make: a bit, a byte, a span left out, doubled or replaced by one of another file.
inline std::string mutated(std::string bytes, const std::string& other, std::mt19937_64& random) {
  const auto below = [&](std::size_t most) {
    return static_cast<std::size_t>(random() % std::max<std::size_t>(most, 1));
  };
  for (std::size_t changes = 1 + below(4); changes > 0 && !bytes.empty(); --changes) {
    const std::size_t at = below(bytes.size()), length = std::min(1 + below(16), bytes.size() - at);
    switch (random() % 6) {
      case 0:
        bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(8)));
        break;
      case 1:
        bytes[at] = static_cast<char>(random());
        break;
      case 2:
        bytes.erase(at, length);
        break;
      case 3:
        bytes.insert(at, bytes.substr(at, length));
        break;
      case 4:  // extremes of the numbers in binary files
        bytes.replace(at, length, std::string(length, random() % 2 == 0 ? '\xff' : '\0'));
        break;
      default:
        if (!other.empty()) bytes.replace(at, length, other.substr(below(other.size()), length));
    }
  }
  return bytes;
}

/// The unchanged bytes: read_file refuses texts that look like a pointer of Git LFS, which fuzzers generate.
inline std::string bytes_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// `corpus` is unpacked in the build folder and has at least `least` files. `check` returns the problem of one input.
template <class Check>
void check_corpus(const std::string& corpus, std::size_t least, Check check) {
  std::vector<std::filesystem::path> names;
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(PHOTONPROOF_CORPORA "/" + corpus))
    names.push_back(entry.path());
  std::sort(names.begin(), names.end());
  for (const std::filesystem::path& name : names) files.push_back(bytes_of(name));
  EXPECT_GE(files.size(), least);
  const char* asked = std::getenv("PHOTONPROOF_MUTATIONS");
  // A few thousand in all, however many inputs fuzzing has left.
  const long some = std::clamp(3000 / std::max(static_cast<long>(files.size()), 1L), 5L, 100L);
  const long mutations = asked != nullptr ? std::atol(asked) : some;
  std::mt19937_64 random(1);
  for (std::size_t i = 0; i < files.size(); ++i) {
    for (const std::size_t part : {1, 3, 7, 8})
      EXPECT_EQ(check(std::string_view(files[i]).substr(0, files[i].size() * part / 8)), "")
          << names[i] << ", " << part;
    for (long n = 0; n < mutations; ++n) {
      const std::string bytes = mutated(files[i], files[random() % files.size()], random);
      const std::string problem = check(bytes);
      if (problem.empty()) continue;
      const std::filesystem::path kept =
          std::filesystem::temp_directory_path() / ("found-" + std::to_string(getpid()) + "-" + std::to_string(n));
      write_file_atomically(kept, bytes);
      ADD_FAILURE() << names[i] << ", mutation " << n << ", kept as " << kept << ": " << problem;
      return;
    }
  }
}

}  // namespace photonproof::inline scenes_base
