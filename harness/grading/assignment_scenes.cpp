#include <algorithm>
#include <filesystem>

#include "harness/grading/assignment_rows.h"
#include "harness/suites/engine_command.h"
#include "harness/suites/suite_rows.h"

namespace photonproof::inline harness_grading {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> variant_kinds{"mirror",        "rigid-move",   "light-scale", "colour-permutation",
                                             "superposition", "object-order", "resolution",  "crop",
                                             "more-spheres"};

void file_if_given(const TomlTable& table, const char* key, const Assignment& assignment, fs::path& file) {
  if (table.has(key)) file = existing_file(table, key, assignment.folder);
}

// A file may only be put into the run's own folder.
void check_place(const TomlTable& table, const std::string& place) {
  const fs::path path(place);
  const bool leaves =
      path.is_absolute() || std::ranges::any_of(path, [](const fs::path& part) { return part == ".."; });
  if (leaves) throw table.error("params_place", "'params_place' must stay inside the run's folder");
}

void read_variant(const TomlTable& table, const Assignment& assignment, AssignmentScene& scene) {
  const std::string of = table.string("of");
  const AssignmentScene* base = find_named(assignment.scenes, of);
  if (base == nullptr || base->hidden) throw table.error("of", unknown_name("public scene", of, assignment.scenes));
  const std::string name = scene.name;
  scene = *base;
  scene.name = name;
  scene.of = of;
  scene.reference.clear();  // the variant looks different
  scene.given.clear();
  scene.variant = one_of(table, "variant", variant_kinds);
  if (table.has("seed"))
    scene.variant_seed = static_cast<std::uint64_t>(bounded_integer(table, "seed", 0, 1'000'000'000));
}

void read_params(const TomlTable& table, const Assignment& assignment, AssignmentScene& scene) {
  file_if_given(table, "path", assignment, scene.path);
  file_if_given(table, "params", assignment, scene.params);
  file_if_given(table, "params_template", assignment, scene.params_template);
  if (!scene.params.empty() && !scene.params_template.empty() && scene.variant.empty())
    throw table.error("params", "there is a 'params_template' too: one of them makes the scene's file");
  if (!scene.params_template.empty() && scene.path.empty())
    throw table.error("params_template", "'params_template' is filled from the scene's description: 'path' is missing");
  if (table.has("params_place")) check_place(table, scene.params_place = table.string("params_place"));
  const bool has_file = !scene.params.empty() || !scene.params_template.empty();
  if (has_file && scene.params_place.empty())
    throw table.error("'params_place' is missing: where in the run's folder the scene's file is put");
  if (table.has("scene_option"))
    scene.option = table.is_array("scene_option") ? table.strings("scene_option")
                                                  : std::vector<std::string>{table.string("scene_option")};
}

// Checks that the program gets all that it must know of the scene.
void check_needs(const TomlTable& table, const Assignment& assignment, const AssignmentScene& scene) {
  const bool has_file = !scene.params.empty() || !scene.params_template.empty();
  if (mentions(assignment.run_command, "{scene}") && scene.path.empty())
    throw table.error("the run's command has {scene}: 'path' is missing");
  if (mentions(assignment.run_command, "{scene}") && has_file)
    throw table.error("the run's command has {scene}, so that the scene's file is ours: it needs no other");
  if (mentions(assignment.run_command, "{scene_option}") && scene.option.empty())
    throw table.error("the run's command has {scene_option}: 'scene_option' is missing");
  const bool has_params = mentions(assignment.run_command, "{params}") || mentions(scene.option, "{params}");
  if (has_params && scene.params_place.empty()) throw table.error("{params} is used: 'params_place' is missing");
  if (!scene.variant.empty() && scene.path.empty())
    throw table.error("of", "a variant is made of scene '" + scene.of + "', which has no 'path' to a description");
  const bool is_told = mentions(assignment.run_command, "{scene}") || !scene.params_template.empty();
  if (!scene.variant.empty() && scene.variant != "resolution" && !is_told)
    throw table.error("variant",
                      "the program would not receive it: the command has no {scene}, and there is no "
                      "'params_template'");
  if (assignment.reference.kind == ReferenceSource::Kind::engine && scene.path.empty())
    throw table.error("references are by " + assignment.reference.engine + ": 'path' is missing");
  if (assignment.reference.kind == ReferenceSource::Kind::files && scene.reference.empty())
    throw table.error("references are files: 'reference' is missing");
}

AssignmentScene scene_of(const TomlTable& table, bool hidden, const Assignment& assignment) {
  AssignmentScene scene;
  scene.name = file_name(table, "name");
  if (find_named(assignment.scenes, scene.name) != nullptr)
    throw table.error("name", "there is a scene '" + scene.name + "' already");
  if (hidden && table.has("of")) read_variant(table, assignment, scene);
  scene.hidden = hidden;
  read_params(table, assignment, scene);
  const auto side = [&](const char* key, int& value) {
    if (scene.of.empty() || table.has(key)) value = bounded_integer(table, key, 8, 8192);
  };
  side("width", scene.width);
  side("height", scene.height);
  if (table.has("weight")) scene.weight = table.number("weight");
  if (scene.weight < 0) throw table.error("weight", "'weight' must not be negative");
  file_if_given(table, "reference", assignment, scene.reference);
  file_if_given(table, "given", assignment, scene.given);
  check_needs(table, assignment, scene);
  table.expect_no_other_keys();
  return scene;
}

std::vector<SpeedTier> tiers_of(const TomlTable& table) {
  std::vector<SpeedTier> tiers;
  for (const TomlTable& row : table.tables("tiers")) {
    const SpeedTier tier{positive_number(row, "ratio"), positive_number(row, "points")};
    row.expect_no_other_keys();
    if (!tiers.empty() && (tier.ratio <= tiers.back().ratio || tier.points < tiers.back().points))
      throw row.error("ratio", "tiers ascend, in ratio and in points");
    tiers.push_back(tier);
  }
  return tiers;
}

}  // namespace

void read_assignment_scenes(const TomlTable& document, Assignment& assignment) {
  for (const TomlTable& table : document.tables("scene"))
    assignment.scenes.push_back(scene_of(table, false, assignment));
  if (assignment.scenes.empty()) throw document.error("there is no [[scene]]");
  for (const TomlTable& table : document.tables("hidden"))
    assignment.scenes.push_back(scene_of(table, true, assignment));
  double weights = 0;
  for (const AssignmentScene& scene : assignment.scenes) weights += scene.weight;
  if (weights == 0) throw document.error("scene", "the weights of all scenes are 0");
}

PerformanceRule performance_rule(const TomlTable& table, const Assignment& assignment) {
  PerformanceRule rule;
  rule.timed = table.strings("timed");
  if (rule.timed.empty()) throw table.error("timed", "'timed' names no scene");
  for (std::size_t i = 0; i < rule.timed.size(); ++i) {
    const AssignmentScene* scene = find_named(assignment.scenes, rule.timed[i]);
    if (scene == nullptr) throw table.error("timed", i, unknown_name("scene", rule.timed[i], assignment.scenes));
    if (scene->hidden) throw table.error("timed", i, "scene '" + rule.timed[i] + "' is hidden: public ones are timed");
  }
  rule.tiers = tiers_of(table);
  if (table.has("curve")) {
    const TomlTable curve = table.table("curve");
    rule.curve = SpeedTier{positive_number(curve, "best"), positive_number(curve, "points")};
    if (rule.curve->ratio <= 1) throw curve.error("best", "'best' is a speed-up: above 1");
    curve.expect_no_other_keys();
  }
  if (rule.tiers.empty() == !rule.curve) throw table.error("needs 'tiers' or 'curve', and not both");
  if (table.has("needs")) rule.needs_all = one_of(table, "needs", {"all", "timed"}) == "all";
  if (table.has("precision")) rule.precision = positive_number(table, "precision");
  if (table.has("rounds")) rule.rounds = bounded_integer(table, "rounds", 3, 1000);
  if (table.has("seconds")) rule.seconds = positive_number(table, "seconds");
  table.expect_no_other_keys();
  return rule;
}

}  // namespace photonproof::inline harness_grading
