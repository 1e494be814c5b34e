// photonproof reference for a suite's scene: from images that somebody gives, or by one of its engines.
#pragma once

#include <string>
#include <vector>

namespace photonproof::inline harness_verbs {

struct SuiteReferenceArguments {
  std::string scene;              ///< --scene; empty: the suite's only one
  std::vector<std::string> from;  ///< images
  std::string variance, transfer;
  std::string engine, budget;
  int images = 32;

  bool any() const {
    return !scene.empty() || !from.empty() || !variance.empty() || !transfer.empty() || !engine.empty() ||
           !budget.empty();
  }
};

/// `path` is a suite, or a scene of our own beside which the reference is put. Returns the exit code. Throws
/// InputError.
int make_suite_reference(const std::string& path, const SuiteReferenceArguments& arguments, const std::string& reason,
                         bool json, const std::string& progress_mode);

}  // namespace photonproof::inline harness_verbs
