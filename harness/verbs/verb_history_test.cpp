// photonproof history, end to end: records of an imaginary renderer that becomes worse, and input that makes no
// history.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "reports/record/results.h"
#include "scenes/base/process.h"
#include "scenes/files/test_folder.h"
#include "scenes/images/image.h"

namespace photonproof::inline harness_verbs {
namespace {

class HistoryVerb : public FolderTest {
 protected:
  ProcessOutcome run(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {PHOTONPROOF_BINARY, "history"});
    return run_process(arguments, {.wall_limit_seconds = 60, .working_folder = folder_});
  }
  ProcessOutcome shell(const std::string& command) const {
    return run_process({"sh", "-c", command}, {.wall_limit_seconds = 60, .working_folder = folder_});
  }
  /// rN/results.json of one cell with this error, measured on day N, with a picture of this brightness.
  std::string put_record(int number, double relmse, float brightness) const {
    const std::filesystem::path folder = folder_ / ("r" + std::to_string(number));
    std::filesystem::create_directory(folder);
    Image image(8, 8);
    image.rgb.assign(image.rgb.size(), brightness);
    write_png((folder / "image.png").string(), image);
    Results results;
    results.suite = "table";
    results.created = "2026-11-" + std::string(number < 10 ? "0" : "") + std::to_string(number) + "T00:00:00Z";
    results.host = {"Some CPU", "os", "kernel", 2, 1};
    results.versions["photonproof"] = "photonproof 0.2.0 (hash" + std::to_string(number) + ")";
    results.scenes.push_back({"cornell", "scene.xml", "", 8, 8, 0, ""});
    Result result;
    result.cell = {"cornell", "path", {"spp", 16}, 1};
    result.key = "key";
    result.metrics.push_back({"relmse", relmse, ""});
    result.pictures["image"] = "image.png";
    result.cpu_seconds = 1 + 0.001 * (number * 7 % 5);
    results.results.push_back(result);
    write_results((folder / "results.json").string(), results);
    return "r" + std::to_string(number) + "/results.json";
  }
  std::vector<std::string> five_records() const {
    std::vector<std::string> files;
    for (int i = 1; i <= 5; ++i) files.push_back(put_record(i, i < 5 ? 0.5 : 0.6, i < 5 ? 0.25f : 0.5f));
    return files;
  }
  void add_five() const {
    std::vector<std::string> arguments = five_records();
    arguments.insert(arguments.begin(), "add");
    const ProcessOutcome outcome = run(arguments);
    ASSERT_TRUE(outcome.ok()) << outcome.standard_error;
  }
};

TEST_F(HistoryVerb, shows_the_last_step_in_its_last_line) {
  add_five();
  const ProcessOutcome outcome = run({"show", "history.db"});
  ASSERT_TRUE(outcome.ok()) << outcome.standard_error;
  EXPECT_EQ(outcome.standard_output,
            "scene    engine  budget  quantity        commits     now           last step\n"
            "cornell  path    16 spp  processor time        5  1.00 s                none\n"
            "cornell  path    16 spp  relMSE                5   0.600  rose 20 % at hash5\n\n"
            "page: history.html\nrelMSE of path on cornell rose 20 % at hash5\n");
  EXPECT_TRUE(get("history.html").ends_with("</html>\n"));
}

TEST_F(HistoryVerb, comments_on_the_newest_commit_with_pictures_that_changed) {
  add_five();
  const ProcessOutcome outcome = run({"comment", "history.db", "-o", "new/comment.md", "--fail"});
  EXPECT_EQ(outcome.exit_code, 1) << outcome.standard_error;
  EXPECT_EQ(outcome.standard_output,
            "comment: new/comment.md\npictures: new/comment-pictures\nrelMSE of path on cornell rose 20 %\n");
  const std::string comment = get("new/comment.md");
  EXPECT_NE(comment.find("hash5 compared with hash4"), std::string::npos) << comment;
  EXPECT_NE(comment.find("<img src=\"comment-pictures/1-difference.png\""), std::string::npos) << comment;
  EXPECT_NEAR(read_image((folder_ / "new/comment-pictures/1-old.png").string()).rgb[0], 0.25, 0.01);
  EXPECT_NEAR(read_image((folder_ / "new/comment-pictures/1-new.png").string()).rgb[0], 0.5, 0.01);
  EXPECT_TRUE(has("new/comment-pictures/1-difference.png"));
  const ProcessOutcome same = run({"comment", "history.db", "--base", "hash3", "--head", "hash4", "--fail"});
  EXPECT_TRUE(same.ok());
  EXPECT_NE(same.standard_output.find("No change beyond noise in "), std::string::npos);
  EXPECT_FALSE(has("comment-pictures"));
}

TEST_F(HistoryVerb, record_is_added_once_and_commit_and_date_can_be_given) {
  const std::string file = put_record(1, 0.5, 0.5f);
  const std::vector<std::string> arguments{"add", file, "--commit", "it's", "--date", "2026-01-02"};
  EXPECT_EQ(run(arguments).standard_output, file + ": 2 values at commit it's, 2026-01-02 00:00 UTC\n");
  EXPECT_EQ(run(arguments).standard_output, file + ": there already, at commit it's\n");
  EXPECT_EQ(run({"add", file}).standard_error,
            "history.db: error: has this record already, as commit it's, not hash1\n");
}

TEST_F(HistoryVerb, input_that_makes_no_history_is_one_error) {
  const std::string file = put_record(1, 0.5, 0.5f);
  put("text.db", "no database at all, but a text that is longer than nothing");
  put("bad.json", "{}");
  const auto message = [&](const std::vector<std::string>& arguments) {
    const ProcessOutcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, 2);
    return outcome.standard_error;
  };
  EXPECT_EQ(message({"show", "text.db"}), "text.db: error: is no history of photonproof\n");
  EXPECT_EQ(message({"add", file, "-o", "text.db"}), "text.db: error: is no history of photonproof\n");
  EXPECT_EQ(message({"show", "missing.db"}), "missing.db: error: cannot be opened: unable to open database file\n");
  EXPECT_FALSE(has("missing.db"));
  EXPECT_EQ(message({"add", file, "bad.json"}).substr(0, 8), "bad.json");
  EXPECT_FALSE(has("history.db"));
  EXPECT_EQ(message({"add", file, "-o", file}).substr(0, 15), "r1/results.json");
  EXPECT_EQ(message({"add", file, "--commit", "a\nb"}),
            "--commit: error: is not the name of a commit, expected 1 to 200 printable characters\n");
  ASSERT_TRUE(run({"add", file}).ok());
  EXPECT_EQ(message({"comment", "history.db"}), "--base: error: no commit is older than the head: name one\n");
  EXPECT_EQ(message({"comment", "history.db", "--base", "hash1"}), "--base: error: is the head itself\n");
  EXPECT_EQ(message({"comment", "history.db", "--head", "x"}), "--head: error: the history has no commit 'x'\n");
  EXPECT_EQ(message({"show", "history.db", "-o", "history.db"}),
            "--output: error: 'history.db' is not the name of a page, expected NAME.html\n");
}

