// A small invented record for tests, with everything that a report can show.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "reports/record/results.h"
#include "reports/view/temporary_folder.h"
#include "scenes/images/image.h"

namespace photonproof::reports::inline reports_view {

inline Result sample_result(const std::string& scene, const std::string& engine, Budget budget, std::uint64_t seed) {
  Result result;
  result.cell = {scene, engine, std::move(budget), seed};
  result.wall_seconds = 1.25;
  result.cpu_seconds = 2.4;
  result.peak_bytes = 61'000'000;
  result.engine_version = "0.1.0";
  result.command = "photonproof render " + scene + ".xml --integrator " + engine;
  return result;
}

inline Result finished(const std::string& scene, const std::string& engine, Budget budget, std::uint64_t seed,
                       double relmse) {
  Result result = sample_result(scene, engine, std::move(budget), seed);
  result.metrics = {{"mse", relmse / 4, ""},
                    {"relmse", relmse, "epsilon=0.01"},
                    {"relmse_trimmed", relmse / 2, "epsilon=0.01, trimmed=0.1% of pixels"},
                    {"ssim", 1 - relmse, scene == "box" ? "exposure=0" : "exposure=-1"},
                    {"psnr", 31.25, scene == "box" ? "exposure=0" : "exposure=-1"},
                    {"flip", 0.0625, scene == "box" ? "exposure=0" : "exposure=-1"},
                    {"bias", -0.0123, ""}};
  result.phases = {{"photons", 0.25}, {"render", 0.875}};
  result.counts = {{"rays", 1234567}};
  result.skipped = {"caustic pass: no specular surface"};
  return result;
}

/// Two scenes and two engines; the pictures it names are made by write_sample_pictures.
inline Results sample_results() {
  Results results;
  results.suite = "sample";
  results.created = "2026-02-03T04:05:06Z";
  results.command = "photonproof bench suites/sample.toml";
  results.host = {"Some CPU", "Debian 12", "Linux 6.1", 2, std::uint64_t{8} << 30};
  results.versions = {{"embree", "3.13.5"}};
  results.engines = {{"photon", "photon mapper", "0.1.0"}, {"povray", "POV-Ray", "3.7"}};

  Result reference = sample_result("box", "path", {"spp", 4096}, 99);
  reference.pictures = {{"image", "box-ref.png"}};
  results.scenes.push_back({"box", "box.xml", "Shows a box.", 8, 8, 0, reference.cell.label()});
  results.scenes.push_back({"hole", "hole.xml", "Shows a hole.", 8, 8, -1, ""});

  Result best = finished("box", "photon", {"photons", 20000}, 1, 0.0125);
  best.wall_seconds = 4.5;
  best.image = "box-photon.exr";
  best.pictures = {{"image", "box.png"}, {"flip", "box-flip.png"}, {"error", "box-error.png"}};
  Result late = sample_result("box", "povray", {"quality", 2}, 1);
  late.status = Status::timeout;
  late.detail = "killed after 10 s (limit)";
  late.peak_bytes.reset();
  Result busy = finished("box", "povray", {"quality", 1}, 1, 0.25);
  busy.caveats = {"host was busy (load 3.1)"};
  Result hole = finished("hole", "photon", {"photons", 2000}, 1, 0.5);
  hole.metrics.clear();
  results.results = {reference, best, late, finished("box", "photon", {"photons", 2000}, 1, 0.05), busy, hole};
  return results;
}

inline Convergence sample_curve() {
  Convergence curve;
  curve.scene = "box";
  curve.engine = "photon";
  ConvergencePoint early, late;
  early.budget = {"photons", 2000};
  early.seconds = {1.25, Interval{1.2, 1.5}};
  early.relmse = Estimate{0.05, Interval{0.04, 0.0625}};
  late.budget = {"photons", 20000};
  late.seconds = {4.5, {}};
  late.relmse = Estimate{0.0125, Interval{0.01, 0.02}};
  late.variance = Estimate{0.0126, {}};
  early.seeds = late.seeds = 3;
  early.undefined = {{"bias2", "an image is missing"}, {"variance", "an image is missing"}};
  late.undefined = {{"bias2", "none seen above 0.0005"}};
  early.correctness = CorrectnessRecord{Correctness::noisy,
                                        "too noisy to tell: 12 % could hide overall, bound 2 %",
                                        Estimate{0.01, Interval{-0.11, 0.13}},
                                        {},
                                        {}};
  late.correctness = CorrectnessRecord{Correctness::biased,
                                       "the whole image is off: R +1.2 % G +1 % B +0.9 %",
                                       Estimate{0.012, Interval{0.008, 0.016}},
                                       {},
                                       {}};
  curve.points = {early, late};
  curve.slope = Estimate{-1.08, Interval{-1.2, -0.9}};
  curve.efficiency = Estimate{17.8, {}};
  curve.targets = {{0.025, Estimate{2.4, Interval{2, 3}}}, {0.001, {}, 8.0}};
  curve.caveats = {"three seeds are few"};
  return curve;
}

/// One gate that passes, one that fails in two tiles, one that is open.
inline std::vector<GateRecord> sample_gates() {
  GateRecord pass;
  pass.name = "box-photon-relmse";
  pass.scene = "box";
  pass.engine = "photon";
  pass.metric = "relmse";
  pass.verdict = GateVerdict::pass;
  pass.sentence = "relmse 0.0125 is below 0.02";
  pass.observed = Estimate{0.0125, Interval{0.012, 0.013}};
  pass.bound = 0.02;
  pass.alpha = 0.001;
  pass.looks = 2;
  pass.samples = 128;
  pass.seconds = 0.75;
  pass.skipped = {"caustic pass: no specular surface"};
  pass.command = "photonproof gate gates.toml --gate box-photon-relmse";
  GateRecord fail = pass;
  fail.name = "hole-photon-agreement";
  fail.scene = "hole";
  fail.metric = "agreement";
  fail.verdict = GateVerdict::fail;
  fail.sentence = "ring at the floor's contact: +6 % bias, 41 px";
  fail.observed = Estimate{1e-9, {}};
  fail.bound.reset();
  fail.tiles = {{0, 4, 4, 4, 12.5, "+6 % at the floor's contact, 13 px"}, {4, 4, 4, 4, 7.25, "+4 % right of it, 9 px"}};
  fail.pictures = {{"image", "hole.png"}, {"error", "hole-error.png"}};
  fail.command = "photonproof gate gates.toml --gate hole-photon-agreement";
  GateRecord open = pass;
  open.name = "box-povray-ssim";
  open.engine = "povray";
  open.metric = "ssim";
  open.verdict = GateVerdict::inconclusive;
  open.sentence = "ssim 0.97 [0.96, 0.98] holds the bound 0.975 after 8 looks";
  open.observed = Estimate{0.97, Interval{0.96, 0.98}};
  open.bound = 0.975;
  return {pass, fail, open};
}

inline std::vector<ChangeRecord> sample_changes() {
  ChangeRecord same;
  same.scene = "box";
  same.engine = "photon";
  same.budget = {"photons", 2000};
  same.quantity = "relmse";
  same.ratio = {1.01, Interval{0.98, 1.04}};
  same.change = Change::unchanged;
  same.sentence = "relmse as before";
  ChangeRecord slower = same;
  slower.budget.amount = 20000;
  slower.quantity = "seconds";
  slower.ratio = {1.06, Interval{1.04, 1.09}};
  slower.control = Interval{0.99, 1.01};
  slower.change = Change::regression;
  slower.sentence = "6 % slower";
  return {same, slower};
}

/// A race with a value, a ratio and a bound that leaves the order open, and one that is not judged.
inline std::vector<RaceRecord> sample_races() {
  RaceRecord race;
  race.scene = "box";
  race.relmse = 0.05;
  race.times = {
      {.engine = "photon", .seconds = 1.25, .interval = Interval{1.2, 1.3}},
      {.engine = "path", .seconds = 12.5, .interval = Interval{12, 13}, .ratio = Estimate{10, Interval{9, 11}}},
      {.engine = "povray", .seconds = 2.5, .at_most = true, .unranked = true}};
  race.seconds = 2;
  race.errors = {{"photon", {0.03, {}}, {}}, {"path", {0.24, Interval{0.2, 0.3}}, Estimate{8, Interval{7, 9}}}};
  RaceRecord open;
  open.scene = "hole";
  open.undecided = "the measured errors decide no order: photon 0.2, povray 0.1";
  return {race, open};
}

/// Extends sample_results by all possible conclusions of the harness: curves over seeds, gates with one that fails in
/// two tiles, a stored reference, changes against an older run.
inline Results sample_conclusions() {
  Results results = sample_results();
  results.caveats = {"the control's interval excludes 1: this machine is noisy"};
  results.scenes[1].reference =
      ReferenceRecord{"hole/reference-8x8.exr",
                      "",
                      "hole-ref.png",
                      {{"estimator", "path"}, {"samples", "65536"}, {"standard_error", "0.1 %"}}};
  results.convergence = {sample_curve()};
  results.races = sample_races();
  results.gates = sample_gates();
  results.changes = sample_changes();
  return results;
}

/// The PNGs the samples name, 8 x 8.
inline void write_sample_pictures(const std::filesystem::path& folder) {
  Image image(8, 8);
  for (std::size_t i = 0; i < image.rgb.size(); ++i) image.rgb[i] = static_cast<float>(i % 7) / 7;
  for (const char* name :
       {"box-ref.png", "box.png", "box-flip.png", "box-error.png", "hole-ref.png", "hole.png", "hole-error.png"}) {
    write_png((folder / name).string(), image);
  }
}

inline std::size_t count(const std::string& text, const std::string& what) {
  std::size_t n = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + what.size())) ++n;
  return n;
}

inline std::string file_text(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Compares with reports/snapshots/<name>; see the README there for how to renew it.
inline void expect_snapshot(const std::string& name, const std::string& text) {
  const std::filesystem::path path = std::filesystem::path(PHOTONPROOF_SOURCE_DIR) / "reports" / "snapshots" / name;
  if (std::getenv("PHOTONPROOF_UPDATE_SNAPSHOTS")) {
    std::ofstream(path, std::ios::binary) << text;
    GTEST_SKIP() << "wrote " << path << ": read its diff before committing it";
  }
  const std::string expected = file_text(path);
  ASSERT_FALSE(expected.empty()) << path << " is missing";
  const auto [at, other] = std::mismatch(expected.begin(), expected.end(), text.begin(), text.end());
  const auto around = [](const std::string& whole, std::size_t offset) {
    return whole.substr(offset < 200 ? 0 : offset - 200, 400);
  };
  EXPECT_TRUE(expected == text) << path << " differs from here on:\n--- snapshot\n"
                                << around(expected, static_cast<std::size_t>(at - expected.begin())) << "\n--- report\n"
                                << around(text, static_cast<std::size_t>(other - text.begin()));
}

}  // namespace photonproof::reports::inline reports_view
