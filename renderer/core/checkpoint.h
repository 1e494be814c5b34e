// The file a long render can go on from: what it is a checkpoint of, as lines of text, then the state, then a checksum.
// It is for the program that wrote it, on a machine of the same byte order; anything else is refused by name.
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

/// What decides the bits of an image, as (what it is called, its value): a checkpoint fits a render of equal identity.
using RenderIdentity = std::vector<std::pair<std::string, std::string>>;

/// Whether and where a render leaves checkpoints.
struct CheckpointPolicy {
  std::filesystem::path file;
  double interval_seconds = 60;  ///< 0: none is written
  bool resume = false;           ///< go on from `file`
  RenderIdentity identity;

  /// Before the work begins. Where there is nothing to go on from, `resume` is switched off and the answer is no: a
  /// script may ask for it always. Throws InputError when a render that starts anew would replace a checkpoint, which
  /// may be hours of somebody's work, or when the render that writes it is still at work.
  bool finds_what_it_resumes();
};

/// Collects a checkpoint in memory, so that the render stands still no longer than that takes.
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

/// Throws InputError naming the file where it ends too early or holds what does not fit.
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
  /// Into a vector that has its size already.
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

/// Puts a checkpoint of what `state` writes into `content`, whose memory is used again.
void fill_checkpoint(std::string& content, const RenderIdentity& identity,
                     const std::function<void(StateWriter&)>& state);

/// Replaces `file` atomically: after kill -9 at any moment there is the old one or the new one. Throws InputError when
/// it cannot be written. `claim`, where there is one, moves to the new file before it has its name.
void write_checkpoint(const std::filesystem::path& file, const std::string& content, FileClaim* claim = nullptr);

/// Reads what `write_checkpoint` wrote. Throws InputError when the file is missing, no checkpoint, damaged, or of a
/// render of another identity, naming the first difference; all this before `state` is called.
void read_checkpoint(const std::filesystem::path& file, const RenderIdentity& identity,
                     const std::function<void(StateReader&)>& state);

}  // namespace photonproof::inline renderer_core
