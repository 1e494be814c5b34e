// System calls that a contained command is refused (seccomp(2), classic BPF). Namespaces hide what the command must not
// see. The filter refuses what they do not cover: keys, counters, clocks, AF_VSOCK, the terminal's input. It also
// refuses the usual ways to gain rights: own namespaces and mounts, io_uring, bpf.
#pragma once

#include <string>

namespace photonproof::inline harness_sandbox {

/// The bytes that bwrap's --seccomp reads. Other architectures' calls (32 bits, x32) fail with ENOSYS, refused calls
/// with EPERM. Sockets fail with EAFNOSUPPORT, except unix, IPv4, IPv6 and netlink. Empty for unknown processors. If
/// memory that no process maps is not counted (`memory_is_counted` false), memfd_create and shmget are refused too.
std::string syscall_filter(bool memory_is_counted);

}  // namespace photonproof::inline harness_sandbox
