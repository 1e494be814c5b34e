// Copies of scenes for engines: a scene's folder without the answers. The scene's own folder holds its committed
// reference and its expectations, and `cp reference.exr out.exr` would be the best engine of all.
//
// A copy has the original's files and folders under the same names, so that relative paths in the scene hold. It leaves
// out reference-<W>x<H>.exr and .json, expect.toml, hidden files, and folders with results (results.json or .lock). (A
// scene names no file outside its folder: scenes/parser/scene_files.h.) Folders are real ones, since a link would lead
// back. Small files are copied. Large ones share their blocks where the file system can (a clone), else the file itself
// (a hard link), so that a scene of gigabytes costs no space or time. Only where neither works are they copied. A
// symbolic link within the folder stays one. A link to a file outside is followed; one to a folder outside stays a
// link, unless it leads to the original's parents: then it is left out.
//
// This hides the answers from accidents and from a line of shell, not from a program that searches the disk. To grade
// untrusted programs, run all of it where they cannot read the references.
#pragma once

#include <filesystem>
#include <map>
#include <mutex>

#include "harness/suites/suite.h"

namespace photonproof::inline harness_cells {

class SceneCopies {
 public:
  /// Copies go into a folder of their own in `results_folder`, which exists and is locked by the caller. The
  /// constructor removes what a killed run left there, and the destructor removes all copies.
  explicit SceneCopies(const std::filesystem::path& results_folder);
  ~SceneCopies();
  SceneCopies(const SceneCopies&) = delete;
  SceneCopies& operator=(const SceneCopies&) = delete;

  /// Path of `file` in the copy, or of the copy where `file` is a folder; the first call for a folder copies it. May be
  /// called on several threads. Throws InputError where the folder cannot be copied.
  std::filesystem::path of(const SuiteScene& scene, const std::filesystem::path& file);

 private:
  std::filesystem::path results_folder_, folder_;
  std::mutex copying_;
  std::map<std::filesystem::path, std::filesystem::path> copies_;  ///< by original folder, symbolic links followed
};

}  // namespace photonproof::inline harness_cells
