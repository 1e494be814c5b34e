#include "harness/sandbox/syscall_filter.h"

#include <asm/ioctls.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/sched.h>
#include <linux/seccomp.h>
#include <sys/socket.h>
#include <sys/syscall.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace photonproof::inline harness_sandbox {
namespace {

#if defined(__x86_64__)
constexpr std::uint32_t native_architecture = AUDIT_ARCH_X86_64;
#elif defined(__aarch64__)
constexpr std::uint32_t native_architecture = AUDIT_ARCH_AARCH64;
#else
constexpr std::uint32_t native_architecture = 0;
#endif
constexpr std::uint32_t first_x32_call = 0x40000000;

constexpr std::uint32_t new_namespaces =
    CLONE_NEWNS | CLONE_NEWCGROUP | CLONE_NEWUTS | CLONE_NEWIPC | CLONE_NEWUSER | CLONE_NEWPID | CLONE_NEWNET;

constexpr std::array refused_calls {
  // mounts and namespaces
  SYS_mount, SYS_umount2, SYS_pivot_root, SYS_chroot, SYS_setns, SYS_fsopen, SYS_fsmount, SYS_fsconfig, SYS_fspick,
      SYS_move_mount, SYS_open_tree,
#ifdef SYS_mount_setattr
      SYS_mount_setattr,
#endif
      // files by other ways than their paths
      SYS_open_by_handle_at, SYS_name_to_handle_at, SYS_fanotify_init, SYS_quotactl, SYS_acct,
      // keys, counters, programs in the kernel, queues to it
      SYS_add_key, SYS_request_key, SYS_keyctl, SYS_perf_event_open, SYS_bpf, SYS_userfaultfd, SYS_io_uring_setup,
      SYS_io_uring_enter, SYS_io_uring_register,
      // the machine
      SYS_settimeofday, SYS_clock_settime, SYS_adjtimex, SYS_clock_adjtime, SYS_sethostname, SYS_setdomainname,
      SYS_syslog, SYS_reboot, SYS_kexec_load, SYS_kexec_file_load, SYS_init_module, SYS_finit_module, SYS_delete_module,
      SYS_swapon, SYS_swapoff, SYS_vhangup,
#if defined(__x86_64__)
      SYS_iopl, SYS_ioperm, SYS_modify_ldt,
#endif
};

class Filter {
 public:
  void load(std::size_t offset) { add(BPF_LD | BPF_W | BPF_ABS, static_cast<std::uint32_t>(offset)); }
  void end(std::uint32_t verdict) { add(BPF_RET | BPF_K, verdict); }
  void end_if_equal(std::uint32_t value, std::uint32_t verdict) { end_if(BPF_JEQ, value, verdict); }
  void end_if_at_least(std::uint32_t value, std::uint32_t verdict) { end_if(BPF_JGE, value, verdict); }
  void end_if_any(std::uint32_t bits, std::uint32_t verdict) { end_if(BPF_JSET, bits, verdict); }
  void if_equal_skip(std::uint32_t value, std::uint8_t count) { add(BPF_JMP | BPF_JEQ | BPF_K, value, count, 0); }
  // Applies the next `count` instructions to this call alone.
  void unless_equal_skip(std::uint32_t value, std::uint8_t count) { add(BPF_JMP | BPF_JEQ | BPF_K, value, 0, count); }
  std::string bytes() const {
    return {reinterpret_cast<const char*>(program_.data()), program_.size() * sizeof(sock_filter)};
  }

 private:
  void add(int code, std::uint32_t value, std::uint8_t if_true = 0, std::uint8_t if_false = 0) {
    program_.push_back({static_cast<std::uint16_t>(code), if_true, if_false, value});
  }
  void end_if(int comparison, std::uint32_t value, std::uint32_t verdict) {
    add(BPF_JMP | comparison | BPF_K, value, 0, 1);
    end(verdict);
  }
  std::vector<sock_filter> program_;
};

constexpr std::uint32_t error(int code) { return SECCOMP_RET_ERRNO | static_cast<std::uint32_t>(code); }

// The lower half of an argument; the kernel reads no more of the arguments tested here.
constexpr std::size_t argument(std::size_t index) {
  return offsetof(seccomp_data, args) + index * sizeof(std::uint64_t);
}

// `count` comparisons of the loaded argument follow the load; then the call is allowed.
void refuse_by_argument(Filter& filter, long call, std::size_t index, const std::vector<std::uint32_t>& values,
                        bool bits, std::uint32_t verdict) {
  filter.unless_equal_skip(static_cast<std::uint32_t>(call), static_cast<std::uint8_t>(2 * values.size() + 2));
  filter.load(argument(index));
  for (const std::uint32_t value : values)
    bits ? filter.end_if_any(value, verdict) : filter.end_if_equal(value, verdict);
  filter.end(SECCOMP_RET_ALLOW);
}

}  // namespace

std::string syscall_filter(bool memory_is_counted) {
  if (native_architecture == 0) return {};
  Filter filter;
  filter.load(offsetof(seccomp_data, arch));
  filter.if_equal_skip(native_architecture, 1);
  filter.end(error(ENOSYS));
  filter.load(offsetof(seccomp_data, nr));
#if defined(__x86_64__)
  filter.end_if_at_least(first_x32_call, error(ENOSYS));
#endif
  for (const long call : refused_calls) filter.end_if_equal(static_cast<std::uint32_t>(call), error(EPERM));
  if (!memory_is_counted)
    for (const long call : {SYS_memfd_create, SYS_shmget})
      filter.end_if_equal(static_cast<std::uint32_t>(call), error(EPERM));
  // The flags of clone3 are in memory, where no filter sees them. Without clone3 the C library calls clone.
  filter.end_if_equal(SYS_clone3, error(ENOSYS));
  refuse_by_argument(filter, SYS_clone, 0, {new_namespaces}, true, error(EPERM));
  refuse_by_argument(filter, SYS_unshare, 0, {new_namespaces}, true, error(EPERM));
  refuse_by_argument(filter, SYS_ioctl, 1, {TIOCSTI, TIOCLINUX}, false, error(EPERM));
  filter.unless_equal_skip(SYS_socket, 10);
  filter.load(argument(0));
  for (const int family : {AF_UNIX, AF_INET, AF_INET6, AF_NETLINK})
    filter.end_if_equal(static_cast<std::uint32_t>(family), SECCOMP_RET_ALLOW);
  filter.end(error(EAFNOSUPPORT));
  filter.end(SECCOMP_RET_ALLOW);
  return filter.bytes();
}

}  // namespace photonproof::inline harness_sandbox
