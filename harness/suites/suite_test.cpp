#include "harness/suites/suite.h"

#include <algorithm>

#include "scenes/files/test_folder.h"

namespace photonproof::inline harness_suites {
namespace {

constexpr const char* head = "name = 'tiny'\ntitle = 'Tiny'\n";
constexpr const char* scenes =
    "[[scene]]\nname = 'a'\npath = 'a.xml'\nwidth = 8\nheight = 6\nexposure = 1\n"
    "reference = {engine = 'path', budget = 'spp=64', seed = 9}\n"
    "[[scene]]\nname = 'b'\npath = 'b.xml'\nwidth = 8\nheight = 6\n"
    "reference = {engine = 'path', budget = 'spp=64', seed = 9}\n";

class SuiteFile : public FolderTest {
 protected:
  void SetUp() override {
    FolderTest::SetUp();
    put("a.xml", "");
    put("b.xml", "");
  }
  Suite read(const std::string& text) const {
    put("s.toml", text);
    return read_suite(folder_ / "s.toml");
  }
  // The first line of the error, without the folder.
  std::string error(const std::string& text) const {
    std::string message = input_error_of([&] { read(text); });
    message.resize(std::min(message.size(), message.find('\n')));
    const std::string prefix = folder_.string() + "/";
    for (auto at = message.find(prefix); at != std::string::npos; at = message.find(prefix))
      message.erase(at, prefix.size());
    return message;
  }
};

TEST_F(SuiteFile, runs_expand_to_cells_in_order) {
  const Suite suite = read(std::string(head) + "[limits]\nseconds = 5\nmemory_mb = 100\nthreads = 3\n" + scenes +
                           "[[run]]\nengine = 'path'\nbudgets = ['spp=1', 'spp=2']\nseeds = [1, 2]\nscenes = ['b']\n"
                           "[[run]]\nengine = 'povray'\nbudgets = ['quality=1']\nseeds = [1]\n");
  EXPECT_EQ(suite.name, "tiny");
  EXPECT_EQ(suite.title, "Tiny");
  EXPECT_EQ(suite.limits.seconds, 5);
  EXPECT_EQ(suite.limits.memory_mb, 100u);
  EXPECT_EQ(suite.limits.threads, 3);
  ASSERT_EQ(suite.scenes.size(), 2u);
  EXPECT_EQ(suite.scenes[0].path, folder_ / "a.xml");
  EXPECT_EQ(suite.scenes[0].given_path, "a.xml");
  EXPECT_EQ(suite.scenes[0].exposure, 1.0);
  EXPECT_FALSE(suite.scenes[1].exposure.has_value());
  EXPECT_EQ(suite.scenes[0].reference.value().label(), "a/path/spp=64/seed=9");
  std::vector<std::string> labels;
  for (const Cell& cell : suite.cells) labels.push_back(cell.label());
  EXPECT_EQ(labels, (std::vector<std::string>{"b/path/spp=1/seed=1", "b/path/spp=1/seed=2", "b/path/spp=2/seed=1",
                                              "b/path/spp=2/seed=2", "a/povray/quality=1/seed=1",
                                              "b/povray/quality=1/seed=1"}));
}

TEST_F(SuiteFile, a_run_may_name_several_engines) {
  const Suite suite =
      read(std::string(head) + scenes + "[[run]]\nengine = ['path', 'bdpt']\nbudgets = ['spp=1']\nseeds = [1]\n");
  std::vector<std::string> labels;
  for (const Cell& cell : suite.cells) labels.push_back(cell.label());
  EXPECT_EQ(labels, (std::vector<std::string>{"a/path/spp=1/seed=1", "b/path/spp=1/seed=1", "a/bdpt/spp=1/seed=1",
                                              "b/bdpt/spp=1/seed=1"}));
}

TEST_F(SuiteFile, own_engine_can_be_used) {
  const Suite suite = read(std::string(head) + scenes +
                           "[[engine]]\nname = 'mine'\ntitle = 'Mine'\ncommand = ['x', '{scene}', '{output}']\n"
                           "budgets = ['run']\ntrust = 'external'\n"
                           "[[run]]\nengine = 'mine'\nbudgets = ['run=1']\nseeds = [0]\n");
  EXPECT_EQ(suite.engine("mine").title, "Mine");
  EXPECT_EQ(suite.cells.size(), 2u);
}

TEST_F(SuiteFile, control_has_every_cell_of_its_engine_a_second_time) {
  const Suite suite = read(std::string(head) + "[bench]\ncontrol = 'path'\n" + scenes +
                           "[[run]]\nengine = 'path'\nbudgets = ['spp=1', 'target-error=0.5']\nseeds = [1]\n"
                           "[[run]]\nengine = 'bdpt'\nbudgets = ['spp=1']\nseeds = [1]\n");
  EXPECT_EQ(suite.engine("path-control").command, suite.engine("path").command);
  // Two scenes: four cells by path, two by bdpt, four for the control.
  ASSERT_EQ(suite.cells.size(), 10u);
  EXPECT_EQ(suite.cells[9].label(), "b/path-control/target-error=0.5/seed=1");
  EXPECT_EQ(error(std::string(head) + "[bench]\ncontrol = 'nobody'\n" + scenes)
                .rfind("s.toml:4:11: error: unknown engine 'nobody'", 0),
            0u);
  EXPECT_EQ(error(std::string(head) + "[bench]\ncontrol = 'path'\n" + scenes),
            "s.toml:4:11: error: engine 'path' has no [[run]]");
}

TEST_F(SuiteFile, clock_is_wall_or_processor) {
  EXPECT_EQ(read(std::string(head) + scenes).clock, Clock::wall);
  EXPECT_EQ(read(std::string(head) + "[bench]\nclock = 'processor'\n" + scenes).clock, Clock::processor);
  EXPECT_EQ(error(std::string(head) + "[bench]\nclock = 'sun'\n" + scenes),
            "s.toml:4:9: error: 'sun' is no clock; there are wall and processor");
}

TEST_F(SuiteFile, the_suites_we_ship_are_valid) {
  const std::filesystem::path folder = PHOTONPROOF_SOURCE_DIR "/harness/suites";
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".toml") continue;
    if (entry.path().stem().string().starts_with("gates")) continue;  // the other kind: gate_suite_test.cpp
    EXPECT_EQ(input_error_of([&] { EXPECT_EQ(read_suite(entry.path()).name, entry.path().stem()); }), "no error");
    ++count;
  }
  EXPECT_GE(count, 1);
}

