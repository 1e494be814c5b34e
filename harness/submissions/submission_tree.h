// The files of a submission, checked from outside while no part of it runs.
#pragma once

#include <filesystem>
#include <string>

namespace photonproof::inline harness_submissions {

/// Empty if the tree has only folders, regular files and links that stay inside, at most `files` in all. Else a
/// sentence about the error that begins with the entry's name.
std::string what_is_wrong_with_tree(const std::filesystem::path& folder, int files);

/// If the tree's only entry is a folder, its content takes the folder's place. Entries that macOS adds to archives do
/// not count.
void enter_only_folder(const std::filesystem::path& folder);

/// Copies the tree of `staff` over the other, file by file. An entry of another kind in the place of a staff file or
/// folder is removed, even a link to one of the same kind. No link is followed.
void overwrite_files(const std::filesystem::path& staff, const std::filesystem::path& folder);

/// Makes a folder of links to the entries of `target`, which may not exist here. Along `own_file`, a relative path,
/// folders are real ones with links inside, so that the file can be written. `tree` is `target` as seen from here.
void link_farm(const std::filesystem::path& tree, const std::filesystem::path& target,
               const std::filesystem::path& own_file, const std::filesystem::path& farm);

}  // namespace photonproof::inline harness_submissions
