// Memory that a render may still take: a render that cannot fit is refused before the system kills a process for it.
#pragma once

#include <cstdint>
#include <istream>
#include <optional>

namespace photonproof::inline renderer_core {

/// Bytes: the least that the machine (MemAvailable), the process's control group (versions 1 and 2, of Linux) and its
/// limit of address space (`ulimit -v`) leave. Empty where none of them has a value.
std::optional<std::uint64_t> available_memory();

/// The bytes in the line "MemAvailable:   123 kB" of /proc/meminfo.
std::optional<std::uint64_t> memory_of_meminfo(std::istream& meminfo);

}  // namespace photonproof::inline renderer_core