TEST_F(SuiteFile, mistakes_are_named_with_their_place) {
  const std::string run = "[[run]]\nengine = 'path'\nbudgets = ['spp=1']\nseeds = [1]\n";
  // Lines: head 1-2, scene a 3-9, scene b 10-15, the run from 16 on.
  const std::string good = std::string(head) + scenes + run;
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    text.replace(text.find(from), from.size(), to);
    return error(text);
  };
  EXPECT_EQ(error(good), "no error");
  EXPECT_EQ(with("title = 'Tiny'\n", ""), "s.toml:1:1: error: 'title' is missing");
  EXPECT_EQ(with("'tiny'", "'../up'"),
            "s.toml:1:8: error: 'name' may hold letters, digits, '_', '.' and '-' and not start with '.'");
  EXPECT_EQ(with("[[run]]", "sets = 1\n[[run]]"),
            "s.toml:16:1: error: unknown key 'sets'; known here: exposure, files, height, "
            "name, path, reads, reference, target_relmse, width");
  EXPECT_EQ(with("[[scene]]", "[limits]\nsecs = 1\n[[scene]]"),
            "s.toml:4:1: error: unknown key 'secs'; known here: memory_mb, seconds, threads");
  EXPECT_EQ(with("[[scene]]", "[limits]\nseconds = 0\n[[scene]]"), "s.toml:4:11: error: 'seconds' must be positive");
  EXPECT_EQ(with("a.xml", "c.xml"), "s.toml:5:8: error: no such file: c.xml");
  const std::string endless(300, 'n');  // longer than any file's name
  EXPECT_EQ(with("a.xml", endless), "s.toml:5:8: error: no such file: " + endless);
  EXPECT_EQ(with("width = 8", "width = 0"), "s.toml:6:9: error: 'width' must lie between 1 and 16384");
  EXPECT_EQ(with("width = 8", "width = 'x'"), "s.toml:6:9: error: 'width' must be an integer, not a string");
  EXPECT_EQ(with("'spp=64'", "'spp=0'"),
            "s.toml:9:40: error: a budget is written \"kind=amount\" with a positive amount, not 'spp=0'");
  EXPECT_EQ(with("name = 'b'", "name = 'a'"), "s.toml:11:8: error: there is a scene 'a' already");
  EXPECT_EQ(with("engine = 'path'\nbudgets", "engine = 'pth'\nbudgets"),
            "s.toml:17:10: error: unknown engine 'pth' (did you mean 'path'?); known: path, photonmapper, sppm, bdpt, "
            "ptracer, volpath, povray, "
            "cycles, mitsuba, reference");
  EXPECT_EQ(with("['spp=1']", "['spp=1', 'photons=2']"),
            "s.toml:18:21: error: engine 'path' takes budgets of spp, seconds, target-error; not 'photons'");
  EXPECT_EQ(with("seeds = [1]", "seeds = [1, -2]"), "s.toml:19:13: error: a seed must not be negative");
  EXPECT_EQ(with("seeds = [1]", "seeds = [1]\nscenes = ['a', 'z']"),
            "s.toml:20:16: error: unknown scene 'z'; known: a, b");
  EXPECT_EQ(with("['spp=1']", "['sp=1']"),
            "s.toml:18:12: error: engine 'path' takes budgets of spp, seconds, target-error; not 'sp' (did you mean "
            "'spp'?)");
  EXPECT_EQ(with("engine = 'path'\nbudgets", "engine = ['path', 'bdtp']\nbudgets").substr(0, 60),
            std::string("s.toml:17:19: error: unknown engine 'bdtp' (did you mean 'bdpt'?)").substr(0, 60));
  EXPECT_EQ(with("width = 8", "files = {pth = 'b.xml'}\nwidth = 8").substr(0, 43),
            "s.toml:6:16: error: unknown engine 'pth' (d");
  EXPECT_EQ(with("width = 8", "files = {path = 'c.xml'}\nwidth = 8"), "s.toml:6:17: error: no such file: c.xml");
  EXPECT_EQ(with("seeds = [1]", "seeds = [1, 1]"), "s.toml:16:1: error: the cell a/path/spp=1/seed=1 occurs twice");
  EXPECT_EQ(error(good + run), "s.toml:20:1: error: the cell a/path/spp=1/seed=1 occurs twice");
  EXPECT_EQ(with("['spp=1']\nseeds = [1]", "['spp=64']\nseeds = [9]"),
            "s.toml:16:1: error: the cell a/path/spp=64/seed=9 is the scene's reference; it would be compared with "
            "itself");
  EXPECT_EQ(error(head), "s.toml:1:1: error: the suite has no [[scene]]");
  EXPECT_EQ(with("[[run]]", "[[rnu]]"),
            "s.toml:16:3: error: unknown key 'rnu' (did you mean 'run'?); known here: bench, engine, limits, name, "
            "run, scene, title");
}

