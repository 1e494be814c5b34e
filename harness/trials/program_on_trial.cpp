#include "harness/trials/trials.h"
#include "scenes/base/input_error.h"

namespace photonproof::inline harness_trials {

std::filesystem::path program_on_trial(const std::filesystem::path& asked) {
  if (!asked.empty()) {
    if (!std::filesystem::exists(asked)) throw InputError("--program", "there is no '" + asked.string() + "'");
    return asked;
  }
  const std::filesystem::path beside = std::filesystem::read_symlink("/proc/self/exe").replace_filename("photonproof");
  if (!std::filesystem::exists(beside))
    throw InputError(beside.string(), "is missing; build it, or name one by --program");
  return beside;
}

}  // namespace photonproof::inline harness_trials
