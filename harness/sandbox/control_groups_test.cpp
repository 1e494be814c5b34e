// Control groups of both versions, in a tree that a test keeps as the kernel does (cgroups(7),
// Documentation/admin-guide/ cgroup-v2.rst). A group has a controller's files only if its parent lends the controller,
// and files come and go with their group. A test machine has one version or the other, and it seldom allows new groups.
#include "harness/sandbox/control_groups.h"

#include <gmock/gmock.h>

#include <set>

#include "scenes/files/test_folder.h"

namespace photonproof::inline harness_sandbox {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t gibibyte = std::uint64_t{1} << 30;

class ControlGroupsTest : public FolderTest {
 protected:
  void SetUp() override {
    FolderTest::SetUp();
    fs::create_directory(root());
    tree_.root = root();
    tree_.own_groups = folder_ / "own";
    tree_.make = [this](const fs::path& group) { return make(group); };
    tree_.remove = remove;
  }

  fs::path root() const { return folder_ / "groups"; }

  /// A group of version 2 that lends these controllers to its children.
  void add(const std::string& group, const std::string& lends) {
    const fs::path place = group.empty() ? root() : root() / group;
    if (group.empty())
      put("groups/cgroup.controllers", "memory pids");
    else
      ASSERT_TRUE(make(place));
    put((place / "cgroup.subtree_control").lexically_relative(folder_), lends);
  }

  bool make(const fs::path& group) {
    std::error_code failure;
    if (refused_.contains(group.parent_path()) || !fs::create_directory(group, failure)) return false;
    const auto file = [&](const std::string& name) { put((group / name).lexically_relative(folder_), ""); };
    file("cgroup.procs");
    const fs::path hierarchy = group.lexically_relative(root());
    if (*hierarchy.begin() == "memory") file("memory.limit_in_bytes");
    if (*hierarchy.begin() == "pids") file("pids.max");
    if (!fs::exists(group.parent_path() / "cgroup.subtree_control")) return true;
    const std::string lent = read_file(group.parent_path() / "cgroup.subtree_control");
    file("cgroup.subtree_control");
    if (lent.find("memory") != std::string::npos)
      for (const char* name : {"memory.max", "memory.swap.max", "memory.oom.group", "memory.events"}) file(name);
    if (lent.find("pids") != std::string::npos)
      for (const char* name : {"pids.max", "pids.events"}) file(name);
    return true;
  }

  static bool remove(const fs::path& group) {
    for (const fs::directory_entry& entry : fs::directory_iterator(group))
      if (entry.is_directory()) return false;
    return fs::remove_all(group) > 0;
  }

  /// Groups that exist and that the harness has made.
  std::vector<std::string> made() const {
    std::vector<std::string> found;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root()))
      if (entry.is_directory() && entry.path().filename().string().starts_with("photonproof-"))
        found.push_back(entry.path().parent_path().lexically_relative(root()));
    return found;
  }

  ControlGroupTree tree_;
  std::set<fs::path> refused_;  ///< the user may make nothing in these
};

TEST_F(ControlGroupsTest, of_version_two_are_made_above_the_graders_own_which_has_processes_and_lends_nothing) {
  put("own", "0::/user/session\n");
  add("", "memory pids");
  add("user", "memory pids");
  add("user/session", "");
  {
    const ControlGroups groups(gibibyte, 10, tree_);
    ASSERT_EQ(groups.folders().size(), 1U);
    const fs::path group = groups.folders()[0];
    EXPECT_EQ(group.parent_path(), root() / "user");
    EXPECT_EQ(read_file(group / "memory.max"), "1073741824");
    EXPECT_EQ(read_file(group / "memory.swap.max"), "0");
    EXPECT_EQ(read_file(group / "memory.oom.group"), "1");
    EXPECT_EQ(read_file(group / "pids.max"), "10");
    EXPECT_TRUE(groups.counts_memory());
    EXPECT_TRUE(groups.counts_processes());
    EXPECT_THAT(made(), testing::ElementsAre("user"));
  }
  EXPECT_THAT(made(), testing::IsEmpty());
}

