// A gate suite: the bounds that engines must keep on scenes. Its keys and metrics are in docs/formats/suite.md, which
// suite_format_test.cpp compares with the code.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/metrics/metric_parameters.h"
#include "harness/suites/suite.h"
#include "reports/record/gate_metrics.h"

namespace photonproof::inline harness_gates {

/// A new member does not compile until verdict_key (accepted_verdicts.cpp) handles it, as a pass may depend on it.
struct Gate {
  std::string name;
  std::string scene, engine;  ///< names
  Budget budget;              ///< samples or photons of one image
  std::string metric;
  double bound = 0;
  double block_bound = 0;  ///< agreement only
  double alpha = 0;
  int seeds = 0;  ///< images at the first look
  int looks = 0;
  bool takes_seed = true;                    ///< its engine's command has a {seed}
  bool unbiased = true;                      ///< its engine's trust: images whose noise averages out
  std::vector<GivenParameter> parameters{};  ///< the metric's; the others are the scene's
};

/// A fault that --self-test plants and no gate of the suite must find, though it changes images of the suite.
struct Unpromised {
  std::string planted;  ///< name of a mutant (gate_mutants.h)
  std::string why;      ///< clause, without a full stop
};

/// Its scenes are without SuiteScene::reference.
struct GateSuite : SuiteCommon {
  std::vector<Gate> gates;
  std::vector<Unpromised> unpromised;
};

/// The gates whose names contain `part`. Throws InputError about --only when there are none.
std::vector<const Gate*> gates_named(const GateSuite& suite, const std::string& part);

/// Throws InputError with file:line:col for any other content.
GateSuite read_gate_suite(const std::filesystem::path& file);

}  // namespace photonproof::inline harness_gates
