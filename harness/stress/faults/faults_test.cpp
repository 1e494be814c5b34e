// Every fault is tried on a sound program. Programs that lose or repeat work, crash or give another result are found,
// each by its own check.

#include <gtest/gtest.h>

#include <filesystem>

#include "harness/stress/faults/fault_rows.h"
#include "harness/stress/faults/faults_record.h"
#include "scenes/base/process.h"
#include "scenes/files/test_folder.h"

namespace photonproof::inline harness_stress_faults {
namespace {

namespace fs = std::filesystem;

class Faults : public FolderTest {
 protected:
  ProcessOutcome faults(const std::vector<std::string>& more) const {
    std::vector<std::string> argv{PHOTONPROOF_TRIALS, "faults", "-o", folder_ / "out", "--quick"};
    argv.insert(argv.end(), more.begin(), more.end());
    return run_process(argv, {.wall_limit_seconds = 200});
  }
  /// Tests a program that is ours after running the script ($* are its arguments, $out its results folder). The script
  /// runs from the third run on: the first two are undisturbed.
  ProcessOutcome faults_of(const std::string& script, const std::string& only, const std::string& kills = "4") const {
    const std::string calls = (folder_ / "calls").string();
    put("program", "#!/bin/sh\nif [ \"$1\" = bench ]; then\n  out=$4\n  echo >>" + calls + "\n  if [ $(wc -l <" +
                       calls + ") -gt 2 ]; then\n" + script + "\n  fi\nfi\nexec " PHOTONPROOF_BINARY " \"$@\"\n");
    fs::permissions(folder_ / "program", fs::perms::owner_all);
    ProcessOutcome outcome = faults({"--only", only, "--kills", kills, "--program", (folder_ / "program").string()});
    if (outcome.exit_code > 1) ADD_FAILURE() << outcome.sentence() << ": " << outcome.standard_error;
    return outcome;
  }
  FaultsRecord record() const { return read_faults_record(folder_ / "out" / "faults.json"); }
  std::string broken() const {
    std::string all;
    for (const FaultOutcome& outcome : record().outcomes)
      for (const std::string& sentence : outcome.broken) all += sentence + "\n";
    return all;
  }
};

TEST_F(Faults, of_every_kind_are_held_by_a_sound_bench_and_not_tried_twice) {
  const ProcessOutcome outcome = faults({"--only", ", bench", "--kills", "3"});
  ASSERT_TRUE(outcome.ok()) << outcome.standard_output << outcome.standard_error;
  const FaultsRecord first = record();
  EXPECT_EQ(first.outcomes.size(), fault_rows().size());
  for (const FaultOutcome& fault : first.outcomes) {
    EXPECT_EQ(fault.broken_count, 0) << fault.fault;
    EXPECT_TRUE(fault.trials > 0 || !fault.not_tried.empty()) << fault.fault;
  }
  EXPECT_GE(first.outcomes[0].count, 3);
  ASSERT_TRUE(faults({"--only", ", bench", "--kills", "3"}).ok());
  EXPECT_EQ(record().outcomes[0].trials, first.outcomes[0].trials);
}

TEST_F(Faults, that_kill_a_render_are_held) {
  const ProcessOutcome outcome = faults({"--only", "kill, render photonmapper", "--kills", "4"});
  EXPECT_TRUE(outcome.ok()) << outcome.standard_output << outcome.standard_error;
}

TEST_F(Faults, find_a_program_that_loses_what_was_finished) {
  // A run that finds parts loses them all and measures none, so that every kill but the earliest shows the loss.
  const char* script =
      "if ls $out/cells/*/cell.json >/dev/null 2>&1; then rm -f $out/cells/*/cell.json; exec sleep 5; fi";
  EXPECT_EQ(faults_of(script, "kill, bench", "12").exit_code, 1);
  EXPECT_NE(broken().find("was finished and is gone"), std::string::npos) << broken();
}

TEST_F(Faults, find_a_program_that_measures_twice) {
  // Every existing cell looks like the first of two.
  const char* script = "for cell in $out/cells/*-1; do [ ! -f $cell/cell.json ] || cp -r $cell ${cell%-1}-2; done";
  EXPECT_EQ(faults_of(script, "kill, bench", "3").exit_code, 1);
  EXPECT_NE(broken().find("measured twice"), std::string::npos) << broken();
}

TEST_F(Faults, find_a_program_whose_result_depends_on_the_kill) {
  const char* script = "sed -i 's/spp=4/spp=8/' $(dirname $2)/bench.toml";
  EXPECT_EQ(faults_of(script, "kill, bench", "1").exit_code, 1);
  EXPECT_NE(broken().find("finished in peace it came to"), std::string::npos) << broken();
}

TEST_F(Faults, find_a_program_that_leaves_processes_behind) {
  EXPECT_EQ(faults_of("sh -c 'sleep 15; :' \"$out\" &", "kill, bench", "1").exit_code, 1);
  EXPECT_NE(broken().find("leaves processes behind"), std::string::npos) << broken();
}

TEST_F(Faults, find_a_program_that_crashes_on_a_bad_disk_or_says_nothing) {
  EXPECT_EQ(faults_of("touch $out/here 2>/dev/null || kill -SEGV $$", "read-only disk, bench").exit_code, 1);
  if (record().outcomes[0].not_tried.empty()) {
    EXPECT_NE(broken().find("was killed by signal 11"), std::string::npos) << broken();
  }
  EXPECT_EQ(faults_of("head -c 10000000 /dev/zero 2>/dev/null >$out/here || exit 2; rm $out/here", "full disk, bench")
                .exit_code,
            1);
  if (record().outcomes[0].not_tried.empty()) {
    EXPECT_NE(broken().find("without a word"), std::string::npos) << broken();
  }
}

TEST_F(Faults, refuse_what_they_do_not_know_in_one_line) {
  for (const std::vector<std::string>& wrong :
       {std::vector<std::string>{"--only", "nothing"}, {"--program", "nothing"}}) {
    const ProcessOutcome outcome = faults(wrong);
    EXPECT_EQ(outcome.exit_code, 2) << wrong[0];
    EXPECT_NE(outcome.standard_error.find("nothing"), std::string::npos) << outcome.standard_error;
  }
}

}  // namespace
}  // namespace photonproof::inline harness_stress_faults
