#include "harness/bench/against.h"

#include "harness/bench/bench.h"
#include "harness/suites/test_suite.h"

namespace photonproof::inline harness_bench {
namespace {

class Nobody : public BenchObserver {
 public:
  void starts(std::size_t, std::size_t, const Cell&) override {}
  void ended(std::size_t, std::size_t, const Result&) override {}
};

// {photonproof} is a shell script that counts to a number and copies an image; the reference is grey (0.5).
class Against : public FakeSuiteTest {
 protected:
  void SetUp() override {
    FakeSuiteTest::SetUp();
    write_grey("dark.exr", width, height, 0.2f);
    put("suite.toml", suite_text("grey", {}) +
                          "[[engine]]\nname = 'ours'\ntitle = 'ours'\n"
                          "command = ['{photonproof}', '{scene}', '{output}', '{seed}']\nbudgets = ['spp', 'seconds']\n"
                          "trust = 'external'\n"
                          "[[run]]\nengine = 'ours'\nbudgets = ['spp=1', 'spp=4']\nseeds = [1, 2]\n");
  }
  std::filesystem::path program(const std::string& name, int count, const std::string& image) const {
    put(name, "#!/bin/sh\necho \"$3\" >> " + (folder_ / (name + ".seeds")).string() + "\ni=0; while [ $i -lt " +
                  std::to_string(count) + " ]; do i=$((i+1)); done\ncp " + (folder_ / image).string() + " \"$2\"\n");
    std::filesystem::permissions(folder_ / name, std::filesystem::perms::owner_all);
    return folder_ / name;
  }
  BenchSummary bench(const std::string& out, const std::filesystem::path& with) {
    options_.results_folder = folder_ / out;
    options_.program = with;
    options_.comparison_version = "1";
    options_.versions = {{program_key, with.string()}, {program_hash_key, program_hash(with)}};
    return run_bench(read_suite(folder_ / "suite.toml"), options_, nobody_);
  }
  // Changes between a run by `old_program` and a run by `with`, by quantity.
  std::map<std::string, ChangeRecord> changes(const std::filesystem::path& old_program,
                                              const std::filesystem::path& with) {
    bench("old", old_program);
    options_.against = AgainstOptions{};
    options_.against->results = folder_ / "old" / "results.json";
    options_.against->old_program = old_program;
    // The shell's start adds some 10 ms, which must not decide.
    options_.against->thresholds.seconds = 0.2;
    options_.against->seconds = 60;
    bench("new", with);
    std::map<std::string, ChangeRecord> by_quantity;
    for (const ChangeRecord& change : read_results((folder_ / "new" / "results.json").string()).changes) {
      EXPECT_EQ(by_quantity.count(change.quantity), 0u);
      by_quantity[change.quantity] = change;
    }
    return by_quantity;
  }

