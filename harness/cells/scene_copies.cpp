#include "harness/cells/scene_copies.h"

#include <fcntl.h>
#include <linux/fs.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <string_view>

#include "scenes/base/input_error.h"

namespace photonproof::inline harness_cells {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t small_file_bytes = std::uintmax_t{1} << 20;

bool is_number(std::string_view text) {
  return !text.empty() && std::ranges::all_of(text, [](unsigned char c) { return std::isdigit(c) != 0; });
}

/// reference-64x48.exr and .json, as committed_reference_path names them, and expect.toml.
bool is_answer(const fs::path& file) {
  if (file.filename() == "expect.toml") return true;
  if (file.extension() != ".exr" && file.extension() != ".json") return false;
  const std::string stem = file.stem().string();
  constexpr std::string_view start = "reference-";
  const std::size_t x = stem.find('x', start.size());
  return stem.starts_with(start) && x != std::string::npos &&
         is_number(std::string_view(stem).substr(start.size(), x - start.size())) &&
         is_number(std::string_view(stem).substr(x + 1));
}

bool is_within(const fs::path& path, const fs::path& folder) {
  const fs::path relative = path.lexically_relative(folder);
  return !relative.empty() && *relative.begin() != "..";
}

bool clone_file(const fs::path& from, const fs::path& to) {
  const int source = open(from.c_str(), O_RDONLY | O_CLOEXEC);
  if (source < 0) return false;
  const int target = open(to.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
  const bool cloned = target >= 0 && ioctl(target, FICLONE, source) == 0;
  close(source);
  if (target >= 0) close(target);
  std::error_code ignored;
  if (!cloned && target >= 0) fs::remove(to, ignored);
  if (cloned) fs::permissions(to, fs::status(from, ignored).permissions(), ignored);
  return cloned;
}

/// `from` is no symbolic link. A file that has disappeared since it was seen, as temporary files do, is left out.
void give_file(const fs::path& from, const fs::path& to) {
  std::error_code error;
  if (fs::file_size(from, error) > small_file_bytes) {
    if (clone_file(from, to)) return;
    fs::create_hard_link(from, to, error);
    if (!error) return;
  }
  fs::copy_file(from, to, error);
  std::error_code ignored;
  if (error && fs::exists(from, ignored)) throw fs::filesystem_error("copy", from, to, error);
}

class FolderCopy {
 public:
  FolderCopy(fs::path original, const fs::path& results_folder)
      : original_(std::move(original)), results_folder_(fs::weakly_canonical(results_folder)) {}

  void copy(const fs::path& from, const fs::path& to) const {
    fs::create_directories(to);
    for (const fs::directory_entry& entry :
         fs::directory_iterator(from, fs::directory_options::skip_permission_denied)) {
      const fs::path name = entry.path().filename();
      if (name.native().front() == '.' || is_answer(name)) continue;
      if (entry.is_symlink())
        copy_link(entry.path(), to / name);
      else if (entry.is_directory() && !holds_results(entry.path()))
        copy(entry.path(), to / name);
      else if (entry.is_regular_file() && access(entry.path().c_str(), R_OK) == 0)
        give_file(entry.path(), to / name);
    }
  }

 private:
  bool holds_results(const fs::path& folder) const {
    std::error_code ignored;
    return fs::weakly_canonical(folder, ignored) == results_folder_ || fs::exists(folder / "results.json", ignored) ||
           fs::exists(folder / ".lock", ignored);  // another run's folder, still without results
  }

  void copy_link(const fs::path& link, const fs::path& to) const {
    std::error_code error;
    const fs::path target = fs::canonical(link, error);
    if (error) return;  // a broken link
    if (is_within(target, original_))
      fs::create_symlink(target.lexically_relative(fs::canonical(link.parent_path())), to);
    else if (fs::is_directory(target) && !is_within(original_, target))
      fs::create_directory_symlink(target, to);
    else if (fs::is_regular_file(target) && !is_answer(target))
      give_file(target, to);
  }

  fs::path original_, results_folder_;
};

}  // namespace

SceneCopies::SceneCopies(const fs::path& results_folder)
    : results_folder_(results_folder), folder_(results_folder / ".photonproof-scenes") {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

SceneCopies::~SceneCopies() {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

fs::path SceneCopies::of(const SuiteScene& scene, const fs::path& file) {
  const std::lock_guard lock(copying_);
  try {
    const fs::path real = fs::canonical(file);
    const bool is_folder = fs::is_directory(real);
    const fs::path folder = is_folder ? real : fs::canonical(file.has_parent_path() ? file.parent_path() : ".");
    auto copy = copies_.find(folder);
    if (copy == copies_.end()) {
      const std::string number = copies_.empty() ? "" : "-" + std::to_string(copies_.size() + 1);
      const fs::path name = folder.has_filename() ? folder.filename() : fs::path("scene");
      const fs::path to = folder_ / (scene.name + number) / name;
      FolderCopy(folder, results_folder_).copy(folder, to);
      copy = copies_.emplace(folder, to).first;
    }
    if (is_folder) return copy->second;
    const fs::path given = copy->second / file.filename();
    if (!fs::exists(given)) give_file(real, given);
    return given;
  } catch (const fs::filesystem_error& error) {
    throw InputError(file.string(), "its folder cannot be copied for the engines: " + std::string(error.what()));
  }
}

}  // namespace photonproof::inline harness_cells
