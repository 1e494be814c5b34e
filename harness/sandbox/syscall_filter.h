// Which system calls a contained command is refused (seccomp(2), classic BPF). Namespaces hide what the command must
// not see; the filter refuses what they do not cover (keys, counters, clocks, AF_VSOCK, the terminal's input) and the
// calls by which programs without rights have most often got them: namespaces and mounts of their own, io_uring, bpf.
#pragma once

#include <string>

namespace photonproof::inline harness_sandbox {

/// The bytes that bwrap's --seccomp reads. Other architectures' calls (32 bits, x32) fail with ENOSYS, those refused
/// with EPERM, sockets but unix, IPv4, IPv6 and netlink with EAFNOSUPPORT. Empty for processors it does not know.
/// Where nobody counts memory that no process maps (`memory_is_counted` false), memfd_create and shmget are refused,
/// too.
std::string syscall_filter(bool memory_is_counted);

}  // namespace photonproof::inline harness_sandbox