  BenchOptions options_;
  Nobody nobody_;
};

constexpr int work = 20'000;

TEST_F(Against, twice_the_work_is_a_regression_of_time_and_not_of_error) {
  auto change = changes(program("old.sh", work, "brighter.exr"), program("new.sh", 2 * work, "brighter.exr"));
  EXPECT_EQ(change["seconds"].change, Change::regression) << change["seconds"].sentence;
  // Less than 2, since the shell's start adds to both times.
  EXPECT_GT(change["seconds"].ratio.value, 1.3);
  EXPECT_LT(change["seconds"].ratio.value, 2.2);
  EXPECT_TRUE(change["seconds"].control);
  EXPECT_EQ(change["seconds"].budget.label(), "spp=4");  // the largest
  EXPECT_EQ(change["relmse"].change, Change::unchanged);
  EXPECT_EQ(change["relmse"].sentence.rfind("same images, to the bit, for ", 0), 0u) << change["relmse"].sentence;
}

// relmse of 0.6 and 0.2 against 0.5: 0.01 and 0.09 over the same denominator.
TEST_F(Against, darker_image_is_a_regression_of_error) {
  auto change = changes(program("old.sh", work, "brighter.exr"), program("new.sh", work, "dark.exr"));
  EXPECT_NE(change["seconds"].change, Change::regression) << change["seconds"].sentence;
  EXPECT_EQ(change["relmse"].change, Change::regression);
  EXPECT_NEAR(change["relmse"].ratio.value, 9, 1e-4);
}

TEST_F(Against, every_round_has_a_seed_of_its_own_that_all_three_share) {
  const auto old_program = program("old.sh", work, "brighter.exr"),
             new_program = program("new.sh", work, "brighter.exr");
  changes(old_program, new_program);
  // The suite's four cells and the warm-up first (two bytes each), then the rounds from seed 1 up: the new program
  // once, the old one twice.
  const std::string seeds = get("new.sh.seeds").substr(10);
  EXPECT_EQ(seeds.rfind("1\n2\n3\n4\n5\n", 0), 0u) << seeds;
  const auto count = [](const std::string& text, const std::string& line) {
    std::size_t n = 0;
    for (std::size_t at = text.find(line); at != std::string::npos; at = text.find(line, at + 1)) ++n;
    return n;
  };
  EXPECT_EQ(count(get("old.sh.seeds"), "5\n"), 2u);
}

// The record is genuine: its program exists and has the hash that the record gives. Each run of that program adds a
// line to old.sh.seeds, so no line may be added after the record is written.
TEST_F(Against, program_that_a_record_names_is_never_run) {
  bench("old", program("old.sh", work, "brighter.exr"));
  const std::string runs_before = get("old.sh.seeds");
  options_.against = AgainstOptions{};
  options_.against->results = folder_ / "old" / "results.json";
  const Results old_run = read_results(options_.against->results.string());
  ASSERT_EQ(old_run.versions.at(program_key), (folder_ / "old.sh").string());
  ASSERT_EQ(old_run.versions.at(program_hash_key), program_hash(folder_ / "old.sh"));
  bench("new", program("new.sh", 2 * work, "brighter.exr"));
  EXPECT_EQ(get("old.sh.seeds"), runs_before);
  const Results results = read_results((folder_ / "new" / "results.json").string());
  ASSERT_FALSE(results.changes.empty());
  EXPECT_EQ(results.changes[0].change, Change::inconclusive);
  EXPECT_NE(results.changes[0].sentence.find("--old-program PATH would decide it"), std::string::npos);
}

TEST_F(Against, hash_of_a_program_differs_when_a_byte_of_it_does) {
  std::string bytes((std::size_t{1} << 20) + 5, 'a');
  put("one", bytes);
  const std::string hash = program_hash(folder_ / "one");
  EXPECT_FALSE(hash.empty());
  put("same", bytes);
  EXPECT_EQ(program_hash(folder_ / "same"), hash);
  for (const std::size_t at : {std::size_t{0}, bytes.size() / 2, bytes.size() - 1}) {
    bytes[at] = 'b';
    put("other", bytes);
    EXPECT_NE(program_hash(folder_ / "other"), hash);
    bytes[at] = 'a';
  }
  put("longer", bytes + 'a');
  EXPECT_NE(program_hash(folder_ / "longer"), hash);
  EXPECT_EQ(program_hash(folder_ / "missing"), "");
}

TEST_F(Against, older_run_in_the_same_folder_is_read_before_it_is_replaced) {
  const auto old_program = program("old.sh", work, "brighter.exr");
  bench("out", old_program);
  options_.against = AgainstOptions{};
  options_.against->results = folder_ / "out" / "results.json";
  options_.against->old_program = old_program;
  options_.against->most_rounds = 1;
  bench("out", program("new.sh", work, "dark.exr"));
  // Nothing was measured again, since the key has no version. The rounds use the older run's program.
  const Results results = read_results((folder_ / "out" / "results.json").string());
  ASSERT_EQ(results.changes.size(), 2u);
  EXPECT_NEAR(results.changes[1].ratio.value, 9, 1e-4);
}

TEST_F(Against, old_program_that_fails_is_inconclusive_and_says_why) {
  bench("old", program("old.sh", work, "brighter.exr"));
  put("broken.sh", "#!/bin/sh\necho 'no such option' >&2\nexit 9\n");
  std::filesystem::permissions(folder_ / "broken.sh", std::filesystem::perms::owner_all);
  options_.against = AgainstOptions{};
  options_.against->results = folder_ / "old" / "results.json";
  options_.against->old_program = folder_ / "broken.sh";
  bench("new", program("new.sh", work, "brighter.exr"));
  const Results results = read_results((folder_ / "new" / "results.json").string());
  ASSERT_EQ(results.changes.size(), 1u);
  EXPECT_EQ(results.changes[0].sentence, "the old program: crash (exited with 9: no such option)");
}

TEST_F(Against, missing_old_program_or_results_are_input_errors) {
  const auto mine = program("new.sh", work, "brighter.exr");
  options_.against = AgainstOptions{};
  options_.against->results = folder_ / "none.json";
  EXPECT_NE(input_error_of([&] { bench("new", mine); }).find("none.json"), std::string::npos);
  options_.against.reset();
  bench("old", mine);
  options_.against = AgainstOptions{};
  options_.against->results = folder_ / "old" / "results.json";
  options_.against->old_program = folder_ / "gone";
  EXPECT_EQ(input_error_of([&] { bench("new", mine); }),
            "--old-program: error: no such file: " + (folder_ / "gone").string());
}

}  // namespace
}  // namespace photonproof::inline harness_bench
