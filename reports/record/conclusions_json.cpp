// The conclusions in results.json: convergence, gates, changes against an older run.

#include <array>

#include "reports/record/file_inside.h"
#include "reports/record/results_json_parts.h"

namespace photonproof::inline reports_record {
namespace {

using nlohmann::json;

json interval_to_json(const Interval& interval) {
  return json::array({finite(interval.low, "interval"), finite(interval.high, "interval")});
}

Interval interval_from_json(const json& j) { return {j.at(0), j.at(1)}; }

json estimate_to_json(const Estimate& estimate) {
  json j = {{"value", finite(estimate.value, "estimate")}};
  if (estimate.interval) j["interval"] = interval_to_json(*estimate.interval);
  return j;
}

Estimate estimate_from_json(const json& j) {
  Estimate estimate{j.at("value"), {}};
  if (const auto found = j.find("interval"); found != j.end()) estimate.interval = interval_from_json(*found);
  return estimate;
}

void set_estimate(json& j, const char* key, const std::optional<Estimate>& estimate) {
  if (estimate) j[key] = estimate_to_json(*estimate);
}

std::optional<Estimate> optional_estimate(const json& j, const char* key) {
  const auto found = j.find(key);
  return found == j.end() ? std::nullopt : std::optional(estimate_from_json(*found));
}

// The schema has checked that the name is one of them.
template <class Enum, std::size_t N>
Enum from_name(const std::array<Enum, N>& values, const std::string& name) {
  for (const Enum value : values)
    if (to_string(value) == name) return value;
  return values.back();
}

json correctness_to_json(const CorrectnessRecord& record) {
  json j = {{"verdict", to_string(record.verdict)}, {"sentence", record.sentence}};
  set_estimate(j, "whole", record.whole);
  if (record.would_see) j["would_see"] = finite(*record.would_see, "would_see");
  if (record.would_see_in_a_block)
    j["would_see_in_a_block"] = finite(*record.would_see_in_a_block, "would_see_in_a_block");
  if (!record.regression_only.empty()) j["regression_only"] = record.regression_only;
  return j;
}

CorrectnessRecord correctness_from_json(const json& j) {
  using enum Correctness;
  return {from_name(std::array{right, noisy, biased, unknown}, j.at("verdict")),
          j.at("sentence"),
          optional_estimate(j, "whole"),
          optional_at<double>(j, "would_see"),
          optional_at<double>(j, "would_see_in_a_block"),
          j.value("regression_only", "")};
}

void set_reasons(json& j, const Reasons& reasons) {
  if (!reasons.empty()) j["undefined"] = reasons;
}

Reasons reasons_from_json(const json& j) { return j.value("undefined", Reasons{}); }

json point_to_json(const CurvePoint& point) {
  json j = {
      {"budget", budget_to_json(point.budget)}, {"seeds", point.seeds}, {"seconds", estimate_to_json(point.seconds)}};
  set_estimate(j, "relmse", point.relmse);
  set_estimate(j, "bias2", point.bias2);
  set_estimate(j, "variance", point.variance);
  if (point.correctness) j["correctness"] = correctness_to_json(*point.correctness);
  set_reasons(j, point.undefined);
  return j;
}

CurvePoint point_from_json(const json& j) {
  CurvePoint point{budget_from_json(j.at("budget")),    j.at("seeds"),
                   estimate_from_json(j.at("seconds")), optional_estimate(j, "relmse"),
                   optional_estimate(j, "bias2"),       optional_estimate(j, "variance")};
  if (const auto found = j.find("correctness"); found != j.end()) point.correctness = correctness_from_json(*found);
  point.undefined = reasons_from_json(j);
  return point;
}

json target_to_json(const TargetTime& target) {
  json j = {{"relmse", finite(target.relmse, "target")}};
  set_estimate(j, "seconds", target.seconds);
  if (target.more_than) j["more_than"] = finite(*target.more_than, "time to a target");
  if (target.at_most) j["at_most"] = finite(*target.at_most, "time to a target");
  if (!target.undefined.empty()) j["undefined"] = target.undefined;
  return j;
}

TargetTime target_from_json(const json& j) {
  return {j.at("relmse"), optional_estimate(j, "seconds"), optional_at<double>(j, "more_than"),
          optional_at<double>(j, "at_most"), j.value("undefined", "")};
}

json convergence_to_json(const Convergence& curve) {
  json j = {{"scene", curve.scene}, {"engine", curve.engine}, {"caveats", curve.caveats}, {"points", json::array()}};
  if (curve.clock != Clock::wall) j["clock"] = to_string(curve.clock);
  for (const CurvePoint& point : curve.points) j["points"].push_back(point_to_json(point));
  set_estimate(j, "slope", curve.slope);
  set_estimate(j, "efficiency", curve.efficiency);
  for (const TargetTime& target : curve.targets) j["targets"].push_back(target_to_json(target));
  set_reasons(j, curve.undefined);
  return j;
}

Convergence convergence_from_json(const json& j) {
  Convergence curve;
  curve.scene = j.at("scene");
  curve.engine = j.at("engine");
  curve.clock = clock_from_string(j.value("clock", "wall")).value_or(Clock::wall);  // the schema knows no other
  for (const json& point : j.at("points")) curve.points.push_back(point_from_json(point));
  curve.slope = optional_estimate(j, "slope");
  curve.efficiency = optional_estimate(j, "efficiency");
  if (const auto targets = j.find("targets"); targets != j.end())
    for (const json& target : *targets) curve.targets.push_back(target_from_json(target));
  else if (const auto only = j.find("target_relmse"); only != j.end())  // as of version 0.1
    curve.targets.push_back({*only, optional_estimate(j, "seconds_to_target")});
  curve.caveats = j.at("caveats").get<std::vector<std::string>>();
  curve.undefined = reasons_from_json(j);
  return curve;
}

json race_to_json(const RaceRecord& race) {
  json times = json::array();
  for (const RaceRecord::Time& time : race.times) {
    times.push_back({{"engine", time.engine}, {"seconds", finite(time.seconds, "time of a race")}});
    if (time.at_most) times.back()["at_most"] = true;
    if (time.more_than) times.back()["more_than"] = true;
    if (time.unranked) times.back()["unranked"] = true;
  }
  return {{"scene", race.scene}, {"relmse", finite(race.relmse, "error of a race")}, {"times", std::move(times)}};
}

RaceRecord race_from_json(const json& j) {
  RaceRecord race{j.at("scene"), j.at("relmse"), {}};
  for (const json& time : j.at("times"))
    race.times.push_back({time.at("engine"), time.at("seconds"), time.value("at_most", false),
                          time.value("more_than", false), time.value("unranked", false)});
  return race;
}

json gate_to_json(const GateRecord& gate) {
  json tiles = json::array();
  for (const FailingTile& tile : gate.tiles)
    tiles.push_back({{"x", tile.x},
                     {"y", tile.y},
                     {"width", tile.width},
                     {"height", tile.height},
                     {"score", finite(tile.score, "tile score")},
                     {"sentence", tile.sentence}});
  json j = {{"name", gate.name},
            {"scene", gate.scene},
            {"engine", gate.engine},
            {"metric", gate.metric},
            {"verdict", to_string(gate.verdict)},
            {"sentence", gate.sentence},
            {"alpha", finite(gate.alpha, "alpha")},
            {"looks", gate.looks},
            {"samples", gate.samples},
            {"seconds", finite(gate.seconds, "gate time")},
            {"tiles", std::move(tiles)},
            {"image", gate.image},
            {"pictures", gate.pictures},
            {"skipped", gate.skipped},
            {"command", gate.command}};
  set_estimate(j, "observed", gate.observed);
  if (gate.bound) j["bound"] = finite(*gate.bound, "bound");
  if (gate.would_see) j["would_see"] = finite(*gate.would_see, "would_see");
  if (gate.would_see_in_a_block) j["would_see_in_a_block"] = finite(*gate.would_see_in_a_block, "would_see_in_a_block");
  if (gate.status) j["status"] = to_string(*gate.status);
  if (!gate.regression_only.empty()) j["regression_only"] = gate.regression_only;
  if (!gate.accepted.empty()) j["accepted"] = gate.accepted;
  return j;
}

GateRecord gate_from_json(const json& j) {
  using enum GateVerdict;
  GateRecord gate;
  gate.name = j.at("name");
  gate.scene = j.at("scene");
  gate.engine = j.at("engine");
  gate.metric = j.at("metric");
  gate.verdict = from_name(std::array{pass, fail, inconclusive}, j.at("verdict"));
  gate.sentence = j.at("sentence");
  gate.observed = optional_estimate(j, "observed");
  gate.bound = optional_at<double>(j, "bound");
  gate.would_see = optional_at<double>(j, "would_see");
  gate.would_see_in_a_block = optional_at<double>(j, "would_see_in_a_block");
  gate.regression_only = j.value("regression_only", "");
  gate.accepted = j.value("accepted", "");
  if (const auto status = j.find("status"); status != j.end()) gate.status = status_from_string(*status);
  gate.alpha = j.at("alpha");
  gate.looks = j.at("looks");
  gate.samples = j.at("samples");
  gate.seconds = j.at("seconds");
  for (const json& tile : j.at("tiles"))
    gate.tiles.push_back(
        {tile.at("x"), tile.at("y"), tile.at("width"), tile.at("height"), tile.at("score"), tile.at("sentence")});
  gate.image = file_inside(j.at("image"));
  gate.pictures = files_inside(j.at("pictures"));
  gate.skipped = j.at("skipped").get<std::vector<std::string>>();
  gate.command = j.at("command");
  return gate;
}

json change_to_json(const ChangeRecord& record) {
  json j = {{"scene", record.scene},
            {"engine", record.engine},
            {"budget", budget_to_json(record.budget)},
            {"quantity", record.quantity},
            {"ratio", estimate_to_json(record.ratio)},
            {"change", to_string(record.change)},
            {"sentence", record.sentence}};
  if (record.control) j["control"] = interval_to_json(*record.control);
  return j;
}

ChangeRecord change_from_json(const json& j) {
  using enum Change;
  ChangeRecord record;
  record.scene = j.at("scene");
  record.engine = j.at("engine");
  record.budget = budget_from_json(j.at("budget"));
  record.quantity = j.at("quantity");
  record.ratio = estimate_from_json(j.at("ratio"));
  if (const auto found = j.find("control"); found != j.end()) record.control = interval_from_json(*found);
  record.change = from_name(std::array{regression, improvement, unchanged, inconclusive}, j.at("change"));
  record.sentence = j.at("sentence");
  return record;
}

template <class T>
void list_to_json(json& document, const char* key, const std::vector<T>& records, json (*to_json)(const T&)) {
  if (records.empty()) return;
  json list = json::array();
  for (const T& record : records) list.push_back(to_json(record));
  document[key] = std::move(list);
}

template <class T>
void list_from_json(const json& document, const char* key, std::vector<T>& records, T (*from_json)(const json&)) {
  const auto found = document.find(key);
  if (found == document.end()) return;
  for (const json& record : *found) records.push_back(from_json(record));
}

}  // namespace

void conclusions_to_json(const Results& results, json& document) {
  list_to_json(document, "convergence", results.convergence, convergence_to_json);
  list_to_json(document, "races", results.races, race_to_json);
  list_to_json(document, "gates", results.gates, gate_to_json);
  list_to_json(document, "changes", results.changes, change_to_json);
  if (!results.findings.empty()) document["findings"] = results.findings;
  if (!results.caveats.empty()) document["caveats"] = results.caveats;
}

void conclusions_from_json(const json& document, Results& results) {
  list_from_json(document, "convergence", results.convergence, convergence_from_json);
  list_from_json(document, "races", results.races, race_from_json);
  list_from_json(document, "gates", results.gates, gate_from_json);
  list_from_json(document, "changes", results.changes, change_from_json);
  results.findings = document.value("findings", std::vector<std::string>{});
  results.caveats = document.value("caveats", std::vector<std::string>{});
}

}  // namespace photonproof::inline reports_record
