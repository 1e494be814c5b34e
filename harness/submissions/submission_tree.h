// The files of a submission as the grader looks at them from outside: nothing of it is running.
#pragma once

#include <filesystem>
#include <string>

namespace photonproof::inline harness_submissions {

/// Empty when the tree has only folders, regular files and links that stay inside, `files` of them at most; else what
/// is wrong, in a sentence that begins with the name.
std::string what_is_wrong_with_tree(const std::filesystem::path& folder, int files);

/// Where the tree's only entry is a folder, its content takes its place. What macOS adds to archives does not count.
void enter_only_folder(const std::filesystem::path& folder);

/// Copies the tree of `staff` over the other, file by file. What stands in the place of a file or a folder of staff's
/// and is of another kind, also a link to one of the same, is removed; no link is followed.
void overwrite_files(const std::filesystem::path& staff, const std::filesystem::path& folder);

/// A folder whose entries are links to those of `target`, which may not exist here; along `own_file`, a relative path,
/// folders are real ones of the same kind, so that the file can be written. `tree` is `target` as it is seen here.
void link_farm(const std::filesystem::path& tree, const std::filesystem::path& target,
               const std::filesystem::path& own_file, const std::filesystem::path& farm);

}  // namespace photonproof::inline harness_submissions