TEST_F(SuiteFile, missing_suite_is_named) {
  EXPECT_EQ(input_error_of([&] { read_suite(folder_ / "none.toml"); }),
            (folder_ / "none.toml").string() + ": error: no such file");
}

TEST(BudgetText, only_kind_and_positive_amount_is_a_budget) {
  EXPECT_EQ(budget_from_text("seconds=0.5"), (Budget{"seconds", 0.5}));
  EXPECT_EQ(budget_from_text("photons=1e6"), (Budget{"photons", 1e6}));
  for (const char* text :
       {"", "spp", "spp=", "=4", "spp=-1", "spp=0", "spp=4x", "spp= 4", "SPP=4", "spp=inf", "spp=nan"})
    EXPECT_FALSE(budget_from_text(text).has_value()) << text;
}

constexpr const char* mine =
    "[[engine]]\nname = 'mine'\ntitle = 'm'\ncommand = ['mine', '{scene}', '{output}']\nbudgets = ['spp']\n"
    "trust = 'external'\n";
constexpr const char* run_of_mine = "[[run]]\nengine = 'mine'\nbudgets = ['spp=1']\nseeds = [1]\n";

TEST_F(SuiteFile, scenes_that_only_the_engine_reads_are_files_folders_words_and_numbers) {
  put("ball.blend", "no XML");
  std::filesystem::create_directories(folder_ / "room");
  const auto scene_of = [&](const std::string& row) {
    return read(std::string(head) + mine + "[[scene]]\nname = 's'\n" + row + run_of_mine).scenes.at(0);
  };
  struct Case {
    const char* row;
    SceneReader reader;
    std::filesystem::path path;
  };
  for (const auto& [row, reader, path] :
       {Case{"path = 'ball.blend'\n", SceneReader::engine, folder_ / "ball.blend"},
        {"path = 'room'\n", SceneReader::engine, folder_ / "room"},
        {"path = 'a.xml'\nreads = 'engine'\n", SceneReader::engine, folder_ / "a.xml"},
        {"path = 7\n", SceneReader::engine_by_word, "7"},
        {"path = 'cornell'\nreads = 'engine'\n", SceneReader::engine_by_word, "cornell"}}) {
    const SuiteScene scene = scene_of(row);
    EXPECT_EQ(scene.reader, reader) << row;
    EXPECT_EQ(scene.path, path) << row;
    EXPECT_EQ(scene.width, 256) << row;
    EXPECT_EQ(scene.height, 256) << row;
  }
  put("ours", "<?xml version='1.0'?>\n<scene version='3.0.0'/>");
  EXPECT_EQ(scene_of("path = 'ours'\nwidth = 8\nheight = 6\n").reader, SceneReader::photonproof);
  EXPECT_EQ(scene_of("path = 'a.xml'\nwidth = 8\nheight = 6\n").reader, SceneReader::photonproof);
}

