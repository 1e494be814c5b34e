#include "harness/stress/faults/work.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "harness/statistics/batch_means.h"
#include "harness/stress/faults/work_inputs.h"
#include "reference/store/reference_store.h"
#include "reports/record/results.h"
#include "scenes/base/input_error.h"
#include "scenes/base/process.h"
#include "scenes/base/size_text.h"
#include "scenes/files/atomic_file.h"
#include "scenes/files/file_checksum.h"

namespace photonproof::inline harness_stress_faults {
namespace {

namespace fs = std::filesystem;

std::string scene_of(const WorkPlace& place) { return (place.inputs / "scene" / "scene.xml").string(); }

/// Keeps references and verdicts in the work's folder and not in the user's cache.
std::vector<std::string> command_of(const WorkPlace& place, std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), place.program.string());
  return with_environment({"PHOTONPROOF_CACHE=" + (place.out / "cache").string()}, arguments);
}

nlohmann::ordered_json json_of(const fs::path& file) {
  auto json = nlohmann::ordered_json::parse(read_file(file), nullptr, false);
  if (!json.is_object()) throw InputError(file.string(), "is damaged: no JSON");
  return json;
}

std::string existing_checksum(const fs::path& file) {
  if (!fs::exists(file)) throw InputError(file.string(), "is missing");
  return file_checksum(file);
}

/// Cells with a result, as bench, gate and grade keep them: cells/<key>-<n>/cell.json, written last.
FinishedParts finished_cells(const fs::path& out) {
  FinishedParts parts;
  std::error_code error;
  for (fs::directory_iterator cell(out / "cells", error), none; !error && cell != none; cell.increment(error)) {
    const fs::path record = cell->path() / "cell.json";
    if (!fs::exists(record)) continue;
    const auto json = json_of(record);
    // The `status` is from bench and gate, the `end` from grade. A cell that a full disk ended does not count.
    const auto& result = json.contains("result") ? json["result"] : json;
    const std::string end = result.value("status", result.value("end", ""));
    std::string images;
    if (const fs::path image = cell->path() / "image.exr"; fs::exists(image)) images = file_checksum(image);
    if (end == "ok") parts[cell->path().filename().string()] = images;
  }
  return parts;
}

FinishedParts finished_with_record(const WorkPlace& place) {
  if (fs::exists(place.out / "results.json")) read_results((place.out / "results.json").string());
  return finished_cells(place.out);
}

std::string bench_result(const WorkPlace& place) {
  const Results results = read_results((place.out / "results.json").string());
  std::set<std::string> lines;
  for (const Result& result : results.results) {
    std::string line = result.cell.label() + " " + to_string(result.status) + " " + result.image_checksum;
    for (const MetricValue& metric : result.metrics) line += fmt::format(" {}={}", metric.name, metric.value);
    lines.insert(line);
  }
  return fmt::format("{}\n", fmt::join(lines, "\n"));
}

std::string gate_result(const WorkPlace& place) {
  std::string text;
  for (const GateRecord& gate : read_results((place.out / "results.json").string()).gates)
    text += fmt::format("{} {} {} samples {} looks: {}\n", gate.name, to_string(gate.verdict), gate.samples, gate.looks,
                        gate.sentence);
  return text;
}

FinishedParts finished_grades(const WorkPlace& place) {
  if (fs::exists(place.out / "grades.json")) json_of(place.out / "grades.json");
  return finished_cells(place.out);
}

/// The state of a reference that is rendered in batches.
FinishedParts finished_batches(const WorkPlace& place) {
  FinishedParts parts;
  std::error_code error;
  for (fs::recursive_directory_iterator file(place.out / "cache", error), none; !error && file != none;
       file.increment(error)) {
    if (file->path().filename() != "batches") continue;
    const int batches = BatchMeans::load(file->path()).batches();
    for (int i = 1; i <= batches; ++i) parts[fmt::format("batch {}", i)] = "";
  }
  return parts;
}

