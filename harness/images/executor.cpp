#include "harness/images/executor.h"

#include <algorithm>

#include "harness/cells/host.h"

namespace photonproof::inline harness_images {
namespace {

class LocalProcesses : public Executor {
 public:
  ProcessOutcome run(const std::vector<std::string>& argv, const ProcessOptions& options) const override {
    return run_process(argv, options);
  }
  int at_once(int threads) const override { return std::max(1, describe_host().cores / threads); }
};

}  // namespace

const Executor& usual_executor() {
  static const LocalProcesses here;
  return here;
}

}  // namespace photonproof::inline harness_images
