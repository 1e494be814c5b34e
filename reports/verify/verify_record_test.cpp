#include "reports/verify/verify_record.h"

#include <gtest/gtest.h>

#include <limits>

#include "reports/verify/verify_fields.h"
#include "scenes/base/input_error.h"
#include "scenes/files/atomic_file.h"
#include "scenes/files/scratch_folder.h"
#include "scenes/files/test_folder.h"
#include "scenes/images/image.h"
#include "scenes/records/test_record.h"

namespace photonproof::inline reports_verify {
namespace {

VerifyScene scene_with(const std::string& verdict) {
  VerifyScene scene;
  scene.name = "cornell";
  scene.path = "cornell/scene.xml";
  scene.width = scene.height = 16;
  scene.verdict = verdict;
  scene.sentence = "povray is wrong: +2 % over the whole image";
  VerifyPicture picture;
  picture.engine = "povray";
  picture.status = "ok";
  picture.declared_whole = 0.01;
  picture.picture = "pictures/a.png";
  scene.pictures = {picture};
  VerifyPair pair;
  pair.first = "path";
  pair.second = "povray";
  pair.verdict = "differ";
  pair.shift = {0.01, -0.02, 0};
  pair.would_see = 0.012;
  scene.pairs = {pair};
  VerifyFault fault;
  fault.engine = "povray";
  fault.pass = "direct";
  scene.faults = {fault};
  return scene;
}

VerifyRecord record_with(const std::string& verdict) {
  VerifyRecord record;
  record.created = "2026-11-24T12:00:00Z";
  record.power = 0.02;
  record.engines = {{"path", "path tracer", "photonproof 1"}};
  record.probes = {{"povray", "light", "spot light", "right", "spot light: POV-Ray 1x closed form", 1.0, 0.001, {}}};
  record.scenes = {scene_with(verdict)};
  return record;
}

TEST(VerifyRecord, reads_back_as_it_was_written) {
  const ScratchFolder folder("verify-record");
  const auto file = folder.path() / "verify.json";
  write_verify_record(record_with("differ"), file);
  const VerifyRecord read = read_verify_record(file);
  EXPECT_EQ(verify_record_text(read), verify_record_text(record_with("differ")));
  EXPECT_EQ(read.scenes.at(0).pairs.at(0).shown_shift(), -0.02);
  EXPECT_EQ(read.scenes[0].pairs[0].relmse, std::nullopt);
  EXPECT_EQ(read.probes.at(0).gain, 1.0);
}

TEST(VerifyRecord, that_breaks_the_schema_is_one_error_with_its_place) {
  const ScratchFolder folder("verify-record");
  const auto file = folder.path() / "verify.json";
  std::string text = verify_record_text(record_with("agree"));
  const std::size_t at = text.find("\"agree\"");
  write_file_atomically(file, text.replace(at, 7, "\"maybe\""));
  const std::string error = input_error_of([&] { read_verify_record(file); });
  EXPECT_NE(error.find("#/scenes/0/verdict"), std::string::npos) << error;
  write_file_atomically(file, "{");
  EXPECT_THROW(read_verify_record(file), InputError);
}

TEST(VerifyRecord, has_the_schema_that_is_printed) {
  expect_schema_in<VerifyRecord>("reports/verify/verify.schema.json");
  expect_reader_agrees_with_schema(record_with("differ"));
}

TEST(VerifyRecord, number_that_is_not_finite_is_left_out) {
  VerifyRecord record = record_with("inconclusive");
  record.scenes[0].pairs[0].would_see = std::numeric_limits<double>::infinity();
  EXPECT_EQ(verify_record_text(record).find("would_see"), std::string::npos);
}

TEST(VerifyRecord, exit_codes_are_those_of_gates) {
  EXPECT_EQ(exit_code_of(record_with("agree")), 0);
  for (const char* wrong : {"differ", "stale reference", "cannot tell which", "failed"})
    EXPECT_EQ(exit_code_of(record_with(wrong)), 1) << wrong;
  EXPECT_EQ(exit_code_of(record_with("inconclusive")), 3);
  VerifyRecord record = record_with("agree");
  record.probes[0].verdict = "wrong";
  EXPECT_EQ(exit_code_of(record), 1);
  record = record_with("failed");
  record.scenes[0].pictures[0].status = "not_started";
  EXPECT_EQ(exit_code_of(record), 2);
  record.interrupted = true;
  EXPECT_EQ(exit_code_of(record), 130);
}

TEST(VerifyPage, holds_engines_pairs_and_the_pass_and_no_markup_of_others) {
  const ScratchFolder folder("verify-page");
  std::filesystem::create_directories(folder.path() / "pictures");
  Image image(4, 4);
  write_png((folder.path() / "pictures/a.png").string(), image);
  VerifyRecord record = record_with("differ");
  record.scenes[0].notes = {"<script>alert(1)</script>"};
  write_verify_page(record, folder.path(), folder.path() / "verify.html");
  const std::string page = read_file(folder.path() / "verify.html");
  for (const char* held : {"cornell", "First wrong in <b>direct</b>", "✗ -2 %", "detects 1.2 %", "data:image/png",
                           "spot light: POV-Ray 1x closed form"})
    EXPECT_NE(page.find(held), std::string::npos) << held;
  EXPECT_EQ(page.find("<script>alert"), std::string::npos);
  // The column's value against the row's: povray has 2 % less than path, path 2 % more than povray.
  const std::size_t of_path = page.find("<th scope=\"row\">path</th>"),
                    of_povray = page.find("<th scope=\"row\">povray</th>");
  ASSERT_LT(of_path, of_povray);
  EXPECT_NE(page.substr(of_path, of_povray - of_path).find("✗ -2 %"), std::string::npos);
  EXPECT_NE(page.substr(of_povray).find("✗ +2 %"), std::string::npos);
}

std::string page_of(const VerifyRecord& record) {
  const ScratchFolder folder("verify-page");
  write_verify_page(record, folder.path(), folder.path() / "verify.html");
  return read_file(folder.path() / "verify.html");
}

TEST(VerifyPage, begins_with_the_wrong_engine_and_names_engines_that_are_absent) {
  VerifyRecord record = record_with("differ");
  record.engines.push_back({"cycles", "Cycles", "", "Cycles is not installed"});
  const std::string page = page_of(record), head = page.substr(0, page.find("<main>"));
  EXPECT_NE(head.find("<p class=\"lede bad\">No. cornell: povray is wrong: +2 % over the whole image</p>"),
            std::string::npos);
  EXPECT_NE(head.find("<dt>Not run</dt><dd>Cycles is not installed</dd>"), std::string::npos);
  record.scenes.assign(5, scene_with("differ"));
  EXPECT_NE(page_of(record).find("<p class=\"lede bad\">and 3 more scenes</p>"), std::string::npos);
  record.scenes.assign(2, scene_with("agree"));
  EXPECT_NE(page_of(record).find("<p class=\"lede\">Yes: all 2 scenes agree.</p>"), std::string::npos);
}

// The error asked for is not the one reached: a pair agrees up to 1.5 times it, and up to declared errors.
TEST(VerifyPage, tells_the_error_asked_for_and_the_one_reached_in_one_sentence) {
  VerifyRecord record = record_with("agree");
  record.power = 0.05;
  record.scenes[0].pairs[0].verdict = "agree";
  record.scenes[0].pairs[0].would_see = 0.059;
  EXPECT_NE(page_of(record).find("an error of 5.9 % of the mean, in every pair that agrees (5 % was asked for)"),
            std::string::npos);
  record.scenes[0].pairs[0].verdict = "undecided";
  EXPECT_NE(page_of(record).find("no pair agrees (an error of 5 % was asked for)"), std::string::npos);
}

TEST(VerifyPage, shows_a_scenes_title_and_keeps_its_name_in_links) {
  VerifyRecord record = record_with("differ");
  record.scenes[0].title = "A box";
  record.scenes.push_back(record.scenes[0]);
  const std::string page = page_of(record);
  EXPECT_NE(page.find("<a href=\"#cornell\">A box</a>"), std::string::npos);
  EXPECT_NE(page.find("id=\"cornell\">\n<h2>A box "), std::string::npos);
  EXPECT_NE(page.find(">No. A box: povray is wrong"), std::string::npos);
}

TEST(VerifyTable, says_each_pair_and_what_it_would_have_seen) {
  const std::string table = verify_table(record_with("differ"));
  EXPECT_NE(table.find("cornell: differ: povray is wrong"), std::string::npos) << table;
  EXPECT_NE(table.find("1.2 %"), std::string::npos) << table;
}

// The pair's sentence is about the whole image. A channel's larger shift beside it would look like a second error.
TEST(VerifyTable, says_one_size_of_an_error) {
  VerifyRecord record = record_with("differ");
  VerifyPair& pair = record.scenes[0].pairs[0];
  pair.shift = {1.7, 0.6, 0.4};
  pair.whole_shift = 0.86;
  pair.sentence = "+86 % over the whole image";
  EXPECT_NE(verify_table(record).find("+86 % would see"), std::string::npos) << verify_table(record);
  EXPECT_EQ(verify_table(record).find("+1.7e+02 %"), std::string::npos);
  EXPECT_NE(verify_csv(record).find(",differ,0.86,"), std::string::npos) << verify_csv(record);
}

TEST(VerifyTables, have_a_row_a_scene_and_one_a_pair) {
  VerifyRecord record = record_with("differ");
  record.program = "photonproof 1";
  record.engines.push_back({"povray", "POV-Ray", "POV-Ray 3.7"});
  VerifyScene& scene = record.scenes[0];
  VerifyPicture base;
  base.engine = "path";
  base.status = "ok";
  base.seconds = 0.5;
  scene.pictures.push_back(base);
  scene.pairs[0].ssim = 0.9876;
  scene.believed = {"path"};
  scene.seconds = 12.4;
  const std::string table = verify_markdown(record);
  EXPECT_NE(table.find("| scene | verdict | path | povray | closed form | stored reference | seen | s |"),
            std::string::npos)
      << table;
  EXPECT_NE(table.find("| `cornell` | differ | base | -2.00 % 0.988 ✗ | – | – | – | 12 |"), std::string::npos) << table;
  EXPECT_NE(table.find("1 scene: 1 differ. 0 of 1 pairs agree. 0 have an independent reference"), std::string::npos)
      << table;
  EXPECT_NE(table.find("- `cornell`: differ: povray is wrong"), std::string::npos) << table;
  EXPECT_NE(verify_csv(record).find("cornell,path,povray,differ,-0.02,0.012,,0.9876,0.50,0.00\n"), std::string::npos)
      << verify_csv(record);
  scene.pairs[0].verdict = "agree";
  EXPECT_NE(verify_markdown(record).find("1 has an independent reference: "), std::string::npos);
  // Relative to the base, in whichever order the pair is stored.
  scene.pairs[0].first = "povray";
  scene.pairs[0].second = "path";
  scene.pairs[0].shift = {0, 0.25, 0};
  EXPECT_NE(verify_markdown(record).find("| -20.00 % 0.988 |"), std::string::npos) << verify_markdown(record);
}

}  // namespace
}  // namespace photonproof::inline reports_verify
