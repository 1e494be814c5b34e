// The escape suite: programs that try to get out of the sandbox, one test each (test_escapes.h). They know more of the
// grader than any real attacker. Harmless attempts must succeed without a sandbox, which shows that the tests detect
// them.
#include <arpa/inet.h>
#include <fcntl.h>
#include <mqueue.h>
#include <netinet/in.h>
#include <sys/ipc.h>
#include <sys/mman.h>
#include <sys/msg.h>
#include <sys/sem.h>
#include <sys/shm.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstddef>
#include <cstring>

#include "harness/sandbox/sandbox.h"
#include "harness/sandbox/test_escapes.h"
#include "scenes/files/test_folder.h"

namespace photonproof::inline harness_sandbox {
namespace {

namespace fs = std::filesystem;

// Outcome of the attempt without a sandbox.
enum class Without { untried, succeeds, succeeds_for_root };
using enum Without;
struct Row {
  const char* name;
  Without without = untried;
  bool ends = true;  // by itself, after its last try
};
void PrintTo(const Row& row, std::ostream* out) { *out << row.name; }

const Row attempts[] = {
    {"write_by_absolute_path", succeeds},
    {"write_by_parent_folders", succeeds},
    {"write_through_a_link_to_a_file", succeeds},
    {"write_through_a_link_to_a_folder", succeeds},
    {"write_all_over_the_system"},
    {"write_to_the_input"},
    {"write_over_the_program"},
    {"make_the_input_writable"},
    {"read_the_secret", succeeds},
    {"read_the_secret_through_a_link", succeeds},
    {"read_the_secret_through_a_hard_link", succeeds},
    {"read_the_secret_through_the_root_of_process_1"},
    {"read_the_secret_through_the_graders_root", succeeds_for_root},
    {"list_folders_of_the_grader", succeeds},
    {"watch_the_graders_folder", succeeds},
    {"read_inherited_descriptors"},
    {"run_as_root_by_setuid"},
    {"leave_posix_shared_memory", succeeds},
    {"leave_system_v_objects", succeeds},
    {"leave_a_message_queue", succeeds},
    {"leave_caches", succeeds},
    {"leave_a_library_to_be_preloaded"},
    {"see_the_grader", succeeds},
    {"read_the_graders_environment", succeeds},
    {"read_any_environment", succeeds},
    {"read_the_graders_descriptors", succeeds},
    {"enter_the_graders_folder", succeeds},
    {"read_the_graders_memory", succeeds_for_root},
    {"trace_the_grader", succeeds_for_root},
    {"signal_the_grader", succeeds},
    {"lower_the_graders_priority", succeeds},
    {"bind_the_grader_to_one_processor", succeeds},
    {"lower_the_graders_limits", succeeds},
    {"kill_the_grader", succeeds},
    {"kill_everybody", untried, false},
    {"kill_what_contains_us", untried, false},
    {"leave_a_daemon"},
    {"leave_a_process_that_always_forks"},
    {"talk_by_tcp", succeeds},
    {"talk_by_ipv6"},
    {"talk_to_an_abstract_socket", succeeds},
    {"talk_to_a_socket_file", succeeds},
    {"ask_a_name_server"},
    {"list_network_interfaces"},
    {"open_sockets_of_other_families"},
    {"open_a_raw_socket", succeeds_for_root},
    {"mount_something"},
    {"change_the_root", succeeds_for_root},
    {"make_namespaces", succeeds_for_root},
    {"clone_into_a_namespace", succeeds_for_root},
    {"enter_namespaces"},
    {"make_a_device"},
    {"open_devices"},
    {"write_to_the_kernels_files"},
    {"set_the_clock"},
    {"type_into_the_terminal"},
    {"keep_keys"},
    {"load_into_the_kernel", succeeds_for_root},
    {"raise_limits"},
    {"become_root", succeeds_for_root},
    {"take_precedence"},
    {"survive_out_of_memory"},
    {"dump_core"},
    {"call_the_kernel_by_other_tables"},
    {"rename_the_machine"},
    {"open_by_handle", succeeds},
    {"take_memory", untried, false},
    {"take_memory_in_many_processes", untried, false},
    {"take_memory_without_mapping_it", untried, false},
    {"take_disk", untried, false},
    {"take_disk_of_deleted_files", untried, false},
    {"make_many_files"},
    {"make_a_sparse_file"},
    {"write_gigabytes_of_output", untried, false},
    {"write_gigabytes_of_errors", untried, false},
    {"start_many_processes", untried, false},
    {"start_many_threads", untried, false},
    {"fork_bomb", untried, false},
    {"never_end", untried, false},
};

template <class Address>
int listening(int family, const Address& address, std::size_t length = sizeof(Address)) {
  const int listener = socket(family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  const auto* any = reinterpret_cast<const sockaddr*>(&address);
  const bool listens = bind(listener, any, static_cast<socklen_t>(length)) == 0 && listen(listener, 5) == 0;
  return listens ? listener : -1;
}

bool is_running(const std::string& marker) {
  for (const fs::directory_entry& entry : fs::directory_iterator("/proc")) {
    const std::string command = escapes::text_of((entry.path() / "cmdline").string());
    if (!command.starts_with("sh") || command.find(marker) == std::string::npos) continue;
    return true;
  }
  return false;
}

// A grader that may be killed, a folder with a secret, and listeners on every kind of socket.
class Escapes : public testing::TestWithParam<Row> {
 protected:
  void SetUp() override {
    if (const auto why = why_no_sandbox()) GTEST_SKIP() << *why;
    marker_ = "photonproof-escape-" + std::to_string(getpid()) + "-" + GetParam().name;
    target_.folder = (fs::temp_directory_path() / (marker_ + "-grader")).string();
    target_.abstract = target_.marker = marker_;
    for (const char* folder : {"outside", "given"}) {
      fs::create_directories(path(folder));
      fs::permissions(path(folder), fs::perms::all);
    }
    escapes::write_text(path("secret"), escapes::token);
    escapes::write_text(path("given/file"), "input");
    listen_everywhere();
    start_grader();
  }
  void TearDown() override {
    if (target_.folder.empty()) return;
    kill(target_.grader, SIGKILL);
    waitpid(target_.grader, nullptr, 0);
    for (const int ear : ears_) close(ear);
    fs::remove_all(target_.folder);
  }
  std::string path(const std::string& name) const { return target_.folder + "/" + name; }

  SandboxOutcome attempt(bool contained) {
    SandboxOptions options;
    options.contained = contained;
    options.mounts = {{ESCAPE_PROGRAM, "/attempt/program"}, {path("given"), "/given"}};
    options.limits.wall_seconds = GetParam().ends ? 30 : 2;
    constexpr std::uint64_t mebibyte = std::uint64_t{1} << 20;
    options.limits.memory_bytes = 128 * mebibyte;
    options.limits.disk_bytes = 16 * mebibyte;
    options.limits.file_bytes = 8 * mebibyte;
    options.limits.log_bytes = mebibyte;
    options.limits.processes = 32;
    return run_sandboxed({contained ? "/attempt/program" : ESCAPE_PROGRAM, GetParam().name, target_.folder,
                          std::to_string(target_.grader), std::to_string(target_.port), target_.abstract,
                          std::to_string(target_.token_address), marker_},
                         options);
  }
  bool heard() const {
    for (const int ear : ears_)
      if (accept(ear, nullptr, nullptr) >= 0) return true;
    return false;
  }
  bool grader_lives() const { return waitpid(target_.grader, nullptr, WNOHANG) == 0; }
  // Removes what uncontained attempts leave in the system.
  void tidy_up() const {
    const auto key = static_cast<key_t>(std::hash<std::string>{}(marker_)&0x7fffffff);
    shm_unlink(("/" + marker_).c_str());
    mq_unlink(("/" + marker_).c_str());
    if (const int id = shmget(key, 0, 0); id >= 0) shmctl(id, IPC_RMID, nullptr);
    if (const int id = msgget(key, 0); id >= 0) msgctl(id, IPC_RMID, nullptr);
    if (const int id = semget(key, 0, 0); id >= 0) semctl(id, 0, IPC_RMID);
    for (const char* folder : {"/tmp/", "/var/tmp/", "/dev/shm/"})
      for (const char* end : {".cache", ".seen"}) unlink((folder + marker_ + end).c_str());
  }

  escapes::Target target_;
  std::string marker_;

 private:
  void listen_everywhere() {
    sockaddr_in four{};
    four.sin_family = AF_INET;
    four.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    ears_ = {listening(AF_INET, four)};
    socklen_t length = sizeof four;
    getsockname(ears_[0], reinterpret_cast<sockaddr*>(&four), &length);
    target_.port = ntohs(four.sin_port);
    sockaddr_in6 six{};
    six.sin6_family = AF_INET6;
    six.sin6_port = four.sin_port;
    six.sin6_addr = in6addr_loopback;
    ears_.push_back(listening(AF_INET6, six));
    sockaddr_un file{}, abstract{};
    file.sun_family = abstract.sun_family = AF_UNIX;
    std::strncpy(file.sun_path, path("socket").c_str(), sizeof file.sun_path - 1);
    std::strncpy(abstract.sun_path + 1, target_.abstract.c_str(), sizeof abstract.sun_path - 2);
    ears_.push_back(listening(AF_UNIX, file));
    ears_.push_back(listening(AF_UNIX, abstract, offsetof(sockaddr_un, sun_path) + 1 + target_.abstract.size()));
  }
  void start_grader() {
    int ends[2];
    ASSERT_EQ(pipe2(ends, O_CLOEXEC), 0);
    target_.grader = fork();
    if (target_.grader == 0) {
      dup2(ends[1], STDOUT_FILENO);
      dup2(open(path("secret").c_str(), O_RDONLY), 20);
      if (chdir(target_.folder.c_str()) != 0) _exit(1);
      const std::string secret = std::string("SECRET=") + escapes::token;
      std::string name = "grader";
      char* arguments[] = {name.data(), nullptr};
      char* environment[] = {const_cast<char*>(secret.c_str()), nullptr};
      execve(ESCAPE_PROGRAM, arguments, environment);
      _exit(1);
    }
    char address[32] = {};
    ASSERT_GT(read(ends[0], address, sizeof address - 1), 0);
    target_.token_address = std::strtoul(address, nullptr, 10);
    close(ends[0]);
    close(ends[1]);
  }
  std::vector<int> ears_;
};

TEST_P(Escapes, fail) {
  // Runs twice: the second run must not find anything that the first one left.
  const Row& row = GetParam();
  const int inherited = open(path("secret").c_str(), O_RDONLY);
  for (int run = 0; run < (row.ends ? 2 : 1); ++run) {
    const SandboxOutcome outcome = attempt(true);
    const std::string message = outcome.process.standard_output.substr(0, 1000);
    EXPECT_THAT(outcome.process.standard_output, testing::Not(testing::HasSubstr("ESCAPED")));
    EXPECT_TRUE(!row.ends || message.find("tried") != message.npos)
        << outcome.sentence() << outcome.process.standard_error;
    EXPECT_NE(outcome.process.end, ProcessOutcome::End::not_started) << outcome.sentence();
  }
  close(inherited);
  EXPECT_TRUE(grader_lives());
  EXPECT_FALSE(heard());
  EXPECT_FALSE(is_running(marker_));
  EXPECT_TRUE(fs::is_empty(path("outside")));
  EXPECT_EQ(escapes::text_of(path("secret")), escapes::token);
  EXPECT_EQ(escapes::text_of(path("given/file")), "input");
  for (const char* folder : {"/tmp/", "/var/tmp/", "/dev/shm/", "/dev/mqueue/"})
    for (const char* end : {"", ".cache", ".seen"}) EXPECT_FALSE(fs::exists(folder + marker_ + end)) << folder << end;
}

INSTANTIATE_TEST_SUITE_P(all, Escapes, testing::ValuesIn(attempts),
                         [](const auto& row) { return std::string(row.param.name); });

class Uncontained : public Escapes {};

TEST_P(Uncontained, attempt_succeeds) {
  attempt(false);
  const SandboxOutcome outcome = attempt(false);
  tidy_up();
  EXPECT_THAT(outcome.process.standard_output, testing::HasSubstr("ESCAPED")) << outcome.process.standard_error;
}

std::vector<Row> that_do_no_harm() {
  std::vector<Row> rows;
  for (const Row& row : attempts)
    if (row.without == succeeds || (row.without == succeeds_for_root && geteuid() == 0)) rows.push_back(row);
  return rows;
}

INSTANTIATE_TEST_SUITE_P(all, Uncontained, testing::ValuesIn(that_do_no_harm()),
                         [](const auto& row) { return std::string(row.param.name); });

TEST(EscapeSuite, has_at_least_forty_attempts) { EXPECT_GE(std::size(attempts), 40U); }

}  // namespace
}  // namespace photonproof::inline harness_sandbox
