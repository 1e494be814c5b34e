#include "scenes/text/faults.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <stdexcept>
#include <utility>

namespace photonproof {
inline namespace faulty {
namespace {

constexpr std::pair<const char*, Fault> names[] = {
    {"dropped-cosine", Fault::dropped_cosine},
    {"missing-caustic", Fault::missing_caustic},
    {"half-photons", Fault::half_photons},
    {"uniform-diffuse", Fault::uniform_diffuse},
    {"part-of-lamp", Fault::part_of_lamp},
    {"unweighted-hits", Fault::unweighted_hits},
    {"unpaid-roulette", Fault::unpaid_roulette},
    {"dim-caustic", Fault::dim_caustic},
    {"density-radius", Fault::density_radius},
    {"same-photons", Fault::same_photons},
    {"same-samples", Fault::same_samples},
    {"wide-filter", Fault::wide_filter},
    {"flipped-v", Fault::flipped_v},
    {"raw-srgb", Fault::raw_srgb},
    {"thin-medium", Fault::thin_medium},
    {"backward-phase", Fault::backward_phase},
    {"fov-axis", Fault::fov_axis},
    {"spot-angle", Fault::spot_angle},
    {"turned-sky", Fault::turned_sky},
    {"swapped-ior", Fault::swapped_ior},
    {"single-reflection", Fault::single_reflection},
    {"flat-normals", Fault::flat_normals},
    {"repeated-seed", Fault::repeated_seed},
    {"upside-down", Fault::upside_down},
    {"quarter-budget", Fault::quarter_budget},
    {"red-for-all", Fault::red_for_all},
    {"certain-noise", Fault::certain_noise},
};

std::optional<Fault> fault_named(const std::string& wanted) {
  for (const auto& [name, fault] : names)
    if (wanted == name) return fault;
  return std::nullopt;
}

/// None where the variable is empty or not set. A name that is none of these ends the program with one line and exit
/// code 2. (Those of kernels and of what they are made of are in one instruction set alone, see
/// renderer/CMakeLists.txt: `--isa v2`.)
std::optional<Fault> fault_of_environment() {
  const char* variable = std::getenv("PHOTONPROOF_FAULT");
  const std::string chosen = variable == nullptr ? "" : variable;
  if (chosen.empty()) return std::nullopt;
  if (const auto fault = fault_named(chosen)) return fault;
  std::string known;
  for (const auto& [name, fault] : names) known += (known.empty() ? "" : ", ") + std::string(name);
  std::fprintf(stderr, "PHOTONPROOF_FAULT: error: unknown fault '%s'; known: %s\n", chosen.c_str(), known.c_str());
  std::exit(2);
}

// Before main: whatever the program is asked to do, no sound image passes for a faulty one by a misspelt name.
std::optional<Fault> fault_of_this_program = fault_of_environment();

}  // namespace

bool has_fault(Fault fault) { return fault_of_this_program == fault; }

std::string planted_fault() {
  const auto row =
      std::find_if(std::begin(names), std::end(names), [](const auto& name) { return has_fault(name.second); });
  return row == std::end(names) ? "" : row->first;
}

PlantedFault::PlantedFault(const std::string& name) : before_(fault_of_this_program) {
  const auto fault = fault_named(name);
  if (!fault) throw std::invalid_argument("unknown fault '" + name + "'");
  fault_of_this_program = fault;
}

PlantedFault::~PlantedFault() { fault_of_this_program = before_; }

}  // namespace faulty
}  // namespace photonproof