Work render_work(const std::string& integrator, int spp) {
  Work work;
  work.name = "render " + integrator;
  const auto image = [](const WorkPlace& place) { return place.out / "image.exr"; };
  work.command = [=](const WorkPlace& place) {
    return command_of(
        place, {"render", scene_of(place), "-o", image(place).string(), "--integrator", integrator, "--size", "32x32",
                "--spp", std::to_string(spp), "--threads", "1", "--checkpoint", "0.02", "--resume", "--quiet"});
  };
  work.finished = [=](const WorkPlace& place) {
    const fs::path file = image(place);
    return fs::exists(file) || fs::exists(file.string() + ".checkpoint") ? FinishedParts{{"some of the samples", ""}}
                                                                         : FinishedParts{};
  };
  work.result = [=](const WorkPlace& place) {
    if (fs::exists(image(place).string() + ".checkpoint"))
      throw InputError(image(place).string() + ".checkpoint", "is there though the render is complete");
    return "image " + existing_checksum(image(place)) + "\n";
  };
  return work;
}

std::vector<Work> all_works() {
  std::vector<Work> all;
  all.push_back({"bench",
                 [](const WorkPlace& place) {
                   return command_of(place, {"bench", (place.inputs / "bench.toml").string(), "-o", place.out.string(),
                                             "--retry", "--no-report"});
                 },
                 finished_with_record, bench_result});
  all.push_back({"gate",
                 [](const WorkPlace& place) {
                   return command_of(place, {"gate", (place.inputs / "gates.toml").string(), "-o", place.out.string(),
                                             "--fresh", "--resume", "--no-report"});
                 },
                 finished_with_record, gate_result});
  all.push_back(
      {"reference",
       [](const WorkPlace& place) {
         return command_of(
             place, {"reference", scene_of(place), "--size", size_text(work_width, work_height), "--standard-error",
                     "0.05", "-o", (place.out / "reference.exr").string(), "--quiet"});
       },
       finished_batches,
       [](const WorkPlace& place) { return "reference " + existing_checksum(place.out / "reference.exr") + "\n"; }});
  all.push_back({"grade",
                 [](const WorkPlace& place) {
                   return command_of(place, {"grade", (place.inputs / "course.toml").string(),
                                             (place.inputs / "handout").string(), (place.inputs / "pupil").string(),
                                             "-o", place.out.string(), "--no-sandbox", "--no-timing", "--resume"});
                 },
                 finished_grades, [](const WorkPlace& place) { return read_file(place.out / "gradebook.csv"); }});
  all.push_back(render_work("path", 4096));
  all.push_back(render_work("photonmapper", 512));
  all.push_back(render_work("bdpt", 512));
  return all;
}

}  // namespace

const std::vector<Work>& works() {
  static const std::vector<Work> all = all_works();
  return all;
}

void prepare_works(const fs::path& program, const fs::path& inputs) {
  fs::create_directories(inputs);
  write_work_inputs(inputs);
  const fs::path scene = inputs / "scene" / "scene.xml";
  if (fs::exists(committed_reference_path(scene, work_width, work_height))) return;
  const ProcessOutcome outcome = run_process(
      with_environment({"PHOTONPROOF_CACHE=" + (inputs / "cache").string()},
                       {program.string(), "reference", scene.string(), "--size", size_text(work_width, work_height),
                        "--standard-error", "0.05", "--commit", "--quiet"}),
      {.wall_limit_seconds = 300});
  if (!outcome.ok())
    throw InputError(program.string(), "cannot render the reference of the faults: " + outcome.sentence() + ": " +
                                           last_line(outcome.standard_error));
}

std::vector<std::string> finished_twice(const FinishedParts& parts) {
  std::vector<std::string> twice;
  std::set<std::string> keys;
  for (const auto& [name, checksum] : parts)
    if (!keys.insert(name.substr(0, name.rfind('-'))).second) twice.push_back(name);
  return twice;
}

std::vector<std::string> with_environment(const std::vector<std::string>& variables,
                                          const std::vector<std::string>& command) {
  std::vector<std::string> words{"env"};
  words.insert(words.end(), variables.begin(), variables.end());
  words.insert(words.end(), command.begin(), command.end());
  return words;
}

}  // namespace photonproof::inline harness_stress_faults
