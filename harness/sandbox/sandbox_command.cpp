#include "harness/sandbox/sandbox_command.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <string_view>

#include "harness/sandbox/syscall_filter.h"
#include "sandbox_script.h"
#include "scenes/files/atomic_file.h"

namespace photonproof::inline harness_sandbox {
namespace {

namespace fs = std::filesystem;

constexpr const char* system_path = "/usr/local/bin:/usr/bin:/bin";
// Uids without a user: systemd gives these numbers to short-lived services, and Debian reserves them for no account.
constexpr int first_own_uid = 61184, own_uids = 4000;
constexpr int uid_inside = 1000;  // only a name for our own uid
// Memory that a file takes besides its contents; the kernel does not count it elsewhere.
constexpr std::uint64_t bytes_a_file = 4096;
constexpr std::uint64_t least_files = 1024;

void append(std::vector<std::string>& to, std::initializer_list<std::string> words) {
  to.insert(to.end(), words.begin(), words.end());
}

int own_uid() {
  static std::atomic<int> taken{0};
  return first_own_uid + (static_cast<int>(getpid()) * 7 + taken++) % own_uids;
}

// bwrap makes the parent folders of a mount accessible to its own user alone.
void make_parents(std::vector<std::string>& bwrap, const fs::path& inside) {
  for (const fs::path& parent : {inside.parent_path().parent_path(), inside.parent_path()})
    if (parent.has_relative_path()) append(bwrap, {"--perms", "0755", "--dir", parent.string()});
}

// bwrap's options for the part of the system that programs and compilers need.
void show_system(std::vector<std::string>& bwrap) {
  append(bwrap, {"--ro-bind", "/usr", "/usr"});
  for (const char* folder : {"/bin", "/sbin", "/lib", "/lib32", "/lib64", "/libx32"}) {
    std::error_code missing;
    if (fs::is_symlink(folder, missing))
      append(bwrap, {"--symlink", fs::read_symlink(folder).string(), folder});
    else if (fs::is_directory(folder, missing))
      append(bwrap, {"--ro-bind", folder, folder});
  }
  make_parents(bwrap, "/etc/passwd");
  for (const char* path : {"/etc/ld.so.cache", "/etc/ld.so.conf", "/etc/ld.so.conf.d", "/etc/alternatives"})
    append(bwrap, {"--ro-bind-try", path, path});
  // Folders outside of /usr that interpreters use by Debian's policy.
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator("/etc", ignored)) {
    const std::string name = entry.path().filename().string();
    for (const char* start : {"java-", "python3", "perl", "mono", "fpc"})
      if (name.starts_with(start)) append(bwrap, {"--ro-bind", entry.path().string(), entry.path().string()});
  }
}

std::vector<std::string> bwrap_command(const SandboxJob& job, int uid) {
  const SandboxOptions& options = job.options;
  const auto ours = [&job](const char* name) { return (job.folder / name).string(); };
  std::vector<std::string> bwrap{"bwrap",
                                 "--unshare-pid",
                                 "--unshare-net",
                                 "--unshare-ipc",
                                 "--unshare-uts",
                                 "--unshare-cgroup-try",
                                 "--die-with-parent",
                                 "--new-session",
                                 "--hostname",
                                 "sandbox",
                                 "--cap-drop",
                                 "ALL"};
  if (job.containment == Containment::by_root)
    append(bwrap, {"--cap-add", "CAP_SETUID", "--cap-add", "CAP_SETGID"});  // dropped after setpriv has used them
  else
    append(bwrap, {"--unshare-user", "--uid", std::to_string(uid), "--gid", std::to_string(uid)});
  show_system(bwrap);
  append(bwrap, {"--ro-bind", ours("passwd"), "/etc/passwd", "--ro-bind", ours("group"), "/etc/group"});
  append(bwrap, {"--proc", "/proc", "--dev", "/dev"});
  for (const SandboxMount& mount : options.mounts) {
    make_parents(bwrap, mount.inside);
    append(bwrap, {"--ro-bind", mount.outside.string(), mount.inside.string()});
  }
  const std::string work = options.working_folder.string();
  make_parents(bwrap, options.working_folder);
  append(bwrap, {"--bind", ours("disk/shm"), "/dev/shm", "--bind", ours("disk/tmp"), "/tmp"});
  append(bwrap, {"--bind", ours("disk/work"), work, "--chdir", work});
  // bwrap's own two file systems have no size limit, so they become read-only.
  append(bwrap, {"--remount-ro", "/dev", "--remount-ro", "/"});
  append(bwrap, {"--clearenv", "--setenv", "PATH", system_path, "--setenv", "HOME", "/tmp", "--setenv", "TMPDIR",
                 "/tmp", "--setenv", "LANG", "C.UTF-8"});
  for (const auto& [name, value] : options.environment) append(bwrap, {"--setenv", name, value});
  if (!syscall_filter(true).empty()) append(bwrap, {"--seccomp", "9"});
  bwrap.emplace_back("--");
  return bwrap;
}

std::string rounded_up(double seconds) { return std::to_string(static_cast<long>(std::ceil(seconds))); }

// Limits that a process has for itself and its children inherit; none can be raised again.
void limit_resources(std::vector<std::string>& command, const SandboxJob& job) {
  const SandboxLimits& limits = job.options.limits;
  // A core limit of 1 also keeps the system's handler of dumps from being started, which 0 does not (core(5)).
  append(command, {"prlimit", "--core=1", "--fsize=" + std::to_string(limits.file_bytes), "--nofile=1024",
                   "--memlock=65536", "--rtprio=0", "--nice=0"});
  if (limits.cpu_seconds > 0)  // the soft limit's signal identifies it
    command.push_back("--cpu=" + rounded_up(limits.cpu_seconds) + ":" + rounded_up(limits.cpu_seconds + 1));
  // The limit counts all processes of the uid, including those of other sandboxes with the same uid; a group counts
  // better. Outside of a sandbox it would count all of our user's processes.
  if (job.containment != Containment::none && !job.groups.counts_processes())
    command.push_back("--nproc=" + std::to_string(limits.processes));
  command.emplace_back("--");
}

}  // namespace

