#include "reports/record/results.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

#include "reports/record/results_fields.h"
#include "scenes/files/test_folder.h"
#include "scenes/records/test_record.h"

namespace photonproof::inline reports_record {
namespace {

namespace fs = std::filesystem;

class ResultsFile : public FolderTest {
 protected:
  void SetUp() override {
    FolderTest::SetUp();
    path_ = (folder_ / "results.json").string();
  }

  void put(const std::string& text) { write_file_atomically(path_, text); }
  void replace(const std::string& from, const std::string& to) {
    std::string text = read_file(path_);
    const auto at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    put(text.replace(at, from.size(), to));
  }
  std::string error_on_read() {
    return input_error_of([&] { read_results(path_); });
  }

  std::string path_;
};

Result full_result() {
  Result result;
  result.cell = {"cornell", "path", {"spp", 64}, 7};
  result.key = "0123abcd";
  result.wall_seconds = 0.1;  // not representable: the round trip must keep every bit
  result.cpu_seconds = 1.0 / 3;
  result.peak_bytes = std::uint64_t{1} << 40;
  result.metrics = {{"relmse", 3.1e-3, "epsilon=0.01"}, {"bias", -1e-17, ""}};
  result.image = "cells/0123abcd/image.exr";
  result.image_checksum = "0123456789abcdef";
  result.pictures = {{"image", "cells/0123abcd/image.png"}};
  result.phases = {{"render", 0.09}};
  result.counts = {{"rays", 123456789}};
  result.skipped = {"caustic map: nothing specular"};
  result.engine_version = "photonproof 0.1.0";
  result.command = "photonproof render 'a b.xml'";
  result.caveats = {"host was busy (load 3.1)"};
  return result;
}

Result failed_result() {
  Result result;
  result.cell = {"cornell", "povray", {"quality", 1}, 1};
  result.key = "ffff";
  result.status = Status::timeout;
  result.detail = "killed after 10 s (limit)";
  return result;
}

Results example() {
  Results results;
  results.suite = "first-light";
  results.created = "2026-01-02T03:04:05Z";
  results.command = "photonproof bench first-light";
  results.host = {"Some CPU", "Debian 12", "6.1", 2, std::uint64_t{8} << 30};
  results.versions = {{"embree", "3.13.5"}};
  results.scenes = {{"cornell", "scenes/cornell/scene.xml", "the box", 128, 96, -0.5, "cornell/path/spp=64/seed=7"}};
  results.engines = {{"path", "path tracer", "0.1.0", "unbiased"}, {"povray", "POV-Ray", "3.7"}};
  results.results = {full_result(), failed_result()};
  return results;
}

Results example_with_conclusions() {
  Results results = example();
  results.results[0].instructions = 123456789012345;
  results.results[0].calibration = CalibrationReading{"1 (12.2.0)", 2, 0.0101};
  results.scenes[0].reference = ReferenceRecord{"box.exr", "reference.exr", "reference.png", {{"samples", "4096"}}};
  results.scenes[0].hdr_exposures = ExposureRange{-2.5, 3, 6};

  ConvergencePoint point;
  point.budget = {"spp", 4};
  point.seeds = 3;
  point.seconds = {0.25, Interval{0.1, 0.5}};
  point.relmse = Estimate{0.01, {}}, point.bias2 = Estimate{-1e-5, {}};
  Convergence curve;
  curve.scene = "cornell";
  curve.engine = "path";
  curve.clock = Clock::processor;
  curve.points.push_back(point);
  curve.slope = Estimate{-1.02, Interval{-1.1, -0.9}};
  curve.targets = {{1e-2, Estimate{2.5, Interval{2, 3}}}, {1e-3, {}, 4.0}, {1e-1, {}, {}, 0.5}};
  curve.caveats.emplace_back("few seeds");
  results.convergence.push_back(curve);

  GateRecord gate;
  gate.name = "box agrees";
  gate.scene = "cornell";
  gate.engine = "path";
  gate.metric = "agreement";
  gate.verdict = GateVerdict::fail;
  gate.sentence = "a hole at (3, 4)";
  gate.status = Status::bad_image;
  gate.observed = Estimate{0.2, Interval{0.1, 0.3}};
  gate.bound = 0.02;
  gate.would_see = 0.013;
  gate.would_see_in_a_block = 0.15;
  gate.regression_only = "the reference is by path, too";
  gate.alpha = 1e-3;
  gate.looks = 2;
  gate.samples = 128;
  gate.seconds = 1.5;
  gate.tiles.push_back({0, 8, 16, 16, 6.5, "-20 %, 12 px"});
  gate.image = "mean.exr";
  gate.pictures["image"] = "mean.png";
  gate.skipped.emplace_back("caustic map: none");
  gate.command = "photonproof gate x";
  results.gates.push_back(gate);

  ChangeRecord change;
  change.scene = "cornell";
  change.engine = "path";
  change.budget = {"spp", 4};
  change.quantity = "seconds";
  change.ratio = {1.03, Interval{1.01, 1.05}};
  change.control = Interval{0.99, 1.01};
  change.change = Change::regression;
  change.sentence = "3 % slower";
  results.changes.push_back(change);
  results.findings.emplace_back("cornell: path fails where bdpt passes");
  results.caveats.emplace_back("noisy");
  return results;
}

void expect_same(const Result& a, const Result& b) {
  EXPECT_EQ(a.cell.label(), b.cell.label());
  EXPECT_EQ(a.key, b.key);
  EXPECT_EQ(a.status, b.status);
  EXPECT_EQ(a.detail, b.detail);
  EXPECT_EQ(a.wall_seconds, b.wall_seconds);
  EXPECT_EQ(a.cpu_seconds, b.cpu_seconds);
  EXPECT_EQ(a.peak_bytes, b.peak_bytes);
  ASSERT_EQ(a.metrics.size(), b.metrics.size());
  for (std::size_t i = 0; i < a.metrics.size(); ++i) {
    EXPECT_EQ(a.metrics[i].name, b.metrics[i].name);
    EXPECT_EQ(a.metrics[i].value, b.metrics[i].value);
    EXPECT_EQ(a.metrics[i].parameters, b.metrics[i].parameters);
  }
  EXPECT_EQ(a.image, b.image);
  EXPECT_EQ(a.image_checksum, b.image_checksum);
  EXPECT_EQ(a.pictures, b.pictures);
  EXPECT_EQ(a.phases, b.phases);
  EXPECT_EQ(a.counts, b.counts);
  EXPECT_EQ(a.skipped, b.skipped);
  EXPECT_EQ(a.engine_version, b.engine_version);
  EXPECT_EQ(a.command, b.command);
  EXPECT_EQ(a.caveats, b.caveats);
}

TEST_F(ResultsFile, round_trip_keeps_every_conclusion) {
  const Results written = example_with_conclusions();
  write_results(path_, written);
  const Results read = read_results(path_);
  EXPECT_EQ(read.results[0].instructions, written.results[0].instructions);
  EXPECT_EQ(read.results[0].calibration, written.results[0].calibration);
  EXPECT_EQ(read.results[1].calibration, std::nullopt);
  EXPECT_EQ(read.scenes[0].reference, written.scenes[0].reference);
  EXPECT_EQ(read.scenes[0].hdr_exposures, (ExposureRange{-2.5, 3, 6}));
  EXPECT_EQ(read.convergence, written.convergence);
  EXPECT_EQ(read.gates, written.gates);
  EXPECT_EQ(read.changes, written.changes);
  EXPECT_EQ(read.findings, written.findings);
  EXPECT_EQ(read.caveats, written.caveats);
}

TEST_F(ResultsFile, has_the_schema_that_is_printed) {
  expect_schema_in<Results>("reports/record/results.schema.json");
  expect_reader_agrees_with_schema(example_with_conclusions());
  expect_reader_agrees_with_schema(KeptResult{full_result(), "beef"});
}

TEST_F(ResultsFile, key_that_is_not_known_is_named) {
  write_results(path_, example());
  replace("\"os\": ", "\"os \": \"\", \"os\": ");
  EXPECT_EQ(error_on_read(), path_ + "#/host: error: has 'os ', which is not known");
}

// Records of version 0.1 have one target a curve.
TEST_F(ResultsFile, older_target_of_a_curve_is_read) {
  Results results = example_with_conclusions();
  results.convergence[0].targets.clear();
  write_results(path_, results);
  replace("\"slope\": ", "\"target_relmse\": 0.01, \"seconds_to_target\": {\"value\": 3}, \"slope\": ");
  const Results read = read_results(path_);
  ASSERT_EQ(read.convergence[0].targets.size(), 1u);
  EXPECT_EQ(read.convergence[0].targets[0].relmse, 0.01);
  EXPECT_EQ(read.convergence[0].targets[0].seconds->value, 3);
}

TEST_F(ResultsFile, round_trip_keeps_every_field) {
  const Results written = example();
  write_results(path_, written);
  const Results read = read_results(path_);
  EXPECT_EQ(read.suite, written.suite);
  EXPECT_EQ(read.created, written.created);
  EXPECT_EQ(read.command, written.command);
  EXPECT_EQ(read.host.cpu, written.host.cpu);
  EXPECT_EQ(read.host.os, written.host.os);
  EXPECT_EQ(read.host.kernel, written.host.kernel);
  EXPECT_EQ(read.host.cores, 2);
  EXPECT_EQ(read.host.memory_bytes, written.host.memory_bytes);
  EXPECT_EQ(read.versions, written.versions);
  ASSERT_EQ(read.scenes.size(), 1u);
  EXPECT_EQ(read.scenes[0].name, "cornell");
  EXPECT_EQ(read.scenes[0].path, written.scenes[0].path);
  EXPECT_EQ(read.scenes[0].purpose, "the box");
  EXPECT_EQ(read.scenes[0].width, 128);
  EXPECT_EQ(read.scenes[0].height, 96);
  EXPECT_EQ(read.scenes[0].exposure, -0.5);
  EXPECT_EQ(read.scenes[0].reference_label, written.scenes[0].reference_label);
  ASSERT_EQ(read.engines.size(), 2u);
  EXPECT_EQ(read.engines[1].name, "povray");
  EXPECT_EQ(read.engines[1].title, "POV-Ray");
  EXPECT_EQ(read.engines[1].version, "3.7");
  EXPECT_EQ(read.engines[0].trust, "unbiased");
  EXPECT_EQ(read.engines[1].trust, "");
  ASSERT_EQ(read.results.size(), 2u);
  expect_same(read.results[0], written.results[0]);
  expect_same(read.results[1], written.results[1]);
  EXPECT_FALSE(read.results[1].wall_seconds.has_value());
}

TEST_F(ResultsFile, single_result_round_trips_too) {
  write_result(path_, {full_result(), "beef"});
  expect_same(read_result(path_).result, full_result());
  EXPECT_EQ(read_result(path_).comparison_key, "beef");
}

TEST_F(ResultsFile, single_result_is_not_taken_for_a_run) {
  write_result(path_, {full_result(), "beef"});
  EXPECT_EQ(error_on_read(), path_ + ": error: has no 'suite'");
}

TEST_F(ResultsFile, every_status_has_a_name_that_reads_back) {
  for (const Status status : {Status::ok, Status::timeout, Status::crash, Status::bad_image, Status::unsupported}) {
    EXPECT_EQ(status_from_string(to_string(status)), status);
  }
  EXPECT_THROW(status_from_string("fine"), InputError);
}

TEST_F(ResultsFile, labels_are_exact) {
  EXPECT_EQ((Budget{"photons", 1e6}.label()), "photons=1000000");
  EXPECT_EQ((Budget{"seconds", 0.25}.label()), "seconds=0.25");
  EXPECT_EQ((Cell{"cornell", "path", {"spp", 64}, 1}.label()), "cornell/path/spp=64/seed=1");
}

TEST_F(ResultsFile, find_answers_by_label) {
  const Results results = example();
  EXPECT_EQ(results.find("cornell/povray/quality=1/seed=1"), &results.results[1]);
  EXPECT_EQ(results.find("cornell/povray/quality=2/seed=1"), nullptr);
}

TEST_F(ResultsFile, writing_a_number_that_is_not_finite_is_a_defect_and_leaves_the_old_file) {
  write_results(path_, example());
  const std::string before = read_file(path_);
  Results results = example();
  results.results[0].metrics[0].value = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(write_results(path_, results), std::logic_error);
  results = example();
  results.results[0].wall_seconds = std::numeric_limits<double>::infinity();
  EXPECT_THROW(write_results(path_, results), std::logic_error);
  EXPECT_EQ(read_file(path_), before);
}

TEST_F(ResultsFile, what_breaks_the_schema_is_not_written) {
  Results results = example();
  results.results[0].key.clear();
  EXPECT_THROW(write_results(path_, results), InputError);
  EXPECT_FALSE(fs::exists(path_));
}

TEST_F(ResultsFile, text_that_is_not_utf8_is_repaired) {
  Result result = failed_result();
  result.detail = "printed \xff garbage";
  write_result(path_, {result, ""});
  EXPECT_EQ(read_result(path_).result.detail, "printed \xEF\xBF\xBD garbage");
}

TEST_F(ResultsFile, wrong_type_is_named_by_its_pointer) {
  write_results(path_, example());
  replace("\"status\": \"timeout\"", "\"status\": \"fine\"");
  EXPECT_EQ(error_on_read(), path_ +
                                 "#/results/1/status: error: is \"fine\", expected one of \"ok\", \"timeout\", "
                                 "\"crash\", \"bad_image\", \"unsupported\", \"not_started\"");
}

// Otherwise a record from elsewhere could put any image of this machine on a published page.
TEST_F(ResultsFile, images_outside_of_the_record_s_folder_are_refused) {
  for (const char* name : {"../secret.exr", "/srv/secret.exr", "cells/../../secret.exr", ".."}) {
    write_results(path_, example());
    replace("\"image\": \"cells/0123abcd/image.exr\"", "\"image\": \"" + std::string(name) + "\"");
    EXPECT_EQ(error_on_read(), std::string(name) + ": error: is outside of the folder of the record that names it");
    write_results(path_, example());
    replace("\"image\": \"cells/0123abcd/image.png\"", "\"image\": \"" + std::string(name) + "\"");
    EXPECT_EQ(error_on_read(), std::string(name) + ": error: is outside of the folder of the record that names it");
  }
  write_results(path_, example());
  replace("cells/0123abcd/image.exr", "cells/..a/image.exr");
  EXPECT_EQ(error_on_read(), "no error");
}

// The names alone look harmless, but their links lead elsewhere. A link to another place in the folder is allowed.
TEST_F(ResultsFile, links_that_lead_out_of_the_record_s_folder_are_refused) {
  const fs::path folder = folder_, cell = folder / "cells" / "0123abcd";
  const fs::path elsewhere = folder.parent_path() / (folder.filename().string() + "-elsewhere");
  fs::create_directories(cell);
  fs::create_directories(elsewhere);
  std::ofstream(elsewhere / "image.exr") << "secret";
  write_results(path_, example());
  EXPECT_EQ(error_on_read(), "no error");
  fs::create_symlink(elsewhere / "image.exr", cell / "image.exr");
  EXPECT_EQ(error_on_read(), "cells/0123abcd/image.exr: error: is outside of the folder of the record that names it");
  fs::remove_all(cell);
  fs::create_directory_symlink(elsewhere, cell);
  EXPECT_NE(error_on_read(), "no error");
  fs::remove(cell);
  fs::create_directories(folder / "cells" / "b");
  fs::create_directory_symlink("b", cell);
  EXPECT_EQ(error_on_read(), "no error");
  fs::remove_all(folder / "cells");
  fs::remove_all(elsewhere);
}

TEST_F(ResultsFile, missing_field_is_named) {
  write_results(path_, example());
  replace("\"key\": \"ffff\",", "");
  EXPECT_EQ(error_on_read(), path_ + "#/results/1: error: has no 'key'");
}

TEST_F(ResultsFile, negative_seed_is_refused) {
  write_results(path_, example());
  replace("\"seed\": 7", "\"seed\": -7");
  EXPECT_EQ(error_on_read(), path_ + "#/results/0/cell/seed: error: is -7, expected a whole number of at least 0");
}

TEST_F(ResultsFile, same_cell_twice_is_refused) {
  Results results = example();
  results.results.push_back(results.results[1]);
  write_results(path_, results);
  EXPECT_EQ(error_on_read(), path_ + ": error: has two results for 'cornell/povray/quality=1/seed=1'");
}

TEST_F(ResultsFile, missing_file_is_named) { EXPECT_EQ(error_on_read(), path_ + ": error: no such file"); }

TEST_F(ResultsFile, truncated_file_is_named_with_the_place) {
  put("{\"schema_version\": 1,\n \"suite\": ");
  // The second line has 10 characters; the end of the file is its column 11.
  EXPECT_EQ(error_on_read(), path_ + ":2:11: error: not valid JSON: the file ends in the middle");
}

TEST_F(ResultsFile, every_truncation_of_a_real_file_is_an_input_error) {
  write_results(path_, example());
  const std::string whole = read_file(path_);
  for (std::size_t length = 0; length + 2 < whole.size(); length += 97) {
    put(whole.substr(0, length));
    EXPECT_THROW(read_results(path_), InputError) << length;
  }
}

TEST_F(ResultsFile, garbage_is_named_with_the_place) {
  put("{\"schema_version\": 1,\n \"suite\": what}");
  EXPECT_EQ(error_on_read(), path_ + ":2:11: error: not valid JSON");
}

TEST_F(ResultsFile, other_json_is_no_results_file) {
  put("[1, 2]");
  EXPECT_EQ(error_on_read(), path_ + ": error: is [1,2], expected an object");
  put("{}");
  EXPECT_EQ(error_on_read(), path_ + ": error: is no record of photonproof results: it has no schema_version");
}

TEST_F(ResultsFile, other_version_is_told_apart_from_corruption) {
  write_results(path_, example());
  replace("\"schema_version\": 1", "\"schema_version\": 2");
  EXPECT_EQ(error_on_read(), path_ + ": error: has schema_version 2; this program reads 1");
}

TEST_F(ResultsFile, overflowing_number_is_refused) {
  write_results(path_, example());
  replace("0.09", "1e999");
  EXPECT_EQ(error_on_read(), path_ + ": error: not valid JSON: a number is too large for a double");
}

}  // namespace
}  // namespace photonproof::inline reports_record
