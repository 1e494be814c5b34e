#include "harness/gates/gates_together.h"

#include <algorithm>
#include <map>

#include "harness/gates/independence.h"
#include "harness/suites/suite_rows.h"
#include "renderer/integrators/integrator.h"

namespace photonproof::inline harness_gates {
namespace {

using Names = std::vector<std::string>;

bool holds(const Names& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

Names passes_of(const std::string& integrator) {
  const Integrator* row = find_integrator(integrator);
  return row == nullptr ? Names() : Names(row->parts.begin(), row->parts.end());
}

constexpr const char* shared_by_all = "camera, materials, lights and textures";

struct Verdicts {
  bool failed = false, undecided = false;
};

class SceneVerdicts {
 public:
  SceneVerdicts(const SuiteCommon& suite, const std::vector<GateRecord>& gates, const std::string& scene)
      : suite_(suite) {
    std::map<std::string, Verdicts> engines;
    for (const GateRecord& gate : gates) {
      if (gate.scene != scene) continue;
      Verdicts& verdicts = engines[gate.engine];
      if (gate.verdict == GateVerdict::fail && !gate.status) verdicts.failed = true;
      if (gate.verdict == GateVerdict::inconclusive || gate.status) verdicts.undecided = true;
    }
    for (const auto& [engine, verdicts] : engines) {
      if (verdicts.failed)
        failing_.push_back(engine);
      else if (!verdicts.undecided)
        passing_.push_back(engine);
    }
  }

  /// Empty where engines together show nothing.
  std::string sentence() const {
    if (failing_.empty() || failing_.size() + passing_.size() < 2) return "";
    const std::string fail = listed(failing_, "and") + (failing_.size() == 1 ? " fails" : " fail");
    const bool ours = all_ours(failing_);
    if (passing_.empty())
      return fail + ", and no engine passes: look at what they share: the scene or its reference" +
             (ours ? ", " + std::string(shared_by_all) + common_text(own(failing_)) : "");
    const std::string where =
        fail + " where " + listed(passing_, "and") + (passing_.size() == 1 ? " passes" : " pass") + ": ";
    if (!ours) return where + "other gates pass with the same reference";
    Names suspects;
    for (const std::string& pass : own(failing_))
      if (!run_by_any(passing_, pass)) suspects.push_back(pass);
    if (!suspects.empty()) return where + "look at " + listed(suspects, "or");
    return where + (failing_.size() > 1 && own(failing_).empty()
                        ? "the parts that they share run in the others, too: more than one cause"
                        : "the others run all their parts; the bounds may differ more than the engines do");
  }

 private:
  static std::string listed(const Names& names, const std::string& last) {
    std::string text;
    for (std::size_t i = 0; i < names.size(); ++i)
      text += (i == 0 ? "" : i + 1 < names.size() ? ", " : " " + last + " ") + names[i];
    return text;
  }

  static std::string common_text(const Names& passes) { return passes.empty() ? "" : ", " + listed(passes, "or"); }

  std::string integrator(const std::string& engine) const { return integrator_of(suite_.engine(engine)).value_or(""); }

  bool all_ours(const Names& engines) const {
    return std::ranges::none_of(engines, [&](const auto& engine) { return passes_of(integrator(engine)).empty(); });
  }

  /// The code that all of these engines run. Precondition: at least one engine.
  Names own(const Names& engines) const {
    Names passes = passes_of(integrator(engines.front()));
    for (const std::string& engine : engines)
      std::erase_if(passes, [&](const auto& pass) { return !holds(passes_of(integrator(engine)), pass); });
    return passes;
  }

  bool run_by_any(const Names& engines, const std::string& pass) const {
    return std::ranges::any_of(engines, [&](const auto& engine) { return holds(passes_of(integrator(engine)), pass); });
  }

  const SuiteCommon& suite_;
  Names failing_, passing_;
};

}  // namespace

std::vector<std::string> gates_together(const std::vector<GateRecord>& gates, const SuiteCommon& suite) {
  Names scenes, sentences;
  for (const GateRecord& gate : gates) {
    if (holds(scenes, gate.scene)) continue;
    scenes.push_back(gate.scene);
    const std::string sentence = SceneVerdicts(suite, gates, gate.scene).sentence();
    if (!sentence.empty()) sentences.push_back(gate.scene + ": " + sentence);
  }
  return sentences;
}

}  // namespace photonproof::inline harness_gates
