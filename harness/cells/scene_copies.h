// What engines are given of a scene: a copy of its folder without the answers. The scene's own folder holds its
// committed reference and what is expected of it, and `cp reference.exr out.exr` would be the best engine of all.
//
// A copy has every file and folder of the original but
//   reference-<W>x<H>.exr and .json, expect.toml, hidden files, and folders that hold results (a results.json)
// under the same names, so that relative paths in the scene hold. (A scene names no file outside its folder:
// scenes/parser/scene_files.h.) Folders are real ones, for a link would lead back. Small files are copied; of large
// ones the blocks are shared where the file system can (a clone), else the file itself (a hard link), so that a scene
// of gigabytes costs no space or time; only where neither works is it copied. A symbolic link within the folder stays
// one; one that leads out is followed to a file, kept to a folder, and left out where it leads to the original's
// parents.
//
// This hides the answers from accident and from a line of shell, not from a program that searches the disk: whoever
// grades programs that are not trusted runs all of it where the references are not readable to them.
#pragma once

#include <filesystem>
#include <map>
#include <mutex>

#include "harness/suites/suite.h"

namespace photonproof::inline harness_cells {

class SceneCopies {
 public:
  /// Copies go into a folder of their own in `results_folder`, which exists and is locked by the caller; what a killed
  /// run left there is removed. All are gone with this object.
  explicit SceneCopies(const std::filesystem::path& results_folder);
  ~SceneCopies();
  SceneCopies(const SceneCopies&) = delete;
  SceneCopies& operator=(const SceneCopies&) = delete;

  /// The copy of a file of the scene, whose folder is copied when it is first asked for. May be called on several
  /// threads. Throws InputError where the folder cannot be copied.
  std::filesystem::path of(const SuiteScene& scene, const std::filesystem::path& file);

 private:
  std::filesystem::path results_folder_, folder_;
  std::mutex copying_;
  std::map<std::filesystem::path, std::filesystem::path> copies_;  ///< by original folder, symbolic links followed
};

}  // namespace photonproof::inline harness_cells
