// How much memory a render may still take: to refuse what cannot fit before the system kills something for it.
#pragma once

#include <cstdint>
#include <istream>
#include <optional>

namespace photonproof::inline renderer_core {

/// Bytes: the least that the machine (MemAvailable), the process's control group (versions 1 and 2, of Linux) and its
/// limit of address space (`ulimit -v`) leave. Nothing where none of them says.
std::optional<std::uint64_t> available_memory();

/// The bytes that the line "MemAvailable:   123 kB" of /proc/meminfo says.
std::optional<std::uint64_t> memory_of_meminfo(std::istream& meminfo);

}  // namespace photonproof::inline renderer_core
