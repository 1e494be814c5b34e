#include "renderer/core/checkpoint.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cstring>

#include "scenes/base/input_error.h"
#include "scenes/files/atomic_file.h"

namespace photonproof::inline renderer_core {
namespace {

constexpr char magic[] = "photonproof checkpoint 1\n";
constexpr std::size_t magic_bytes = sizeof magic - 1;
constexpr std::uint64_t longest_text = 1 << 16;

/// Checks that the last 8 bytes are the hash of all others. Leaves `in` behind the magic; returns the number of bytes
/// of the state.
std::uint64_t verify(const std::filesystem::path& file, std::ifstream& in) {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  char start[magic_bytes] = {};
  in.read(start, magic_bytes);
  if (error || !in || std::memcmp(start, magic, magic_bytes) != 0)
    throw InputError(file.string(), "is not a checkpoint of a render");
  const auto damaged = [&] { throw InputError(file.string(), "is damaged or cut short: its checksum does not fit"); };
  if (size < magic_bytes + sizeof(std::uint64_t)) damaged();
  const std::uint64_t state_bytes = size - magic_bytes - sizeof(std::uint64_t);
  Checksum checksum;
  checksum.add(start, magic_bytes);
  std::vector<char> piece(std::size_t{1} << 20);
  for (std::uint64_t left = state_bytes; left > 0 && in;) {
    const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(left, piece.size()));
    in.read(piece.data(), static_cast<std::streamsize>(count));
    checksum.add(piece.data(), count);
    left -= count;
  }
  std::uint64_t stored = 0;
  in.read(reinterpret_cast<char*>(&stored), sizeof stored);
  if (!in || stored != checksum.value()) damaged();
  in.seekg(magic_bytes);
  return state_bytes;
}

/// Writes a file's bytes to the disk; false on failure. kill -9 does not need it, but after a power failure the new
/// name must not stand for unwritten bytes. Only the writing thread waits.
bool reaches_disk(const std::filesystem::path& file) {
  const int descriptor = open(file.c_str(), O_WRONLY | O_CLOEXEC);
  if (descriptor < 0) return false;
  const bool done = fsync(descriptor) == 0;
  close(descriptor);
  return done;
}

void check_identity(StateReader& in, const RenderIdentity& identity) {
  const auto count = in.value<std::uint64_t>();
  for (const auto& [name, value] : identity) {
    const std::string their_name = in.text();
    const std::string theirs = in.text();
    if (their_name != name) in.refuse("it names other things than this program's");
    if (theirs != value) in.refuse("its " + name + " is " + theirs + ", this render's is " + value);
  }
  if (count != identity.size()) in.refuse("it names other things than this program's");
}

}  // namespace

bool CheckpointPolicy::finds_what_it_resumes() {
  std::error_code ignored;
  const bool exists = std::filesystem::exists(file, ignored);
  if (resume && !exists) {
    resume = false;
    return false;
  }
  if ((resume || interval_seconds > 0) && FileClaim::is_on(file))
    throw InputError(file.string(),
                     "the render that writes this checkpoint is still at work: wait for it, or choose another output");
  if (!resume && exists && interval_seconds > 0)
    throw InputError(file.string(),
                     "an unfinished render left this checkpoint: go on from it with --resume, or delete it");
  return true;
}

void StateWriter::bytes(const void* data, std::size_t count) {
  constexpr std::size_t room_for_more = 4096;  // after a film, small things follow that should not double the memory
  if (out_.capacity() - out_.size() < count) out_.reserve(out_.size() + count + room_for_more);
  out_.append(static_cast<const char*>(data), count);
}

void StateWriter::text(const std::string& s) {
  value(std::uint64_t{s.size()});
  bytes(s.data(), s.size());
}

void StateReader::bytes(void* data, std::size_t count) {
  if (count == 0) return;
  if (count > left_) refuse("it holds less than it should");
  in_.read(static_cast<char*>(data), static_cast<std::streamsize>(count));
  if (!in_) refuse("it cannot be read");
  left_ -= count;
}

std::string StateReader::text() {
  const auto count = value<std::uint64_t>();
  if (count > std::min(left_, longest_text)) refuse("it holds less than it should");
  std::string s(static_cast<std::size_t>(count), '\0');
  bytes(s.data(), s.size());
  return s;
}

void StateReader::refuse(const std::string& why) const {
  throw InputError(file_.string(), "the checkpoint is not one of this render: " + why);
}

void fill_checkpoint(std::string& content, const RenderIdentity& identity,
                     const std::function<void(StateWriter&)>& state) {
  content.clear();
  StateWriter writer(content);
  writer.bytes(magic, magic_bytes);
  writer.value(std::uint64_t{identity.size()});
  for (const auto& [name, value] : identity) {
    writer.text(name);
    writer.text(value);
  }
  state(writer);
}

void write_checkpoint(const std::filesystem::path& file, const std::string& content, FileClaim* claim) {
  Checksum checksum;
  checksum.add(content.data(), content.size());
  const std::uint64_t sum = checksum.value();
  replace_atomically(file, [&](const std::filesystem::path& temporary) {
    std::ofstream out(temporary, std::ios::binary);
    out.write(content.data(), static_cast<std::streamsize>(content.size()));
    out.write(reinterpret_cast<const char*>(&sum), sizeof sum);
    out.close();
    if (!out || !reaches_disk(temporary))
      throw InputError(file.string(), "cannot be written (permission or disk full)");
    if (claim != nullptr) claim->move_to(temporary);
  });
}

void read_checkpoint(const std::filesystem::path& file, const RenderIdentity& identity,
                     const std::function<void(StateReader&)>& state) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error))
    throw InputError(file.string(), "is not a checkpoint of a render");
  std::ifstream in(file, std::ios::binary);
  if (!in) throw InputError(file.string(), "cannot be read (permission?)");
  const std::uint64_t state_bytes = verify(file, in);
  StateReader reader(file, in, state_bytes);
  check_identity(reader, identity);
  state(reader);
  if (reader.bytes_left() > 0) reader.refuse("it holds more than it should");
}

}  // namespace photonproof::inline renderer_core
