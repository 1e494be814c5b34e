#include "reports/grades/grades_json.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "reports/record/file_inside.h"
#include "scenes/base/input_error.h"

namespace photonproof::inline reports_grades {
namespace {

using Json = nlohmann::ordered_json;

double number_of(double value) {
  if (!std::isfinite(value)) throw std::logic_error("a grade's number is not finite");
  return value;
}

Json estimate_json(const Estimate& estimate) {
  Json json = {{"value", number_of(estimate.value)}};
  if (estimate.interval) json["interval"] = {number_of(estimate.interval->low), number_of(estimate.interval->high)};
  return json;
}

Estimate estimate_of(const Json& json) {
  Estimate estimate{json.at("value").get<double>(), {}};
  if (json.contains("interval")) estimate.interval = {json["interval"].at(0), json["interval"].at(1)};
  return estimate;
}

Json check_json(const GradedCheck& check) {
  return {{"metric", check.metric},         {"value", estimate_json(check.value)}, {"bound", number_of(check.bound)},
          {"parameters", check.parameters}, {"side", to_string(check.side)},       {"sentence", check.sentence}};
}

GradedCheck check_of(const Json& json) {
  GradedCheck check;
  check.metric = json.at("metric");
  check.value = estimate_of(json.at("value"));
  check.bound = json.at("bound");
  check.parameters = json.at("parameters");
  check.sentence = json.at("sentence");
  for (const auto side : {GradedCheck::Side::inside, GradedCheck::Side::outside, GradedCheck::Side::undecided})
    if (json.at("side") == to_string(side)) check.side = side;
  return check;
}

Json finding_json(const GradedFinding& finding) {
  return {{"kind", finding.kind},
          {"sentence", finding.sentence},
          {"cause", finding.cause},
          {"where", {finding.x, finding.y, finding.width, finding.height}},
          {"explained", number_of(finding.explained)}};
}

GradedFinding finding_of(const Json& json) {
  const Json& where = json.at("where");
  return {json.at("kind"), json.at("sentence"), json.at("cause"), where.at(0),
          where.at(1),     where.at(2),         where.at(3),      json.at("explained")};
}

Json scene_grade_json(const SceneGrade& grade) {
  Json json = {{"scene", grade.scene},       {"verdict", to_string(grade.verdict)},
               {"sentence", grade.sentence}, {"points", number_of(grade.points)},
               {"checks", Json::array()},    {"findings", Json::array()},
               {"runs", Json::array()},      {"pictures", grade.pictures}};
  if (grade.partial > 0) json["partial"] = grade.partial;
  for (const GradedCheck& check : grade.checks) json["checks"].push_back(check_json(check));
  for (const GradedFinding& finding : grade.findings) json["findings"].push_back(finding_json(finding));
  for (const GradedRun& run : grade.runs) json["runs"].push_back(run_to_json(run));
  return json;
}

SceneGrade scene_grade_of(const Json& json) {
  SceneGrade grade;
  grade.scene = json.at("scene");
  grade.verdict = scene_verdict_from(json.at("verdict"));
  grade.sentence = json.at("sentence");
  grade.points = json.at("points");
  grade.partial = json.value("partial", 0.0);
  for (const Json& check : json.at("checks")) grade.checks.push_back(check_of(check));
  for (const Json& finding : json.at("findings")) grade.findings.push_back(finding_of(finding));
  for (const Json& run : json.at("runs")) grade.runs.push_back(run_from_json(run));
  grade.pictures = files_inside(json.at("pictures"));
  return grade;
}

Json speed_json(const SpeedGrade& speed) {
  Json json = {{"state", to_string(speed.state)},
               {"sentence", speed.sentence},
               {"points", number_of(speed.points)},
               {"rounds", speed.rounds}};
  if (!speed.scenes.empty() || speed.state == SpeedGrade::State::measured)
    json["speedup"] = estimate_json(speed.speedup);
  for (const SceneSpeed& scene : speed.scenes)
    json["scenes"].push_back({{"scene", scene.scene},
                              {"ratio", estimate_json(scene.ratio)},
                              {"baseline_seconds", scene.baseline_seconds},
                              {"seconds", scene.seconds},
                              {"busy_cores_of_others", scene.busy}});
  return json;
}

SpeedGrade speed_of(const Json& json) {
  SpeedGrade speed;
  using State = SpeedGrade::State;
  for (const State state : {State::none, State::not_right, State::measured, State::too_noisy, State::changed})
    if (json.at("state") == to_string(state)) speed.state = state;
  speed.sentence = json.at("sentence");
  speed.points = json.at("points");
  speed.rounds = json.at("rounds");
  if (json.contains("speedup")) speed.speedup = estimate_of(json.at("speedup"));
  if (!json.contains("scenes")) return speed;
  for (const Json& scene : json["scenes"])
    speed.scenes.push_back({scene.at("scene"), estimate_of(scene.at("ratio")), scene.at("baseline_seconds"),
                            scene.at("seconds"), scene.at("busy_cores_of_others")});
  return speed;
}

Json submission_json(const SubmissionGrade& grade) {
  Json json = {{"name", grade.name},
               {"folder", grade.folder},
               {"source", grade.source},
               {"checksum", grade.checksum},
               {"points", number_of(grade.points())},
               {"correctness_points", number_of(grade.correctness_points)},
               {"sentence", grade.sentence},
               {"build",
                {{"ok", grade.built},
                 {"sentence", grade.build_sentence},
                 {"log", grade.build_log},
                 {"seconds", number_of(grade.build_seconds)}}},
               {"scenes", Json::array()},
               {"speed", speed_json(grade.speed)},
               {"flags", Json::array()}};
  for (const SceneGrade& scene : grade.scenes) json["scenes"].push_back(scene_grade_json(scene));
  for (const GradeFlag& flag : grade.flags)
    json["flags"].push_back(
        {{"kind", flag.kind}, {"sentence", flag.sentence}, {"scene", flag.scene}, {"other", flag.other}});
  return json;
}

SubmissionGrade submission_of(const Json& json) {
  SubmissionGrade grade;
  grade.name = json.at("name");
  grade.folder = json.at("folder");
  grade.source = json.at("source");
  grade.checksum = json.at("checksum");
  grade.correctness_points = json.at("correctness_points");
  grade.sentence = json.at("sentence");
  const Json& build = json.at("build");
  grade.built = build.at("ok");
  grade.build_sentence = build.at("sentence");
  grade.build_log = build.at("log");
  grade.build_seconds = build.at("seconds");
  for (const Json& scene : json.at("scenes")) grade.scenes.push_back(scene_grade_of(scene));
  grade.speed = speed_of(json.at("speed"));
  for (const Json& flag : json.at("flags"))
    grade.flags.push_back({flag.at("kind"), flag.at("sentence"), flag.at("scene"), flag.at("other")});
  return grade;
}

Json scene_json(const GradedScene& scene) {
  return {{"name", scene.name},
          {"hidden", scene.hidden},
          {"timed", scene.timed},
          {"max_points", number_of(scene.max_points)},
          {"width", scene.width},
          {"height", scene.height},
          {"of", scene.of},
          {"variant", scene.variant},
          {"says", scene.says},
          {"reference", scene.reference},
          {"image", scene.reference_image},
          {"picture", scene.reference_picture},
          {"unused", scene.unused}};
}

GradedScene graded_scene_of(const Json& json) {
  GradedScene scene;
  scene.name = json.at("name");
  scene.hidden = json.at("hidden");
  scene.timed = json.at("timed");
  scene.max_points = json.at("max_points");
  scene.width = json.at("width");
  scene.height = json.at("height");
  scene.of = json.at("of");
  scene.variant = json.at("variant");
  scene.says = json.at("says");
  scene.reference = json.at("reference");
  scene.reference_image = file_inside(json.at("image"));
  scene.reference_picture = file_inside(json.at("picture"));
  scene.unused = json.at("unused");
  return scene;
}

Json tier_json(const SpeedTier& tier) { return {{"ratio", number_of(tier.ratio)}, {"points", number_of(tier.points)}}; }

SpeedTier tier_of(const Json& json) { return {json.at("ratio"), json.at("points")}; }

Json host_json(const Host& host) {
  return {{"cpu", host.cpu},
          {"os", host.os},
          {"kernel", host.kernel},
          {"cores", host.cores},
          {"memory_bytes", host.memory_bytes}};
}

}  // namespace

nlohmann::ordered_json run_to_json(const GradedRun& run) {
  return {{"seed", run.seed},
          {"end", run.end},
          {"sentence", run.sentence},
          {"wall_seconds", number_of(run.wall_seconds)},
          {"cpu_seconds", number_of(run.cpu_seconds)},
          {"peak_bytes", run.peak_bytes},
          {"image", run.image},
          {"checksum", run.checksum},
          {"log", run.log_tail}};
}

GradedRun run_from_json(const nlohmann::ordered_json& json) {
  return {json.at("seed"),        json.at("end"),        json.at("sentence"),           json.at("wall_seconds"),
          json.at("cpu_seconds"), json.at("peak_bytes"), file_inside(json.at("image")), json.at("checksum"),
          json.at("log")};
}

Json grades_to_json(const Grades& grades) {
  Json json = {{"grades_version", grades_version},
               {"assignment", grades.assignment},
               {"title", grades.title},
               {"created", grades.created},
               {"command", grades.command},
               {"host", host_json(grades.host)},
               {"versions", grades.versions},
               {"seed", grades.seed},
               {"contained", grades.contained},
               {"containment", grades.containment},
               {"correctness_points", number_of(grades.correctness_points)},
               {"speed_points", number_of(grades.speed_points)},
               {"speed_rule", grades.speed_rule},
               {"speed_tiers", Json::array()},
               {"speed_curve", nullptr},
               {"interrupted", grades.interrupted},
               {"caveats", grades.caveats},
               {"scenes", Json::array()},
               {"submissions", Json::array()}};
  for (const SpeedTier& tier : grades.speed_tiers) json["speed_tiers"].push_back(tier_json(tier));
  if (grades.speed_curve) json["speed_curve"] = tier_json(*grades.speed_curve);
  for (const GradedScene& scene : grades.scenes) json["scenes"].push_back(scene_json(scene));
  for (const SubmissionGrade& submission : grades.submissions)
    json["submissions"].push_back(submission_json(submission));
  return json;
}

namespace {

void refuse_links_outside_of(const std::filesystem::path& folder, const Grades& grades) {
  for (const GradedScene& scene : grades.scenes) {
    refuse_link_outside(folder, scene.reference_image);
    refuse_link_outside(folder, scene.reference_picture);
  }
  for (const SubmissionGrade& submission : grades.submissions)
    for (const SceneGrade& scene : submission.scenes) {
      refuse_links_outside(folder, scene.pictures);
      for (const GradedRun& run : scene.runs) refuse_link_outside(folder, run.image);
    }
}

}  // namespace

Grades grades_from_json(const Json& json, const std::string& file) try {
  if (json.at("grades_version") != grades_version)
    throw InputError(file, "is of another version than " + std::to_string(grades_version));
  Grades grades;
  grades.assignment = json.at("assignment");
  grades.title = json.at("title");
  grades.created = json.at("created");
  grades.command = json.at("command");
  const Json& host = json.at("host");
  grades.host = {host.at("cpu"), host.at("os"), host.at("kernel"), host.at("cores"), host.at("memory_bytes")};
  grades.versions = json.at("versions").get<std::map<std::string, std::string>>();
  grades.seed = json.at("seed");
  grades.contained = json.at("contained");
  grades.containment = json.at("containment");
  grades.correctness_points = json.at("correctness_points");
  grades.speed_points = json.at("speed_points");
  grades.speed_rule = json.at("speed_rule");
  for (const Json& tier : json.at("speed_tiers")) grades.speed_tiers.push_back(tier_of(tier));
  if (const Json& curve = json.at("speed_curve"); !curve.is_null()) grades.speed_curve = tier_of(curve);
  grades.interrupted = json.at("interrupted");
  grades.caveats = json.at("caveats").get<std::vector<std::string>>();
  for (const Json& scene : json.at("scenes")) grades.scenes.push_back(graded_scene_of(scene));
  for (const Json& submission : json.at("submissions")) grades.submissions.push_back(submission_of(submission));
  refuse_links_outside_of(std::filesystem::absolute(file).parent_path(), grades);
  return grades;
} catch (const nlohmann::json::exception& problem) {
  throw InputError(file, "is no record of a grading: " + std::string(problem.what()));
}

}  // namespace photonproof::inline reports_grades
