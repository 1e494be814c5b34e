// The file from which a long render continues: its identity as lines of text, then the state, then a checksum. It is
// for the program that wrote it, on a machine of the same byte order; any other file is refused by name.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "scenes/files/checksum.h"
#include "scenes/files/file_claim.h"

namespace photonproof::inline renderer_core {

/// Settings that affect the bits of an image, as (name, value): a checkpoint fits a render of equal identity.
using RenderIdentity = std::vector<std::pair<std::string, std::string>>;

/// Whether and where a render writes checkpoints.
struct CheckpointPolicy {
  std::filesystem::path file;
  double interval_seconds = 60;  ///< 0: none is written
  bool resume = false;           ///< continue from `file`
  RenderIdentity identity;

  /// Call before the work begins. Without a file to continue from, it switches `resume` off and returns false, so a
  /// script may always request it. Throws InputError when a new render would replace a checkpoint, which may be hours
  /// of work, or when the render that writes it is still running.
  bool finds_what_it_resumes();
};

/// Collects a checkpoint in memory; the render pauses only for this copy.
class StateWriter {
 public:
  explicit StateWriter(std::string& out) : out_(out) {}

  void bytes(const void* data, std::size_t count);
  template <class T>
  void value(const T& v) {
    static_assert(std::is_trivially_copyable_v<T>);
    bytes(&v, sizeof v);
  }
  template <class T>
  void vector(const std::vector<T>& v) {
    static_assert(std::is_trivially_copyable_v<T>);
    value(std::uint64_t{v.size()});
    bytes(v.data(), v.size() * sizeof(T));
  }
  void text(const std::string& s);

 private:
  std::string& out_;
};

/// Throws InputError naming the file where it ends too early or holds a value that does not fit.
class StateReader {
 public:
  StateReader(const std::filesystem::path& file, std::ifstream& in, std::uint64_t bytes_left)
      : file_(file), in_(in), left_(bytes_left) {}

  void bytes(void* data, std::size_t count);
  template <class T>
  T value() {
    static_assert(std::is_trivially_copyable_v<T>);
    T v;
    bytes(&v, sizeof v);
    return v;
  }
  /// Reads into a vector that already has its size.
  template <class T>
  void vector(std::vector<T>& v) {
    static_assert(std::is_trivially_copyable_v<T>);
    if (value<std::uint64_t>() != v.size()) refuse("its tables have another size");
    bytes(v.data(), v.size() * sizeof(T));
  }
  std::string text();
  std::uint64_t bytes_left() const { return left_; }
  [[noreturn]] void refuse(const std::string& why) const;

 private:
  const std::filesystem::path& file_;
  std::ifstream& in_;
  std::uint64_t left_;
};

/// Puts a checkpoint with the output of `state` into `content`, whose memory is reused.
void fill_checkpoint(std::string& content, const RenderIdentity& identity,
                     const std::function<void(StateWriter&)>& state);

/// Replaces `file` atomically: after kill -9 at any moment there is the old one or the new one. Throws InputError when
/// it cannot be written. `claim`, if given, moves to the new file before the file gets its name.
void write_checkpoint(const std::filesystem::path& file, const std::string& content, FileClaim* claim = nullptr);

/// Reads a file of `write_checkpoint`. Throws InputError when the file is missing, no checkpoint, damaged, or of a
/// render of another identity, naming the first difference; all this before `state` is called.
void read_checkpoint(const std::filesystem::path& file, const RenderIdentity& identity,
                     const std::function<void(StateReader&)>& state);

}  // namespace photonproof::inline renderer_core
