#include "harness/submissions/submission_tree.h"

#include <algorithm>
#include <system_error>
#include <vector>

#include "scenes/base/utf8.h"

namespace photonproof::inline harness_submissions {
namespace {

namespace fs = std::filesystem;

bool is_inside(const fs::path& path, const fs::path& folder) {
  return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first == folder.end();
}

// `root` is canonical. The target depends on the links on its way, so the link's text alone does not give it.
std::string what_is_wrong_with_link(const fs::path& link, const fs::path& root) {
  const std::string name = printable(link.lexically_relative(root).string());
  std::error_code failure;
  const fs::path target = fs::read_symlink(link, failure);
  const std::string shown = name + " is a link to " + printable(target.string());
  if (failure || target.is_absolute()) return shown + ", outside of the submission";
  const fs::path met = fs::weakly_canonical(link.parent_path() / target, failure);
  if (failure) return shown + ", which leads nowhere";
  return is_inside(met, root) ? "" : shown + ", outside of the submission";
}

bool is_of_macos(const fs::path& path) {
  const std::string name = path.filename().string();
  return name == "__MACOSX" || name == ".DS_Store";
}

bool is_real_folder(const fs::path& path) { return fs::symlink_status(path).type() == fs::file_type::directory; }

// Replaces `path` by a folder without any other name.
void make_real_folder(const fs::path& path) {
  if (is_real_folder(path)) return;
  fs::remove_all(path);
  fs::create_directory(path);
}

}  // namespace

std::string what_is_wrong_with_tree(const fs::path& folder, int files) {
  const fs::path root = fs::canonical(folder);
  int met = 0;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root)) {
    if (++met > files) return "it has more than " + std::to_string(files) + " files";
    const fs::file_type type = entry.symlink_status().type();
    if (type == fs::file_type::symlink) {
      if (const std::string wrong = what_is_wrong_with_link(entry.path(), root); !wrong.empty()) return wrong;
    } else if (type != fs::file_type::regular && type != fs::file_type::directory) {
      return printable(entry.path().lexically_relative(root).string()) + " is a device, a pipe or a socket";
    }
  }
  return {};
}

void enter_only_folder(const fs::path& folder) {
  std::vector<fs::path> entries;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    if (!is_of_macos(entry.path())) entries.push_back(entry.path());
  if (entries.size() != 1 || !is_real_folder(entries[0])) return;
  const fs::path aside = folder.string() + ".entered";  // a separate name, since the folder may hold the same one
  fs::remove_all(aside);
  fs::rename(entries[0], aside);
  fs::remove_all(folder);
  fs::rename(aside, folder);
}

void overwrite_files(const fs::path& staff, const fs::path& folder) {
  for (const fs::directory_entry& entry : fs::directory_iterator(staff)) {
    const fs::path to = folder / entry.path().filename();
    if (entry.is_directory()) {
      make_real_folder(to);
      overwrite_files(entry.path(), to);
    } else {
      fs::remove_all(to);  // also a file, which may have several names
      fs::copy_file(entry.path(), to);
    }
  }
}

void link_farm(const fs::path& tree, const fs::path& target, const fs::path& own_file, const fs::path& farm) {
  fs::create_directories(farm);
  const fs::path own = own_file.empty() ? fs::path() : *own_file.begin();
  const fs::path below = own_file.lexically_relative(own);
  const bool is_last = own_file.empty() || below == ".";
  std::error_code none;
  if (fs::is_directory(tree, none))
    for (const fs::directory_entry& entry : fs::directory_iterator(tree))
      if (entry.path().filename() != own)
        fs::create_symlink(target / entry.path().filename(), farm / entry.path().filename());
  if (!is_last) link_farm(tree / own, target / own, below, farm / own);
}

}  // namespace photonproof::inline harness_submissions
