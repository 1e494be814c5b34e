#include "harness/grading/scene_folder.h"

#include <map>
#include <system_error>
#include <utility>
#include <vector>

#include "harness/cells/cells.h"
#include "harness/submissions/run_submission.h"
#include "scenes/base/input_error.h"
#include "scenes/description/file_names.h"
#include "scenes/files/atomic_file.h"
#include "scenes/files/file_checksum.h"
#include "scenes/xml/writer.h"

namespace photonproof::inline harness_grading {
namespace {

namespace fs = std::filesystem;

void copy_for_all(const fs::path& from, const fs::path& to) {
  std::error_code error;
  fs::copy_file(from, to, error);
  if (error) throw InputError(from.string(), "cannot be copied: " + error.message());
  fs::permissions(to, fs::perms::owner_write | fs::perms::owner_read | fs::perms::group_read | fs::perms::others_read);
}

}  // namespace

SceneFolder make_scene_folder(SceneDescription scene, const fs::path& folder) {
  fs::remove_all(folder);
  fs::create_directories(folder);
  scene = with_absolute_files(std::move(scene));
  std::map<std::string, std::string> given;  // one file may serve several times
  std::vector<std::pair<std::string, std::string>> parts;
  visit_file_names(scene, [&](std::string& name) {
    const auto [place, is_new] = given.try_emplace(name);
    if (is_new) {
      place->second = "file-" + std::to_string(given.size()) + fs::path(name).extension().string();
      copy_for_all(name, folder / place->second);
      parts.emplace_back(place->second, file_checksum(name));
    }
    name = place->second;
  });
  const std::string text = write_scene(scene);
  parts.emplace_back(scene_file_name, text);
  const fs::path file = folder / scene_file_name;
  write_file_atomically(file, text);
  fs::permissions(file, fs::perms::group_read | fs::perms::others_read, fs::perm_options::add);
  fs::permissions(folder, fs::perms::owner_all | fs::perms::group_read | fs::perms::group_exec |
                              fs::perms::others_read | fs::perms::others_exec);
  return {folder, content_key(parts)};
}

}  // namespace photonproof::inline harness_grading
