#include "scenes/base/faults.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <stdexcept>
#include <utility>

#include "scenes/base/numeric_faults.h"

namespace photonproof::inline scenes_base {
inline namespace faulty {
namespace {

constexpr std::pair<const char*, Fault> names[] = {
    {"dropped-cosine", Fault::dropped_cosine},
    {"missing-caustic", Fault::missing_caustic},
    {"half-photons", Fault::half_photons},
    {"uniform-diffuse", Fault::uniform_diffuse},
    {"part-of-lamp", Fault::part_of_light},
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

constexpr std::pair<const char*, NumericFault> names_of_numeric[] = {
    {"no-recentring", NumericFault::no_recentring},     {"no-rescaling", NumericFault::no_rescaling},
    {"float-faces", NumericFault::float_faces},         {"float-sphere", NumericFault::float_sphere},
    {"float-cylinder", NumericFault::float_cylinder},   {"lost-height", NumericFault::lost_height},
    {"far-periods", NumericFault::far_periods},         {"fixed-step", NumericFault::fixed_step},
    {"unclamped-metal", NumericFault::unclamped_metal},
};

template <class Names>
auto fault_named(const Names& known, const std::string& wanted) {
  using Named = decltype(std::begin(known)->second);
  for (const auto& [name, fault] : known)
    if (wanted == name) return std::optional<Named>(fault);
  return std::optional<Named>();
}

struct ChosenFaults {
  std::optional<Fault> fault{};
  std::optional<NumericFault> numeric{};
};

/// The chosen faults; none where the variable is empty or not set. An unknown name ends the program with one line and
/// exit code 2. (Faults of kernels and their parts exist in one instruction set only, see renderer/CMakeLists.txt:
/// `--isa v2`.)
ChosenFaults fault_of_environment() {
  const char* variable = std::getenv("PHOTONPROOF_FAULT");
  const std::string chosen = variable == nullptr ? "" : variable;
  if (chosen.empty()) return {};
  if (const auto fault = fault_named(names, chosen)) return {fault, {}};
  if (const auto numeric = fault_named(names_of_numeric, chosen)) return {{}, numeric};
  std::string known;
  for (const auto& [name, fault] : names) known += (known.empty() ? "" : ", ") + std::string(name);
  for (const auto& [name, fault] : names_of_numeric) known += ", " + std::string(name);
  std::fprintf(stderr, "PHOTONPROOF_FAULT: error: unknown fault '%s'; known: %s\n", chosen.c_str(), known.c_str());
  std::exit(2);
}

// Evaluated before main in every run, so that a misspelt name never yields a sound image in place of a faulty one.
ChosenFaults of_this_program = fault_of_environment();

}  // namespace

bool has_fault(Fault fault) { return of_this_program.fault == fault; }
bool has_fault(NumericFault fault) { return of_this_program.numeric == fault; }

std::string planted_fault() {
  const auto name_in = [](const auto& known) -> std::string {
    const auto row =
        std::find_if(std::begin(known), std::end(known), [](const auto& name) { return has_fault(name.second); });
    return row == std::end(known) ? "" : row->first;
  };
  return of_this_program.numeric ? name_in(names_of_numeric) : name_in(names);
}

PlantedFault::PlantedFault(const std::string& name) : before_(of_this_program.fault) {
  const auto fault = fault_named(names, name);
  if (!fault) throw std::invalid_argument("unknown fault '" + name + "'");
  of_this_program.fault = fault;
}

PlantedFault::~PlantedFault() { of_this_program.fault = before_; }

}  // namespace faulty
}  // namespace photonproof::inline scenes_base
