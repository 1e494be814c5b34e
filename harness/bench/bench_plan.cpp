#include "harness/bench/bench_plan.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "harness/bench/correctness.h"
#include "harness/cells/cells.h"
#include "harness/images/engine_version.h"
#include "harness/references/suite_scene.h"
#include "scenes/description/expect.h"

namespace photonproof::inline harness_bench {
namespace {

namespace fs = std::filesystem;

SceneRecord describe_scene(const SuiteScene& scene, const std::optional<Expect>& expect,
                           const std::optional<FilmPart>& crop) {
  SceneRecord record;
  record.name = scene.name;
  record.path = scene.given_path;
  record.title = expect ? expect->title : "";
  record.purpose = expect ? expect->purpose : "";
  record.width = crop ? crop->width : scene.width;
  record.height = crop ? crop->height : scene.height;
  record.exposure = scene.exposure.value_or(expect ? expect->exposure : 0);
  if (scene.reference) record.reference_label = scene.reference->label();
  if (expect) record.hdr_exposures = expect->hdr_exposures;
  return record;
}

}  // namespace

PlannedCell& BenchPlan::find(const std::string& label) {
  return const_cast<PlannedCell&>(std::as_const(*this).find(label));
}

const PlannedCell& BenchPlan::find(const std::string& label) const {
  return *std::find_if(cells.begin(), cells.end(),
                       [&](const PlannedCell& planned) { return planned.cell.label() == label; });
}

BenchPlan plan_bench(const Suite& suite, const fs::path& program, const ImageSource& source) {
  BenchPlan plan;
  for (const SuiteScene& scene : suite.scenes)
    if (scene.reference) plan.cells.push_back({*scene.reference, true});
  for (const Cell& cell : suite.cells) plan.cells.push_back({cell, false});

  std::map<std::string, EngineVersion> versions;
  for (const Engine& engine : suite.engines) {
    const bool used = std::any_of(plan.cells.begin(), plan.cells.end(),
                                  [&](const PlannedCell& planned) { return planned.cell.engine == engine.name; });
    if (!used) continue;
    const EngineVersion& version = versions[engine.name] =
        ask_version(engine, suite.folder, program, std::min(20.0, suite.limits.seconds));
    plan.drawn_by[engine.name] = {&engine, version.line};
    plan.engines.push_back({engine.name, engine.title, version.line, to_string(engine.trust)});
  }
  for (const SuiteScene& scene : suite.scenes) {
    SceneContent content = content_of(scene);
    const std::optional<Expect>& expect = plan.expectations[scene.name] = expectations_of(scene);
    plan.scenes.push_back(describe_scene(scene, expect, content.crop));
    plan.drawn[scene.name] = {&scene, std::move(content.hash), content.crop};
    if (scene.reference)
      plan.scenes.back().reference_doubt = doubt_of(suite.engine(scene.reference->engine));
    else
      plan.stored.emplace(scene.name, reference_of(scene));
  }

  for (PlannedCell& planned : plan.cells) {
    const Cell& cell = planned.cell;
    planned.key = source.key(plan.drawn_by[cell.engine], plan.drawn[cell.scene], cell.budget, cell.seed);
    // The control is the same work, measured a second time.
    const bool is_control = !suite.control.empty() && cell.engine == control_name(suite.control);
    if (is_control) planned.key = content_key({{"control", planned.key}});
    planned.unsupported = versions[cell.engine].problem;
    planned.status_untried = versions[cell.engine].cells_end_as;
    if (const auto& expect = plan.expectations[cell.scene]; expect)
      if (const auto why = expect->unsupported.find(is_control ? suite.control : cell.engine);
          why != expect->unsupported.end()) {
        planned.unsupported = why->second;
        planned.status_untried = Status::unsupported;
      }
    if (!planned.unsupported) planned.found = source.find(planned.key);
  }
  return plan;
}

}  // namespace photonproof::inline harness_bench
