// Rights that a program should not have, or should not be able to get.
#include <fcntl.h>
#include <linux/bpf.h>
#include <linux/keyctl.h>
#include <linux/perf_event.h>
#include <sched.h>
#include <sys/ioctl.h>
#include <sys/mount.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/sysmacros.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdint>
#include <ctime>

#include "harness/sandbox/test_escapes.h"

namespace photonproof::escapes {
namespace {

void mount_something(const Target& t) {
  mkdir("here", 0777);
  escaped_if(mount("none", "here", "tmpfs", 0, "") == 0, "mounted a file system");
  escaped_if(mount("/", "here", nullptr, MS_BIND | MS_REC, nullptr) == 0, "bound the root");
  escaped_if(mount(nullptr, "/given", nullptr, MS_REMOUNT | MS_BIND, nullptr) == 0, "made the input writable");
  escaped_if(umount2("/proc", MNT_DETACH) == 0 || umount2("/given", MNT_DETACH) == 0, "unmounted");
  escaped_if(syscall(SYS_fsopen, "tmpfs", 0) >= 0 || syscall(SYS_open_tree, AT_FDCWD, "/", 1) >= 0,
             "mounts by the new calls");
  escaped_if_read(t.folder + "/secret");
}

void make_namespaces(const Target&) {
  for (const int flag : {CLONE_NEWUSER, CLONE_NEWNS, CLONE_NEWPID, CLONE_NEWNET, CLONE_NEWIPC, CLONE_NEWUTS})
    escaped_if(unshare(flag) == 0, "has a namespace of its own, " + std::to_string(flag));
}

void clone_namespace(const Target&) {
  const long child = syscall(SYS_clone, CLONE_NEWUSER | SIGCHLD, 0, 0, 0, 0);
  if (child == 0) _exit(0);
  escaped_if(child > 0, "cloned into a user namespace");
  std::uint64_t arguments[11] = {CLONE_NEWUSER, 0, 0, 0, SIGCHLD};
  const long other = syscall(SYS_clone3, arguments, 64);
  if (other == 0) _exit(0);
  escaped_if(other > 0, "cloned into a user namespace by clone3");
}

void enter_namespaces(const Target&) {
  for (const char* kind : {"mnt", "net", "user", "pid", "ipc"})
    for (const char* process : {"1", "2", "self"}) {
      const int descriptor = open(("/proc/" + std::string(process) + "/ns/" + kind).c_str(), O_RDONLY);
      escaped_if(descriptor >= 0 && setns(descriptor, 0) == 0,
                 "entered a namespace of process " + std::string(process));
    }
}

void make_device(const Target&) {
  escaped_if(mknod("disk", S_IFBLK | 0666, makedev(254, 0)) == 0 && open("disk", O_RDONLY) >= 0, "reads the disk");
  escaped_if(mknod("memory", S_IFCHR | 0666, makedev(1, 1)) == 0 && open("memory", O_RDONLY) >= 0, "reads /dev/mem");
}

void open_devices(const Target&) {
  for (const char* device : {"/dev/mem", "/dev/kmem", "/dev/port", "/dev/vda", "/dev/sda", "/dev/nvme0n1", "/dev/kvm",
                             "/dev/fuse", "/dev/net/tun", "/dev/kmsg", "/proc/kcore", "/proc/kmsg", "/dev/dri/card0"})
    escaped_if(open(device, O_RDONLY | O_NONBLOCK) >= 0, std::string("opened ") + device);
}

void tell_kernel(const Target&) {
  for (const char* file : {"/proc/sysrq-trigger", "/proc/sys/kernel/core_pattern", "/proc/sys/kernel/hostname",
                           "/proc/sys/vm/drop_caches", "/proc/self/oom_score_adj_", "/proc/sys/fs/file-max",
                           "/sys/power/state", "/sys/fs/cgroup/cgroup.procs", "/proc/irq/default_smp_affinity"})
    escaped_if(open(file, O_WRONLY) >= 0, std::string("may write ") + file);
}

void change_clock(const Target&) {
  timespec now{};
  clock_gettime(CLOCK_REALTIME, &now);
  const timeval same{now.tv_sec, now.tv_nsec / 1000};
  escaped_if(clock_settime(CLOCK_REALTIME, &now) == 0 || settimeofday(&same, nullptr) == 0, "set the clock");
}

void type_into_terminal(const Target&) {
  char letter = 'x';
  const int terminal = open("/dev/tty", O_RDWR);
  for (const int descriptor : {0, 1, 2, terminal})
    escaped_if(descriptor >= 0 && ioctl(descriptor, TIOCSTI, &letter) == 0, "typed into the terminal");
  escaped_if(terminal >= 0, "has the grader's terminal");
  // A terminal of its own could also receive typed input where no filter refuses the call.
  const int own = posix_openpt(O_RDWR | O_NOCTTY);
  if (own < 0 || grantpt(own) != 0 || unlockpt(own) != 0) return;
  setsid();
  const int end = open(ptsname(own), O_RDWR);
  escaped_if(end >= 0 && ioctl(end, TIOCSTI, &letter) == 0, "TIOCSTI is not refused");
}

void keep_keys(const Target& t) {
  escaped_if(syscall(SYS_add_key, "user", t.marker.c_str(), "x", 1, KEY_SPEC_USER_KEYRING) >= 0, "left a key");
  escaped_if(syscall(SYS_keyctl, KEYCTL_GET_KEYRING_ID, KEY_SPEC_USER_KEYRING, 1) >= 0, "has the user's keys");
}

void load_program(const Target&) {
  bpf_attr map{};
  map.map_type = BPF_MAP_TYPE_ARRAY;
  map.key_size = map.value_size = 4;
  map.max_entries = 1;
  escaped_if(syscall(SYS_bpf, BPF_MAP_CREATE, &map, sizeof map) >= 0, "has a bpf map");
  perf_event_attr counter{};
  counter.size = sizeof counter;
  counter.type = PERF_TYPE_SOFTWARE;
  counter.config = PERF_COUNT_SW_CPU_CLOCK;
  escaped_if(syscall(SYS_perf_event_open, &counter, 0, -1, -1, 0) >= 0, "has a performance counter");
  char parameters[120] = {};
  escaped_if(syscall(SYS_io_uring_setup, 1, parameters) >= 0, "has an io_uring");
  escaped_if(syscall(SYS_userfaultfd, 1) >= 0, "handles page faults");
}

void raise_limits(const Target&) {
  for (int resource = 0; resource < RLIM_NLIMITS; ++resource) {
    rlimit limit{};
    if (getrlimit(static_cast<__rlimit_resource>(resource), &limit) != 0 || limit.rlim_max == RLIM_INFINITY) continue;
    ++limit.rlim_max;
    escaped_if(setrlimit(static_cast<__rlimit_resource>(resource), &limit) == 0,
               "raised the limit " + std::to_string(resource));
  }
}

void become_root(const Target&) {
  escaped_if(setuid(0) == 0 || setgid(0) == 0 || setresuid(0, 0, 0) == 0, "became root");
  escaped_if(getuid() == 0 || geteuid() == 0, "is root");
  const std::string status = text_of("/proc/self/status");
  escaped_if(status.find("CapEff:\t0000000000000000") == std::string::npos, "has capabilities");
  escaped_if(status.find("NoNewPrivs:\t1") == std::string::npos, "may get new ones");
}

void take_precedence(const Target&) {
  sched_param first{1};
  escaped_if(sched_setscheduler(0, SCHED_FIFO, &first) == 0 || sched_setscheduler(0, SCHED_RR, &first) == 0,
             "runs before all others");
  const int own = getpriority(PRIO_PROCESS, 0);  // a caller may have given it a high one
  escaped_if(setpriority(PRIO_PROCESS, 0, own - 1) == 0 && getpriority(PRIO_PROCESS, 0) < own, "has a higher priority");
}

void survive_out_of_memory(const Target&) {
  write_text("/proc/self/oom_score_adj", "-1000");
  escaped_if(text_of("/proc/self/oom_score_adj") == "-1000\n", "is never killed for memory");
}

void dump_core(const Target& t) {
  prctl(PR_SET_DUMPABLE, 1);
  if (fork() == 0) raise(SIGSEGV);
  int status = 0;
  wait(&status);
  escaped_if(WCOREDUMP(status), "left a core dump, " + t.marker);
}

void call_as_32_bits(const Target&) {
#if defined(__x86_64__)
  long result = -1;
  // getpid of the 32-bit table, as a way around a filter for 64-bit numbers alone
  asm volatile("int $0x80" : "=a"(result) : "a"(20L) : "memory", "r8", "r9", "r10", "r11");
  escaped_if(result > 0, "calls by the 32-bit table");
  escaped_if(syscall(0x40000000 + SYS_getpid) > 0, "calls by the x32 table");
#endif
}

constexpr Attempt rows[] = {
    {"mount_something", mount_something},
    {"change_the_root",
     [](const Target& t) {
       escaped_if(chroot(".") == 0, "changed its root");
       escaped_if_read("../../../.." + t.folder + "/secret");
     }},
    {"make_namespaces", make_namespaces},
    {"clone_into_a_namespace", clone_namespace},
    {"enter_namespaces", enter_namespaces},
    {"make_a_device", make_device},
    {"open_devices", open_devices},
    {"write_to_the_kernels_files", tell_kernel},
    {"set_the_clock", change_clock},
    {"type_into_the_terminal", type_into_terminal},
    {"keep_keys", keep_keys},
    {"load_into_the_kernel", load_program},
    {"raise_limits", raise_limits},
    {"become_root", become_root},
    {"take_precedence", take_precedence},
    {"survive_out_of_memory", survive_out_of_memory},
    {"dump_core", dump_core},
    {"call_the_kernel_by_other_tables", call_as_32_bits},
    {"rename_the_machine", [](const Target&) { escaped_if(sethostname("pwned", 5) == 0, "renamed the machine"); }},
    {"open_by_handle",
     [](const Target&) {
       struct {
         file_handle head;
         unsigned char bytes[128];
       } handle{};
       handle.head.handle_bytes = sizeof handle.bytes;
       int mount_id = 0;
       escaped_if(name_to_handle_at(AT_FDCWD, "/usr", &handle.head, &mount_id, 0) == 0, "has a handle of /usr");
     }},
};

}  // namespace

std::span<const Attempt> kernel_attempts() { return rows; }

}  // namespace photonproof::escapes