TEST_F(HistoryVerb, record_of_no_version_needs_a_commit) {
  const std::string file = put_record(1, 0.5, 0.5f);
  Results results = read_results((folder_ / file).string());
  results.versions.clear();
  write_results((folder_ / file).string(), results);
  EXPECT_EQ(run({"add", file}).standard_error,
            file + ": error: names no version of photonproof: give its commit by --commit\n");
}

// A limit on the size of files stands for a full disk: the second record does not fit, and the first stays.
TEST_F(HistoryVerb, full_disk_loses_nothing) {
  const std::string first = put_record(1, 0.5, 0.5f), second = put_record(2, 0.5, 0.5f);
  ASSERT_TRUE(run({"add", first}).ok());
  const auto blocks = std::to_string(std::filesystem::file_size(folder_ / "history.db") / 512 / 2);
  const ProcessOutcome full =
      shell("trap '' XFSZ; ulimit -f " + blocks + "; '" PHOTONPROOF_BINARY "' history add " + second + " 2>&1");
  EXPECT_EQ(full.exit_code, 2) << full.standard_output;
  EXPECT_EQ(full.standard_output.substr(0, 29), "history.db: error: cannot be ") << full.standard_output;
  const ProcessOutcome shown = run({"show", "history.db"});
  EXPECT_TRUE(shown.ok()) << shown.standard_error;
  EXPECT_NE(shown.standard_output.find("No step in 2 series of 1 commit\n"), std::string::npos);
  EXPECT_TRUE(run({"add", second}).ok());
}

// Root may write everywhere, so root runs the program as another user.
TEST_F(HistoryVerb, folder_and_file_that_are_read_only_are_one_error) {
  const std::string file = put_record(1, 0.5, 0.5f);
  ASSERT_TRUE(run({"add", file, "-o", "locked/history.db"}).ok());
  namespace fs = std::filesystem;
  fs::permissions(folder_ / "locked/history.db", fs::perms::owner_read | fs::perms::others_read);
  fs::permissions(folder_ / "locked",
                  fs::perms::owner_read | fs::perms::owner_exec | fs::perms::others_read | fs::perms::others_exec);
  const std::string other_user = geteuid() == 0 ? "setpriv --reuid=65534 --regid=65534 --clear-groups " : "";
  const std::string program = other_user + "'" PHOTONPROOF_BINARY "' history ";
  if (!shell(other_user + "'" PHOTONPROOF_BINARY "' --version").ok()) GTEST_SKIP() << "no other user may run it here";
  const std::string second = put_record(2, 0.5, 0.5f);
  EXPECT_EQ(shell(program + "add " + second + " -o locked/history.db 2>&1").standard_output,
            "locked/history.db: error: folder 'locked' is not writable\n");
  const std::string error = shell(program + "add " + second + " -o locked/new.db 2>&1").standard_output;
  EXPECT_TRUE(error.starts_with("locked")) << error;
  EXPECT_EQ(std::count(error.begin(), error.end(), '\n'), 1) << error;
  fs::permissions(folder_ / "locked", fs::perms::all);
  EXPECT_EQ(shell(program + "add " + second + " -o locked/history.db 2>&1").standard_output,
            "locked/history.db: error: cannot be written: it or its folder is read-only\n");
}

TEST_F(HistoryVerb, eight_processes_add_at_once) {
  std::string command;
  for (int i = 1; i <= 8; ++i)
    command +=
        "'" PHOTONPROOF_BINARY "' history add " + put_record(i, 0.5, 0.5f) + " >log" + std::to_string(i) + " 2>&1 & ";
  ASSERT_TRUE(shell(command + "wait").ok());
  const ProcessOutcome shown = run({"show", "history.db"});
  EXPECT_NE(shown.standard_output.find("No step in 2 series of 8 commits\n"), std::string::npos)
      << shown.standard_output << shown.standard_error << get("log1");
}

}  // namespace
}  // namespace photonproof::inline harness_verbs