void prepare_folder(const SandboxJob& job) {
  fs::create_directories(job.folder / "disk");
  const std::string filter = syscall_filter(job.groups.counts_memory());
  write_file_atomically(job.folder / "filter", filter);
  const auto numbers = [](int uid) { return std::to_string(uid) + ":" + std::to_string(uid); };
  std::string passwd = "root:x:0:0:root:/root:/bin/sh\n", group = "root:x:0:\n";
  if (job.containment == Containment::in_user_space) {
    passwd += "student:x:" + numbers(uid_inside) + ":student:/tmp:/bin/sh\n";
    group += "student:x:" + std::to_string(uid_inside) + ":\n";
  }
  write_file_atomically(job.folder / "passwd", passwd);
  write_file_atomically(job.folder / "group", group);
  for (const char* readable : {"passwd", "group"})
    fs::permissions(job.folder / readable, fs::perms::others_read | fs::perms::group_read, fs::perm_options::add);
}

std::vector<std::string> sandbox_command(const std::vector<std::string>& argv, const SandboxJob& job) {
  const SandboxOptions& options = job.options;
  const bool contained = job.containment != Containment::none;
  const bool by_root = job.containment == Containment::by_root;
  const std::string uid = std::to_string(own_uid());
  const std::uint64_t files = std::max(least_files, options.limits.disk_bytes / bytes_a_file);
  const std::string disk = "size=" + std::to_string(options.limits.disk_bytes) + ",nr_inodes=" + std::to_string(files) +
                           ",nosuid,nodev,mode=755";
  std::string groups;
  for (const fs::path& group : job.groups.folders()) groups += group.string() + " ";
  std::vector<std::string> command{"env",
                                   "-i",
                                   std::string("PATH=") + system_path + ":/usr/sbin:/sbin",
                                   "LC_ALL=C.UTF-8",
                                   "SANDBOX=" + job.folder.string(),
                                   "DISK=" + (contained ? disk : ""),
                                   "STARTS_WITH=" + options.starts_with.string(),
                                   "OWNER=" + (by_root ? uid : ""),
                                   "GROUPS_OF_LIMITS=" + groups,
                                   "COLLECT=" + options.collect,
                                   "COLLECT_TO=" + options.collect_to.string(),
                                   "FILE_BYTES=" + std::to_string(options.limits.file_bytes)};
  if (by_root) append(command, {"unshare", "--mount", "--propagation", "private"});
  if (job.containment == Containment::in_user_space)
    append(command, {"unshare", "--user", "--map-root-user", "--mount"});
  append(command, {"/bin/sh", "-c", sandbox_script, "sandbox"});
  if (contained) {
    const std::vector<std::string> bwrap = bwrap_command(job, uid_inside);
    command.insert(command.end(), bwrap.begin(), bwrap.end());
  } else {
    append(command, {"env", "-i", std::string("PATH=") + system_path, "LANG=C.UTF-8",
                     "HOME=" + (job.folder / "disk/tmp").string(), "TMPDIR=" + (job.folder / "disk/tmp").string()});
    for (const auto& [name, value] : options.environment) command.push_back(name + "=" + value);
  }
  if (by_root)
    append(command, {"setpriv", "--reuid=" + uid, "--regid=" + uid, "--clear-groups", "--inh-caps=-all", "--"});
  limit_resources(command, job);
  command.insert(command.end(), argv.begin(), argv.end());
  return command;
}

}  // namespace photonproof::inline harness_sandbox
