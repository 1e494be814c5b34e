// Whole files only: a file under its final name is always complete.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace photonproof {

/// Calls `produce(temporary_path)` for a path in the target's folder (same extension) and renames the result to
/// `target`. On any exception the temporary is removed and `target` is as it was. Throws InputError when the folder
/// does not exist or cannot be written.
void replace_atomically(const std::filesystem::path& target,
                        const std::function<void(const std::filesystem::path&)>& produce);

/// Removes the temporaries of `target` that processes left which were killed while they wrote it.
void remove_abandoned_temporaries(const std::filesystem::path& target);

/// Writes text or bytes through replace_atomically.
void write_file_atomically(const std::filesystem::path& target, std::string_view bytes);

/// The whole file; throws InputError when it is missing, not a regular file, or larger than `max_bytes`.
std::string read_file(const std::filesystem::path& path, std::size_t max_bytes = std::size_t{1} << 30);

}  // namespace photonproof
