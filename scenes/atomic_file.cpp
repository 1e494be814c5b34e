#include "scenes/atomic_file.h"

#include <unistd.h>

#include <fstream>
#include <system_error>

#include "scenes/input_error.h"

namespace photonproof {
namespace fs = std::filesystem;

void replace_atomically(const fs::path& target, const std::function<void(const fs::path&)>& produce) {
  const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
  if (!fs::is_directory(folder)) throw InputError(target.string(), "folder '" + folder.string() + "' does not exist");
  if (fs::is_directory(target)) throw InputError(target.string(), "is a folder, expected a file name");
  if (fs::exists(target) && !fs::is_regular_file(target))
    throw InputError(target.string(), "is not a regular file: replacing it would destroy a device or a pipe");
  const fs::path temporary =
      folder / ("." + target.stem().string() + ".partial-" + std::to_string(getpid()) + target.extension().string());
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

}  // namespace photonproof
