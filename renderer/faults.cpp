#include "renderer/faults.h"

#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>
#include <utility>

namespace photonproof {
namespace {

constexpr std::pair<const char*, Fault> names[] = {{"dropped-cosine", Fault::dropped_cosine},
                                                   {"missing-caustic", Fault::missing_caustic},
                                                   {"half-photons", Fault::half_photons}};

/// None where the variable is empty or not set. A name that is none of these ends the program with one line and exit
/// code 2. (The first two are in the kernels of one instruction set alone, see CMakeLists.txt: `--isa v2`.)
std::optional<Fault> planted() {
  const char* variable = std::getenv("PHOTONPROOF_FAULT");
  const std::string chosen = variable == nullptr ? "" : variable;
  if (chosen.empty()) return std::nullopt;
  std::string known;
  for (const auto& [name, fault] : names) {
    if (chosen == name) return fault;
    known += (known.empty() ? "" : ", ") + std::string(name);
  }
  std::fprintf(stderr, "PHOTONPROOF_FAULT: error: unknown fault '%s'; known: %s\n", chosen.c_str(), known.c_str());
  std::exit(2);
}

// Before main: whatever the program is asked to do, no sound image passes for a faulty one by a misspelt name.
const std::optional<Fault> fault_of_this_program = planted();

}  // namespace

bool has_fault(Fault fault) { return fault_of_this_program == fault; }

}  // namespace photonproof