TEST_F(SuiteFile, a_scene_without_a_size_has_that_of_its_film) {
  put("film.xml",
      "<scene version=\"3.0.0\"><sensor type=\"perspective\"><film type=\"hdrfilm\">"
      "<integer name=\"width\" value=\"40\"/><integer name=\"height\" value=\"30\"/></film></sensor>"
      "<emitter type=\"constant\"><rgb name=\"radiance\" value=\"1\"/></emitter></scene>");
  const SuiteScene scene =
      read(std::string(head) + "[[scene]]\nname = 's'\npath = 'film.xml'\nheight = 12\n").scenes.at(0);
  EXPECT_EQ(scene.width, 40);
  EXPECT_EQ(scene.height, 12);
}

TEST_F(SuiteFile, a_missing_file_is_never_taken_for_a_word) {
  const auto of = [&](const std::string& row) {
    return error(std::string(head) + mine + "[[scene]]\nname = 's'\n" + row + run_of_mine);
  };
  EXPECT_EQ(of("path = 'ball.blend'\n"), "s.toml:11:8: error: no such file: ball.blend");
  EXPECT_EQ(of("path = 'ball.blend'\nreads = 'engine'\n"), "s.toml:11:8: error: no such file: ball.blend");
  EXPECT_EQ(of("path = 'cornell'\n"),
            "s.toml:11:8: error: no such file: cornell; reads = \"engine\" beside it makes it a word that only the "
            "engine reads");
  EXPECT_EQ(of("path = 'a.xml'\nreads = 'me'\n"),
            "s.toml:12:9: error: 'reads' is \"engine\", where only the engine reads the scene; not 'me'");
}

TEST_F(SuiteFile, our_own_engines_are_refused_for_scenes_that_they_cannot_read) {
  EXPECT_EQ(error(std::string(head) +
                  "[[scene]]\nname = 's'\npath = 7\n[[run]]\nengine = 'path'\nbudgets = ['spp=1']\nseeds = [1]\n"),
            "s.toml:7:10: error: engine 'path' is part of this program, which cannot read scene 's' (7); name an "
            "[[engine]] that reads it");
}

TEST_F(SuiteFile, all_missing_keys_are_told_at_once) {
  EXPECT_EQ(
      error("name = 'n'\n[[engine]]\nname = 'mine'\n[[scene]]\nname = 's'\n[[run]]\nengine = 'mine'\n"),
      "s.toml:1:1: error: these keys are missing: 'title' of the suite; 'title', 'command', 'budgets', 'trust' of "
      "[[engine]] in line 2; 'path' of [[scene]] in line 4; 'budgets', 'seeds' of [[run]] in line 6");
}

}  // namespace
}  // namespace photonproof::inline harness_suites
