#include "reports/record/results_json.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "reports/record/file_inside.h"
#include "reports/record/results_json_parts.h"

namespace photonproof::inline reports_record {
namespace {

using nlohmann::json;

json numbers_to_json(const std::map<std::string, double>& numbers, const std::string& what) {
  json object = json::object();
  for (const auto& [name, value] : numbers) object[name] = finite(value, what);
  return object;
}

json cell_to_json(const Cell& cell) {
  return {{"scene", cell.scene}, {"engine", cell.engine}, {"budget", budget_to_json(cell.budget)}, {"seed", cell.seed}};
}

Cell cell_from_json(const json& j) {
  return {j.at("scene"), j.at("engine"), budget_from_json(j.at("budget")), j.at("seed")};
}

json scene_to_json(const SceneRecord& scene) {
  json j = {{"name", scene.name},
            {"path", scene.path},
            {"purpose", scene.purpose},
            {"width", scene.width},
            {"height", scene.height},
            {"exposure", finite(scene.exposure, "exposure")},
            {"reference_label", scene.reference_label}};
  if (const auto& reference = scene.reference)
    j["reference"] = {{"file", reference->file},
                      {"image", reference->image},
                      {"picture", reference->picture},
                      {"provenance", reference->provenance}};
  if (!scene.reference_doubt.empty()) j["reference_doubt"] = scene.reference_doubt;
  if (const auto& range = scene.hdr_exposures)
    j["hdr_flip_exposures"] = {{"start", finite(range->start, "first exposure")},
                               {"stop", finite(range->stop, "last exposure")},
                               {"count", range->count}};
  return j;
}

SceneRecord scene_from_json(const json& j) {
  SceneRecord scene{j.at("name"),   j.at("path"),     j.at("purpose"),        j.at("width"),
                    j.at("height"), j.at("exposure"), j.at("reference_label")};
  if (const auto found = j.find("reference"); found != j.end())
    scene.reference =
        ReferenceRecord{found->at("file"), file_inside(found->at("image")), file_inside(found->at("picture")),
                        found->at("provenance").get<std::map<std::string, std::string>>()};
  if (const auto found = j.find("hdr_flip_exposures"); found != j.end())
    scene.hdr_exposures = ExposureRange{found->at("start"), found->at("stop"), found->at("count")};
  scene.reference_doubt = j.value("reference_doubt", "");
  return scene;
}

json engine_to_json(const EngineRecord& engine) {
  json j = {{"name", engine.name}, {"title", engine.title}, {"version", engine.version}};
  if (!engine.trust.empty()) j["trust"] = engine.trust;
  return j;
}

json host_to_json(const Host& host) {
  return {{"cpu", host.cpu},
          {"os", host.os},
          {"kernel", host.kernel},
          {"cores", host.cores},
          {"memory_bytes", host.memory_bytes}};
}

Host host_from_json(const json& j) {
  return {j.at("cpu"), j.at("os"), j.at("kernel"), j.at("cores"), j.at("memory_bytes")};
}

json calibration_to_json(const CalibrationReading& reading) {
  return {{"workload", reading.workload},
          {"threads", reading.threads},
          {"seconds", finite(reading.seconds, "calibration")}};
}

CalibrationReading calibration_from_json(const json& j) { return {j.at("workload"), j.at("threads"), j.at("seconds")}; }

}  // namespace

double finite(double value, const std::string& what) {
  if (!std::isfinite(value)) throw std::logic_error("a result's " + what + " is not finite");
  return value;
}

json budget_to_json(const Budget& budget) {
  return {{"kind", budget.kind}, {"amount", finite(budget.amount, "budget")}};
}

Budget budget_from_json(const json& j) { return {j.at("kind"), j.at("amount")}; }

json result_to_json(const Result& result) {
  json metrics = json::array();
  for (const MetricValue& metric : result.metrics)
    metrics.push_back({{"name", metric.name},
                       {"value", finite(metric.value, "metric '" + metric.name + "'")},
                       {"parameters", metric.parameters}});
  json j = {{"cell", cell_to_json(result.cell)},
            {"key", result.key},
            {"status", to_string(result.status)},
            {"detail", result.detail},
            {"metrics", std::move(metrics)},
            {"image", result.image},
            {"pictures", result.pictures},
            {"phases", numbers_to_json(result.phases, "phase")},
            {"counts", numbers_to_json(result.counts, "count")},
            {"skipped", result.skipped},
            {"engine_version", result.engine_version},
            {"command", result.command},
            {"caveats", result.caveats}};
  if (!result.image_checksum.empty()) j["image_checksum"] = result.image_checksum;
  if (result.wall_seconds) j["wall_seconds"] = finite(*result.wall_seconds, "wall time");
  if (result.cpu_seconds) j["cpu_seconds"] = finite(*result.cpu_seconds, "CPU time");
  if (result.peak_bytes) j["peak_bytes"] = *result.peak_bytes;
  if (result.instructions) j["instructions"] = *result.instructions;
  if (result.calibration) j["calibration"] = calibration_to_json(*result.calibration);
  return j;
}

Result result_from_json(const json& j) {
  Result result;
  result.cell = cell_from_json(j.at("cell"));
  result.key = j.at("key");
  result.status = status_from_string(j.at("status"));
  result.detail = j.at("detail");
  result.wall_seconds = optional_at<double>(j, "wall_seconds");
  result.cpu_seconds = optional_at<double>(j, "cpu_seconds");
  result.peak_bytes = optional_at<std::uint64_t>(j, "peak_bytes");
  result.instructions = optional_at<std::uint64_t>(j, "instructions");
  if (const auto found = j.find("calibration"); found != j.end()) result.calibration = calibration_from_json(*found);
  for (const json& metric : j.at("metrics"))
    result.metrics.push_back({metric.at("name"), metric.at("value"), metric.at("parameters")});
  result.image = file_inside(j.at("image"));
  result.image_checksum = j.value("image_checksum", std::string());
  result.pictures = files_inside(j.at("pictures"));
  result.phases = j.at("phases").get<std::map<std::string, double>>();
  result.counts = j.at("counts").get<std::map<std::string, double>>();
  result.skipped = j.at("skipped").get<std::vector<std::string>>();
  result.engine_version = j.at("engine_version");
  result.command = j.at("command");
  result.caveats = j.at("caveats").get<std::vector<std::string>>();
  return result;
}

json results_to_json(const Results& results) {
  json scenes = json::array(), engines = json::array(), rows = json::array();
  for (const SceneRecord& scene : results.scenes) scenes.push_back(scene_to_json(scene));
  for (const EngineRecord& engine : results.engines) engines.push_back(engine_to_json(engine));
  for (const Result& result : results.results) rows.push_back(result_to_json(result));
  json document = {{"schema_version", results_schema_version},
                   {"suite", results.suite},
                   {"created", results.created},
                   {"command", results.command},
                   {"host", host_to_json(results.host)},
                   {"versions", results.versions},
                   {"scenes", std::move(scenes)},
                   {"engines", std::move(engines)},
                   {"results", std::move(rows)}};
  if (!results.title.empty()) document["title"] = results.title;
  conclusions_to_json(results, document);
  return document;
}

Results results_from_json(const json& j) {
  Results results;
  results.suite = j.at("suite");
  results.title = j.value("title", "");
  results.created = j.at("created");
  results.command = j.at("command");
  results.host = host_from_json(j.at("host"));
  results.versions = j.at("versions").get<std::map<std::string, std::string>>();
  for (const json& scene : j.at("scenes")) results.scenes.push_back(scene_from_json(scene));
  for (const json& engine : j.at("engines"))
    results.engines.push_back(
        {engine.at("name"), engine.at("title"), engine.at("version"), engine.value("trust", std::string())});
  for (const json& result : j.at("results")) results.results.push_back(result_from_json(result));
  conclusions_from_json(j, results);
  return results;
}

}  // namespace photonproof::inline reports_record
