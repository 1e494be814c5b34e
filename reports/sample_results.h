// A small record for tests: made up, but with everything a report has to show.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "harness/results.h"
#include "reports/temporary_folder.h"
#include "scenes/image.h"

namespace photonproof::reports {

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

/// The PNGs sample_results names, 8 x 8.
inline void write_sample_pictures(const std::filesystem::path& folder) {
  Image image(8, 8);
  for (std::size_t i = 0; i < image.rgb.size(); ++i) image.rgb[i] = static_cast<float>(i % 7) / 7;
  for (const char* name : {"box-ref.png", "box.png", "box-flip.png", "box-error.png"}) {
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

}  // namespace photonproof::reports
