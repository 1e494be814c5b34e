#include "scenes/atomic_file.h"

#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <csignal>
#include <fstream>
#include <system_error>

#include "scenes/input_error.h"

namespace photonproof {
namespace fs = std::filesystem;
namespace {

fs::path folder_of(const fs::path& target) { return target.has_parent_path() ? target.parent_path() : fs::path("."); }

/// Of a temporary's name: the process that writes it and the target's extension follow.
std::string temporary_start(const fs::path& target) { return "." + target.stem().string() + ".partial-"; }

}  // namespace

void replace_atomically(const fs::path& target, const std::function<void(const fs::path&)>& produce) {
  const fs::path folder = folder_of(target);
  if (!fs::is_directory(folder)) throw InputError(target.string(), "folder '" + folder.string() + "' does not exist");
  if (fs::is_directory(target)) throw InputError(target.string(), "is a folder, expected a file name");
  if (fs::exists(target) && !fs::is_regular_file(target))
    throw InputError(target.string(), "is not a regular file: replacing it would destroy a device or a pipe");
  const fs::path temporary =
      folder / (temporary_start(target) + std::to_string(getpid()) + target.extension().string());
  try {
    produce(temporary);
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
  if (!fs::exists(path, error)) throw InputError(path.string(), "no such file");
  if (!fs::is_regular_file(path, error)) throw InputError(path.string(), "not a regular file");
  const auto size = fs::file_size(path, error);
  if (error) throw InputError(path.string(), "cannot be read: " + error.message());
  if (size > max_bytes)
    throw InputError(path.string(),
                     "file has " + std::to_string(size) + " bytes, the limit is " + std::to_string(max_bytes));
  std::string bytes(size, '\0');
  std::ifstream in(path, std::ios::binary);
  in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!in && !(size == 0 && in.eof())) throw InputError(path.string(), "cannot be read (permission?)");
  return bytes;
}

void remove_abandoned_temporaries(const fs::path& target) {
  const std::string start = temporary_start(target);
  const std::string end = target.extension().string();
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_of(target), error)) {
    const std::string name = entry.path().filename().string();
    if (name.size() <= start.size() + end.size() || !name.starts_with(start) || !name.ends_with(end)) continue;
    const char* digits_end = name.data() + name.size() - end.size();
    pid_t process = 0;
    const auto [stop, problem] = std::from_chars(name.data() + start.size(), digits_end, process);
    if (problem != std::errc{} || stop != digits_end || process <= 0) continue;
    std::error_code ignored;
    if (kill(process, 0) != 0 && errno == ESRCH) fs::remove(entry.path(), ignored);
  }
}

}  // namespace photonproof