TEST_F(ControlGroupsTest, of_version_two_want_both_controllers) {
  put("own", "0::/user/session\n");
  add("", "memory pids");
  add("user", "pids");
  add("user/session", "memory");
  const ControlGroups groups(gibibyte, 10, tree_);
  ASSERT_EQ(groups.folders().size(), 1U);
  EXPECT_EQ(groups.folders()[0].parent_path(), root());
}

TEST_F(ControlGroupsTest, are_none_where_nothing_is_lent_or_nothing_may_be_made) {
  put("own", "0::/user\n");
  add("", "");
  add("user", "");
  const auto expect_none = [&] {
    const ControlGroups groups(gibibyte, 10, tree_);
    EXPECT_THAT(groups.folders(), testing::IsEmpty());
    EXPECT_FALSE(groups.counts_memory());
    EXPECT_FALSE(groups.counts_processes());
    EXPECT_FALSE(groups.memory_ran_out());
    EXPECT_FALSE(groups.processes_ran_out());
    EXPECT_THAT(made(), testing::IsEmpty());
  };
  expect_none();
  put("groups/cgroup.subtree_control", "memory pids");
  put("groups/user/cgroup.subtree_control", "memory pids");
  refused_ = {root(), root() / "user"};
  expect_none();
}

TEST_F(ControlGroupsTest, of_version_two_say_what_ran_out) {
  put("own", "0::/\n");
  add("", "memory pids");
  const ControlGroups groups(gibibyte, 10, tree_);
  ASSERT_EQ(groups.folders().size(), 1U);
  const std::string group = groups.folders()[0].lexically_relative(folder_);
  // The limit was met and memory taken back from caches, which does no harm.
  put(group + "/memory.events", "low 0\nhigh 0\nmax 7\noom 0\noom_kill 0\noom_group_kill 0\n");
  put(group + "/pids.events", "max 0\n");
  EXPECT_FALSE(groups.memory_ran_out());
  EXPECT_FALSE(groups.processes_ran_out());
  put(group + "/memory.events", "low 0\nhigh 0\nmax 9\noom 1\noom_kill 3\noom_group_kill 1\n");
  EXPECT_TRUE(groups.memory_ran_out());
  put(group + "/pids.events", "max 4\n");
  EXPECT_TRUE(groups.processes_ran_out());
}

TEST_F(ControlGroupsTest, of_version_one_serve_where_version_two_has_no_controllers) {
  put("own", "5:memory:/jobs/7\n4:cpu,pids:/jobs\n1:name=systemd:/\n0::/\n");
  fs::create_directories(root() / "unified");
  put("groups/unified/cgroup.controllers", "");
  put("groups/unified/cgroup.subtree_control", "");
  fs::create_directories(root() / "memory" / "jobs" / "7");
  fs::create_directories(root() / "pids" / "jobs");
  const ControlGroups groups(gibibyte, 10, tree_);
  ASSERT_EQ(groups.folders().size(), 2U);
  EXPECT_EQ(groups.folders()[0].parent_path(), root() / "memory" / "jobs" / "7");
  EXPECT_EQ(read_file(groups.folders()[0] / "memory.limit_in_bytes"), "1073741824");
  EXPECT_EQ(groups.folders()[1].parent_path(), root() / "pids" / "jobs");
  EXPECT_EQ(read_file(groups.folders()[1] / "pids.max"), "10");
  put((groups.folders()[0] / "memory.oom_control").lexically_relative(folder_),
      "oom_kill_disable 0\nunder_oom 0\noom_kill 1\n");
  EXPECT_TRUE(groups.memory_ran_out());
}

}  // namespace
}  // namespace photonproof::inline harness_sandbox
