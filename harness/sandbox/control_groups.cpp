#include "harness/sandbox/control_groups.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <sstream>
#include <string_view>
#include <thread>
#include <utility>

namespace photonproof::inline harness_sandbox {
namespace {

namespace fs = std::filesystem;

// Whether the kernel accepted the value. A stream would retry again and again.
bool write_setting(const fs::path& file, const std::string& value) {
  const int descriptor = open(file.c_str(), O_WRONLY | O_CLOEXEC);
  if (descriptor < 0) return false;
  const bool taken = write(descriptor, value.data(), value.size()) == static_cast<ssize_t>(value.size());
  close(descriptor);
  return taken;
}

// The number behind `key` in a file of lines "key number".
std::uint64_t counted(const fs::path& file, const std::string& key) {
  std::ifstream in(file);
  std::string word;
  for (std::uint64_t number = 0; in >> word >> number;)
    if (word == key) return number;
  return 0;
}

// This process's own group in a controller's hierarchy ("" is version 2's), from lines "number:controllers:path".
std::string own_group(const ControlGroupTree& tree, const std::string& controller) {
  std::ifstream in(tree.own_groups);
  for (std::string line; std::getline(in, line);) {
    const auto first = line.find(':'), second = line.find(':', first + 1);
    if (second == std::string::npos) continue;
    std::istringstream controllers(line.substr(first + 1, second - first - 1));
    bool ours = controller.empty() && second == first + 1;
    for (std::string name; std::getline(controllers, name, ',');) ours = ours || name == controller;
    if (ours) return line.substr(second + 1);
  }
  return "/";
}

constexpr std::string_view group_start = "photonproof-";

std::string new_group_name() {
  static std::atomic<int> made{0};
  return std::string(group_start) + std::to_string(getpid()) + "-" + std::to_string(made++);
}

// Removes groups that killed processes left; a group that still has processes stays.
void remove_abandoned(const ControlGroupTree& tree, const fs::path& parent) {
  std::error_code failure;
  for (fs::directory_iterator entry(parent, failure), none; !failure && entry != none; entry.increment(failure)) {
    const std::string name = entry->path().filename().string();
    if (!name.starts_with(group_start)) continue;
    const auto process = static_cast<pid_t>(std::strtol(name.c_str() + group_start.size(), nullptr, 10));
    if (process <= 0 || kill(process, 0) == 0 || errno != ESRCH) continue;
    if (const auto hold = FolderHold::take(entry->path())) tree.remove(entry->path());
  }
}

// A new group below `group`, or below its nearest ancestor that accepts a group with all settings.
template <class Settings>
fs::path make_group(const ControlGroupTree& tree, const fs::path& root, const std::string& group,
                    std::vector<FolderHold>& holds, const Settings& settings) {
  const std::string name = new_group_name();
  for (fs::path parent = (root / fs::path(group).relative_path()).lexically_normal();; parent = parent.parent_path()) {
    if (tree.make(parent / name)) {
      std::optional<FolderHold> hold = FolderHold::take(parent / name);
      if (hold && settings(parent / name)) {
        holds.push_back(std::move(*hold));
        remove_abandoned(tree, parent);
        return parent / name;
      }
      tree.remove(parent / name);
    }
    if (parent == root || !parent.has_relative_path()) return {};
  }
}

std::optional<fs::path> version_two_root(const ControlGroupTree& tree) {
  for (const fs::path& root : {tree.root, tree.root / "unified"})
    if (fs::exists(root / "cgroup.controllers")) return root;
  return std::nullopt;
}

}  // namespace

ControlGroupTree::ControlGroupTree()
    : make([](const fs::path& group) { return mkdir(group.c_str(), 0755) == 0; }),
      remove([](const fs::path& group) { return rmdir(group.c_str()) == 0; }) {}

ControlGroups::ControlGroups(std::uint64_t memory_bytes, int processes, ControlGroupTree tree)
    : tree_(std::move(tree)) {
  const std::string memory = std::to_string(memory_bytes), most = std::to_string(processes);
  if (const auto root = version_two_root(tree_)) {
    const fs::path both = make_group(tree_, *root, own_group(tree_, ""), holds_, [&](const fs::path& group) {
      if (!write_setting(group / "memory.max", memory) || !write_setting(group / "pids.max", most)) return false;
      write_setting(group / "memory.swap.max", "0");
      write_setting(group / "memory.oom.group", "1");
      return true;
    });
    if (!both.empty()) {
      memory_ = processes_ = both;
      folders_ = {both};
      return;
    }
  }
  memory_ = make_group(tree_, tree_.root / "memory", own_group(tree_, "memory"), holds_, [&](const fs::path& group) {
    if (!write_setting(group / "memory.limit_in_bytes", memory)) return false;
    write_setting(group / "memory.memsw.limit_in_bytes", memory);
    return true;
  });
  processes_ = make_group(tree_, tree_.root / "pids", own_group(tree_, "pids"), holds_,
                          [&](const fs::path& group) { return write_setting(group / "pids.max", most); });
  for (const fs::path& made : {memory_, processes_})
    if (!made.empty()) folders_.push_back(made);
}

ControlGroups::~ControlGroups() {
  for (const fs::path& group : folders_) {
    // A process leaves its group a moment after it has been waited for.
    for (int attempt = 0; !tree_.remove(group) && attempt < 200; ++attempt)
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
}

bool ControlGroups::memory_ran_out() const {
  if (memory_.empty()) return false;
  return counted(memory_ / "memory.events", "oom_kill") > 0 || counted(memory_ / "memory.oom_control", "oom_kill") > 0;
}

bool ControlGroups::processes_ran_out() const {
  return !processes_.empty() && counted(processes_ / "pids.events", "max") > 0;
}

}  // namespace photonproof::inline harness_sandbox
