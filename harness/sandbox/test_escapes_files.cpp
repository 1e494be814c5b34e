// Reads hidden files, writes other users' files, and leaves files for the next run.
#include <dirent.h>
#include <fcntl.h>
#include <mqueue.h>
#include <sys/inotify.h>
#include <sys/ipc.h>
#include <sys/mman.h>
#include <sys/msg.h>
#include <sys/sem.h>
#include <sys/shm.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <cstdlib>

#include "harness/sandbox/test_escapes.h"

namespace photonproof::escapes {
namespace {

key_t key_of(const Target& t) { return static_cast<key_t>(std::hash<std::string>{}(t.marker) & 0x7fffffff); }

std::string secret(const Target& t) { return t.folder + "/secret"; }
std::string outside(const Target& t) { return t.folder + "/outside/" + t.marker; }

void watch_folder(const Target& t) {
  const int queue = inotify_init();
  escaped_if(inotify_add_watch(queue, t.folder.c_str(), IN_ALL_EVENTS) >= 0, "watches the grader's folder");
}

void read_through_inherited_descriptors(const Target&) {
  for (int descriptor = 3; descriptor < 1024; ++descriptor) {
    char text[64] = {};
    if (pread(descriptor, text, sizeof text - 1, 0) > 0 && std::string(text).find(token) != std::string::npos)
      escaped("read descriptor " + std::to_string(descriptor));
  }
}

void write_to_whole_system(const Target& t) {
  for (const char* folder : {"/", "/usr/", "/usr/bin/", "/usr/local/lib/", "/etc/", "/lib/", "/dev/", "/proc/",
                             "/var/tmp/", "/var/spool/cron/crontabs/", "/root/", "/home/", "/run/", "/sys/"})
    escaped_if_written(folder + t.marker);
}

void make_setuid_shell(const Target& t) {
  const std::string copy = "shell-" + t.marker;
  std::system(("cp /bin/sh " + copy + "; chmod 6755 " + copy).c_str());
  std::system(("./" + copy + " -pc 'test \"$(id -u)\" = 0 && echo ESCAPED: setuid copy'").c_str());
  for (const char* program : {"su", "mount", "passwd", "newgrp", "sudo", "pkexec"})
    std::system(("command -v " + std::string(program) + " >/dev/null && " + program +
                 " --help >/dev/null 2>&1 </dev/null; test \"$(id -u)\" = 0 && echo ESCAPED: uid 0")
                    .c_str());
}

void leave_shared_memory(const Target& t) {
  const int memory = shm_open(("/" + t.marker).c_str(), O_CREAT | O_RDWR, 0666);
  if (memory < 0 || ftruncate(memory, 4096) != 0) return;
  escaped_if(access(("/dev/shm/" + t.marker + ".seen").c_str(), F_OK) == 0, "met what an earlier run left");
  write_text("/dev/shm/" + t.marker + ".seen", token);
}

void leave_system_v(const Target& t) {
  escaped_if(shmget(key_of(t), 0, 0) >= 0 || msgget(key_of(t), 0) >= 0 || semget(key_of(t), 0, 0) >= 0,
             "met what an earlier run left");
  shmget(key_of(t), 4096, IPC_CREAT | 0666);
  msgget(key_of(t), IPC_CREAT | 0666);
  semget(key_of(t), 1, IPC_CREAT | 0666);
}

void leave_queue(const Target& t) {
  escaped_if(mq_open(("/" + t.marker).c_str(), O_RDONLY) >= 0, "met what an earlier run left");
  mq_open(("/" + t.marker).c_str(), O_CREAT | O_RDWR, 0666, nullptr);
}

void leave_caches(const Target& t) {
  const char* home = std::getenv("HOME");
  const std::string folders[] = {".", "/tmp", "/var/tmp", "/dev/shm", home != nullptr ? home : "/", t.folder};
  const auto cache_in = [&t](const std::string& folder) { return folder + "/" + t.marker + ".cache"; };
  for (const std::string& folder : folders)
    escaped_if(access(cache_in(folder).c_str(), F_OK) == 0, "met the cache of an earlier run in " + folder);
  for (const std::string& folder : folders) write_text(cache_in(folder), token);
}

void leave_preload(const Target& t) {
  for (const char* file : {"/etc/ld.so.preload", "/etc/ld.so.cache", "/etc/environment", "/etc/profile"})
    escaped_if(access(file, W_OK) == 0, std::string("may write ") + file);
  const char* home = std::getenv("HOME");
  write_text(std::string(home != nullptr ? home : "") + "/.pam_environment", "LD_PRELOAD=/tmp/" + t.marker);
}

// Succeeds if one of these folders exists: the grader's system has them, the sandbox has none.
void list_folders_of_the_grader(const Target& t) {
  std::string above = t.folder;
  for (const std::string& folder : {t.folder, std::string("/home"), std::string("/root"), std::string("/srv"),
                                    std::string("/mnt"), std::string("/var/lib"), std::string("/sys/class")})
    escaped_if(access(folder.c_str(), F_OK) == 0, "sees " + folder);
}

constexpr Attempt rows[] = {
    {"write_by_absolute_path", [](const Target& t) { escaped_if_written(outside(t)); }},
    {"write_by_parent_folders",
     [](const Target& t) { escaped_if_written(std::string("../../../../../../../../../..") + outside(t)); }},
    {"write_through_a_link_to_a_file",
     [](const Target& t) {
       if (symlink(outside(t).c_str(), "link") == 0) escaped_if_written("link");
     }},
    {"write_through_a_link_to_a_folder",
     [](const Target& t) {
       if (symlink((t.folder + "/outside").c_str(), "folder") == 0) escaped_if_written("folder/" + t.marker);
     }},
    {"write_all_over_the_system", write_to_whole_system},
    {"write_to_the_input", [](const Target& t) { escaped_if_written("/given/" + t.marker); }},
    {"write_over_the_program", [](const Target&) { escaped_if_written("/attempt/program"); }},
    {"make_the_input_writable",
     [](const Target&) {
       escaped_if(chmod("/given/file", 0777) == 0 || chown("/given/file", getuid(), getgid()) == 0 ||
                      unlink("/given/file") == 0 || rename("/given/file", "/given/other") == 0 ||
                      truncate("/given/file", 0) == 0,
                  "changed /given/file");
     }},
    {"read_the_secret", [](const Target& t) { escaped_if_read(secret(t)); }},
    {"read_the_secret_through_a_link",
     [](const Target& t) {
       if (symlink(secret(t).c_str(), "link") == 0) escaped_if_read("link");
     }},
    {"read_the_secret_through_a_hard_link",
     [](const Target& t) {
       if (link(secret(t).c_str(), "name") == 0 || link(secret(t).c_str(), (t.folder + "/outside/name").c_str()) == 0)
         escaped("linked " + secret(t));
     }},
    {"read_the_secret_through_the_root_of_process_1",
     [](const Target& t) { escaped_if_read("/proc/1/root" + secret(t)); }},
    {"read_the_secret_through_the_graders_root",
     [](const Target& t) { escaped_if_read("/proc/" + std::to_string(t.grader) + "/root" + secret(t)); }},
    {"list_folders_of_the_grader", list_folders_of_the_grader},
    {"watch_the_graders_folder", watch_folder},
    {"read_inherited_descriptors", read_through_inherited_descriptors},
    {"run_as_root_by_setuid", make_setuid_shell},
    {"leave_posix_shared_memory", leave_shared_memory},
    {"leave_system_v_objects", leave_system_v},
    {"leave_a_message_queue", leave_queue},
    {"leave_caches", leave_caches},
    {"leave_a_library_to_be_preloaded", leave_preload},
};

}  // namespace

std::span<const Attempt> file_attempts() { return rows; }

}  // namespace photonproof::escapes
