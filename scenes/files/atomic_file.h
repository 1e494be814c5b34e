// Whole files only: a file under its final name is always complete.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace photonproof::inline scenes_files {

/// Calls `produce(temporary_path)` for a path in the target's folder (same extension) and renames the result to
/// `target`. The temporary is a new file that `produce` truncates. Temporaries of the same target that killed processes
/// left are removed. On any exception the temporary is removed and `target` is unchanged. Throws InputError when the
/// folder does not exist or cannot be written.
void replace_atomically(const std::filesystem::path& target,
                        const std::function<void(const std::filesystem::path&)>& produce);

/// Throws InputError when replace_atomically would not replace `target`: its folder is missing, its name is too long,
/// or it is a folder, a device or a pipe.
void check_replaceable(const std::filesystem::path& target);

/// A new file beside `target`, to be written piece by piece before replace_atomically renames it.
std::filesystem::path temporary_for_rows(const std::filesystem::path& target);

/// Removes the temporaries of `target` left by processes that were killed while writing it.
void remove_abandoned_temporaries(const std::filesystem::path& target);

/// The same of every target in the folder.
void remove_all_abandoned_temporaries(const std::filesystem::path& folder);

/// Throws InputError when a file with this start is the pointer that Git leaves in place of a file in its Large File
/// Storage.
void refuse_lfs_pointer(const std::filesystem::path& path, std::string_view start);

/// Writes text or bytes through replace_atomically.
void write_file_atomically(const std::filesystem::path& target, std::string_view bytes);

/// The whole file; throws InputError when it is missing, not a regular file, larger than `max_bytes`, or a pointer of
/// Git LFS.
std::string read_file(const std::filesystem::path& path, std::size_t max_bytes = std::size_t{1} << 30);

}  // namespace photonproof::inline scenes_files
