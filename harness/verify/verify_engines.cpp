#include "harness/verify/verify_engines.h"

#include <algorithm>
#include <variant>

#include "harness/diagnosis/seen_objects.h"
#include "harness/gates/independence.h"
#include "harness/suites/suite_rows.h"
#include "scenes/description/emitter_kinds.h"
#include "scenes/files/atomic_file.h"

namespace photonproof::inline harness_verify {
namespace {

namespace fs = std::filesystem;

/// Rows of engines.toml. sppm is the photon mapper's code with other settings, and `reference` is one of the others.
constexpr const char* kVerifying[] = {"path",         "bdpt",   "ptracer", "volpath",
                                      "photonmapper", "povray", "cycles",  "mitsuba"};

std::vector<Engine> rows_of(const fs::path& file, const std::vector<Engine>& builtin) {
  if (file.empty()) return {};
  const TomlTable document = TomlTable::parse(read_file(file, max_suite_bytes), file.string());
  return engines_from_toml(document, builtin);  // other tables of a suite are not checked here
}

/// Variance layers of stratified samples overstate the variance (harness/statistics/agreement.h). Scenes with a part of
/// their light are in another folder than their textures.
void complete_command(Engine& row) {
  if (row.command.empty() || row.command.front() != "{photonproof}" || row.command.size() < 2) return;
  if (row.command[1] == "render")
    row.command.insert(row.command.end(), {"--sampler", "independent", "--allow-outside"});
  if (row.command[1] == "povray" || row.command[1] == "cycles" || row.command[1] == "mitsuba")
    row.command.push_back("--allow-outside");
}

std::string sampling_of_row(const Engine& row) {
  const std::optional<std::string> integrator = integrator_of(row);
  return integrator ? sampling_of(*integrator) : row.name;
}

/// Whether some light leaves the BSDF, or one that it nests, in a single direction.
bool is_clear(const SceneDescription& scene, BsdfIndex index) {
  const BsdfDescription& bsdf = scene.bsdfs[index.value];
  const BsdfTraits traits = traits_of(bsdf);
  return traits.specular || traits.transmits ||
         std::ranges::any_of(nested_bsdfs(bsdf), [&](BsdfIndex inner) { return is_clear(scene, inner); });
}

/// Returns true if the visible objects are unknown.
bool looks_at_clear_surfaces(const SceneDescription& scene) {
  std::vector<bool> clear;
  for (const ShapeDescription& shape : scene.shapes) clear.push_back(is_clear(scene, shape.bsdf));
  for (const ShapeGroupDescription& group : scene.groups)
    for (const ShapeDescription& shape : group.shapes)
      if (is_clear(scene, shape.bsdf)) return true;
  if (std::ranges::find(clear, true) == clear.end()) return false;
  constexpr int side = 64;
  const std::vector<SeenPlace> points = seen_points(scene, side, side);
  if (std::ranges::all_of(points, [](const SeenPlace& point) { return point.object == 0; })) return true;
  return std::ranges::any_of(points,
                             [&](const SeenPlace& point) { return point.object > 0 && clear[point.object - 1u]; });
}

bool has_endless_plane_under_far_light(const SceneDescription& scene) {
  const auto is_endless = [](const ShapeDescription& shape) {
    return std::holds_alternative<PlaneDescription>(shape.geometry);
  };
  return std::ranges::any_of(scene.shapes, is_endless) && std::ranges::any_of(scene.emitters, is_infinitely_far);
}

VerifyEngine verifying(Engine row, const fs::path& folder, const fs::path& program) {
  VerifyEngine engine;
  engine.sampling = sampling_of_row(row);
  engine.is_ours = integrator_of(row).has_value();
  engine.budget_kind = row.accepts("spp") ? "spp" : row.budget_kinds.front();
  engine.version = ask_version(row, folder, program);
  complete_command(row);
  engine.row = std::move(row);
  return engine;
}

}  // namespace

std::vector<VerifyEngine> verify_engines(const EngineChoice& choice) {
  const std::vector<Engine> builtin = builtin_engines();
  std::vector<Engine> rows;
  for (const char* name : kVerifying) rows.push_back(*find_named(builtin, name));
  for (Engine& row : rows_of(choice.rows, builtin)) rows.push_back(std::move(row));
  for (const std::string& name : choice.names)
    if (find_named(rows, name) == nullptr) throw InputError("--engine", unknown_name("engine", name, rows));
  const fs::path folder = choice.rows.empty() ? fs::path(".") : fs::absolute(choice.rows).parent_path();
  std::vector<VerifyEngine> engines;
  for (Engine& row : rows) {
    if (!choice.names.empty() && std::ranges::find(choice.names, row.name) == choice.names.end()) continue;
    if (row.denoises)
      throw InputError(choice.rows.string(), "engine '" + row.name + "' denoises; verify compares estimates alone");
    engines.push_back(verifying(std::move(row), folder, choice.program));
  }
  return engines;
}

std::string what_is_not_shown(const std::string& sampling, const SceneDescription& scene) {
  if (sampling != "ptracer") return {};
  if (looks_at_clear_surfaces(scene))
    return "light paths do not reach the eye by the mirrors, clear glass, coats or holes that it looks at";
  if (has_endless_plane_under_far_light(scene))
    return "light paths miss a plane without end, from afar, where light from infinity falls on it";
  return {};
}

}  // namespace photonproof::inline harness_verify
