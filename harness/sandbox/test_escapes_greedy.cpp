// Programs that take more than their share. The limits of the test are 128 MiB of memory, 16 MiB of disk, 8 MiB a file,
// 1 MiB of log and 32 processes. Each attempt succeeds when it has well more than that.
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/shm.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <system_error>
#include <thread>
#include <vector>

#include "harness/sandbox/test_escapes.h"

namespace photonproof::escapes {
namespace {

constexpr std::size_t mebibyte = std::size_t{1} << 20;
constexpr std::size_t too_much_memory = 600;  // MiB; the kernel counts 128 + 16, samples may be late

void take_memory(const Target&) {
  for (std::size_t taken = 0; taken < too_much_memory; ++taken) {
    void* const block = std::malloc(mebibyte);
    if (block == nullptr) return;
    std::memset(block, 1, mebibyte);
  }
  escaped("has 600 MiB of memory");
}

void take_memory_in_many_processes(const Target&) {
  int pipe_ends[2];
  if (pipe(pipe_ends) != 0) return;
  for (int child = 0; child < 20; ++child)
    if (fork() == 0) {
      void* const block = std::malloc(30 * mebibyte);
      if (block != nullptr) std::memset(block, 1, 30 * mebibyte);
      if (write(pipe_ends[1], "x", 1) == 1) pause();
    }
  close(pipe_ends[1]);
  int full = 0;
  for (char letter = 0; read(pipe_ends[0], &letter, 1) == 1;)
    if (++full == 20) return escaped("has 600 MiB of memory in 20 processes");
}

void take_memory_without_mapping_it(const Target&) {
  const std::vector<char> block(mebibyte, 'x');
  std::size_t taken = 0;
  for (int file = 0; file < 200; ++file) {
    const int descriptor = memfd_create("block", 0);
    while (descriptor >= 0 && taken < too_much_memory && write(descriptor, block.data(), block.size()) > 0) ++taken;
  }
  escaped_if(taken >= too_much_memory, "has 600 MiB in files without names");
}

void take_disk(const Target&) {
  const std::vector<char> block(mebibyte, 'x');
  std::size_t taken = 0;
  for (int file = 0; file < 40; ++file)
    for (const char* folder : {".", "/tmp", "/dev/shm", "/var/tmp", "/run", "/dev", "/"}) {
      const int descriptor = open((std::string(folder) + "/" + std::to_string(file)).c_str(), O_CREAT | O_WRONLY, 0666);
      if (descriptor < 0) continue;
      for (int part = 0; part < 4 && write(descriptor, block.data(), block.size()) == static_cast<ssize_t>(mebibyte);
           ++part)
        ++taken;
      close(descriptor);
    }
  escaped_if(taken > 16, "has " + std::to_string(taken) + " MiB of disk");
}

void take_deleted_disk(const Target&) {
  const std::vector<char> block(mebibyte, 'x');
  std::size_t taken = 0;
  for (int file = 0; file < 100; ++file) {
    const int descriptor = open("deleted", O_CREAT | O_WRONLY, 0666);
    unlink("deleted");
    for (int part = 0; part < 4 && write(descriptor, block.data(), block.size()) == static_cast<ssize_t>(mebibyte);
         ++part)
      ++taken;
  }
  escaped_if(taken > 16, "has " + std::to_string(taken) + " MiB in deleted files");
}

void make_many_files(const Target&) {
  int made = 0;
  for (int file = 0; file < 20000; ++file) made += mkdir(("d" + std::to_string(file)).c_str(), 0777) == 0;
  escaped_if(made >= 10000, "has " + std::to_string(made) + " folders");
}

void make_sparse_file(const Target&) {
  signal(SIGXFSZ, SIG_IGN);
  const int descriptor = open("sparse", O_CREAT | O_RDWR, 0666);
  escaped_if(ftruncate(descriptor, off_t{1} << 42) == 0 || pwrite(descriptor, "x", 1, off_t{1} << 40) == 1 ||
                 fallocate(descriptor, 0, 0, off_t{1} << 30) == 0,
             "has a file of terabytes");
}

void write_log(int descriptor) {
  const std::vector<char> block(mebibyte, 'x');
  for (int part = 0; part < 200; ++part)
    if (write(descriptor, block.data(), block.size()) <= 0) return;
  escaped("wrote 200 MiB of log");
}

void start_processes(const Target&) {
  int made = 0;
  for (int child = 0; child < 400; ++child) {
    const pid_t pid = fork();
    if (pid == 0) pause();
    made += pid > 0;
  }
  escaped_if(made > 64, "has " + std::to_string(made) + " processes");
}

void start_threads(const Target&) {
  std::vector<std::thread> threads;
  try {
    while (threads.size() < 400) threads.emplace_back([] { pause(); });
  } catch (const std::system_error&) {
  }
  escaped_if(threads.size() > 64, "has " + std::to_string(threads.size()) + " threads");
  _exit(0);
}

// All copies fork until the run's time is over; there must not be many of them.
void fork_bomb(const Target&) {
  for (;;) {
    if (fork() == 0) setsid();
  }
}

void never_end(const Target&) {
  for (int signal_number = 1; signal_number < 32; ++signal_number) signal(signal_number, SIG_IGN);
  for (;;) pause();
}

constexpr Attempt rows[] = {
    {"take_memory", take_memory},
    {"take_memory_in_many_processes", take_memory_in_many_processes},
    {"take_memory_without_mapping_it", take_memory_without_mapping_it},
    {"take_disk", take_disk},
    {"take_disk_of_deleted_files", take_deleted_disk},
    {"make_many_files", make_many_files},
    {"make_a_sparse_file", make_sparse_file},
    {"write_gigabytes_of_output", [](const Target&) { write_log(1); }},
    {"write_gigabytes_of_errors", [](const Target&) { write_log(2); }},
    {"start_many_processes", start_processes},
    {"start_many_threads", start_threads},
    {"fork_bomb", fork_bomb},
    {"never_end", never_end},
};

}  // namespace

std::span<const Attempt> greedy_attempts() { return rows; }

}  // namespace photonproof::escapes
