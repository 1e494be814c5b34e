#include "scenes/files/atomic_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <csignal>
#include <fstream>
#include <system_error>

#include "scenes/base/input_error.h"
#include "scenes/files/checksum.h"

namespace photonproof::inline scenes_files {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view partial_mark = ".partial-";
constexpr std::string_view rows_mark = "-rows";  // of a temporary that is written before its target is replaced
constexpr std::string_view lfs_pointer_start = "version https://git-lfs.github.com/spec/";

fs::path folder_of(const fs::path& target) { return target.has_parent_path() ? target.parent_path() : fs::path("."); }

/// Start of a temporary's name, before the writing process and the target's extension. File systems limit names to 255
/// bytes, so a longer stem is cut and followed by the checksum of the whole stem.
std::string temporary_start(const fs::path& target) {
  constexpr std::size_t most = 120;
  std::string stem = target.stem().string();
  if (stem.size() > most) {
    Checksum whole;
    whole.add(stem.data(), stem.size());
    stem = stem.substr(0, most) + "~" + whole.hex();
  }
  return "." + stem + std::string(partial_mark);
}

/// The process that writes the temporary of this name; 0 where it is no temporary. With `start`, only temporaries of
/// that target count, else those of any.
pid_t writer_of(const std::string& name, const std::string& start) {
  const std::size_t mark = name.rfind(partial_mark);
  if (mark == std::string::npos || name[0] != '.') return 0;
  const std::size_t digits = mark + partial_mark.size();
  if (!start.empty() && name.substr(0, digits) != start) return 0;
  pid_t process = 0;
  const auto [stop, problem] = std::from_chars(name.data() + digits, name.data() + name.size(), process);
  std::string_view rest(stop, name.data() + name.size());
  if (rest.starts_with(rows_mark)) rest.remove_prefix(rows_mark.size());
  return problem == std::errc{} && (rest.empty() || rest[0] == '.') ? process : 0;
}

void remove_abandoned(const fs::path& folder, const std::string& start, const fs::path& extension) {
  std::error_code error, ignored;
  for (fs::directory_iterator entry(folder, error), none; !error && entry != none; entry.increment(error)) {
    const fs::path& file = entry->path();
    const pid_t writer = writer_of(file.filename().string(), start);
    const bool is_ours = writer > 0 && (start.empty() || file.extension() == extension);
    if (is_ours && kill(writer, 0) != 0 && errno == ESRCH) fs::remove(file, ignored);
  }
}

/// Marks the new file until the producer truncates it. The file is new: existing files of its name are never written
/// to.
constexpr char not_produced = '?';

void make_new_file(const fs::path& temporary, const fs::path& target) {
  unlink(temporary.c_str());  // left by a process of the same number
  const int file = open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
  const bool made = file >= 0 && write(file, &not_produced, 1) == 1;
  const int reason = errno;
  if (file >= 0) close(file);
  if (made) return;
  unlink(temporary.c_str());
  throw InputError(target.string(), "cannot be written: " + std::generic_category().message(reason));
}

bool was_produced(const fs::path& temporary) {
  std::error_code error;
  if (fs::file_size(temporary, error) != 1) return !error;
  return std::ifstream(temporary).get() != not_produced;
}

}  // namespace

void refuse_lfs_pointer(const fs::path& path, std::string_view start) {
  if (start.starts_with(lfs_pointer_start))
    throw InputError(path.string(), "is a pointer of Git LFS, not the file itself: fetch it with git lfs pull");
}

fs::path temporary_for_rows(const fs::path& target) {
  fs::path temporary = folder_of(target) / (temporary_start(target) + std::to_string(getpid()) +
                                            std::string(rows_mark) + target.extension().string());
  make_new_file(temporary, target);
  return temporary;
}

void check_replaceable(const fs::path& target) {
  std::error_code error;
  const fs::path folder = folder_of(target);
  if (!fs::is_directory(folder, error))
    throw InputError(target.string(), "folder '" + folder.string() + "' does not exist");
  const fs::file_status status = fs::status(target, error);
  if (status.type() == fs::file_type::none) throw InputError(target.string(), "cannot be written: " + error.message());
  if (fs::is_directory(status)) throw InputError(target.string(), "is a folder, expected a file name");
  if (fs::exists(status) && !fs::is_regular_file(status))
    throw InputError(target.string(), "is not a regular file: replacing it would destroy a device or a pipe");
}

void replace_atomically(const fs::path& target, const std::function<void(const fs::path&)>& produce) {
  check_replaceable(target);
  remove_abandoned_temporaries(target);
  const fs::path temporary =
      folder_of(target) / (temporary_start(target) + std::to_string(getpid()) + target.extension().string());
  make_new_file(temporary, target);
  try {
    produce(temporary);
    if (!was_produced(temporary)) throw InputError(target.string(), "cannot be written: nothing was");
    fs::rename(temporary, target);
  } catch (const fs::filesystem_error& error) {
    std::error_code ignored;
    fs::remove(temporary, ignored);
    throw InputError(target.string(), "cannot be written: " + error.code().message());
  } catch (...) {
    std::error_code ignored;
    fs::remove(temporary, ignored);
    throw;
  }
}

void write_file_atomically(const fs::path& target, std::string_view bytes) {
  replace_atomically(target, [&](const fs::path& temporary) {
    std::ofstream out(temporary, std::ios::binary);
    out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    out.close();
    if (!out) throw InputError(target.string(), "cannot be written (permission or disk full)");
  });
}

std::string read_file(const fs::path& path, std::size_t max_bytes) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (status.type() == fs::file_type::none) throw InputError(path.string(), "cannot be read: " + error.message());
  if (!fs::exists(status)) throw InputError(path.string(), "no such file");
  if (!fs::is_regular_file(status)) throw InputError(path.string(), "not a regular file");
  const auto size = fs::file_size(path, error);
  if (error) throw InputError(path.string(), "cannot be read: " + error.message());
  if (size > max_bytes)
    throw InputError(path.string(),
                     "file has " + std::to_string(size) + " bytes, the limit is " + std::to_string(max_bytes));
  std::string bytes(size, '\0');
  std::ifstream in(path, std::ios::binary);
  in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!in && !(size == 0 && in.eof())) throw InputError(path.string(), "cannot be read (permission?)");
  refuse_lfs_pointer(path, bytes);
  return bytes;
}

void remove_abandoned_temporaries(const fs::path& target) {
  remove_abandoned(folder_of(target), temporary_start(target), target.extension());
}

void remove_all_abandoned_temporaries(const fs::path& folder) { remove_abandoned(folder, {}, {}); }

}  // namespace photonproof::inline scenes_files
