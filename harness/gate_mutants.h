// What is planted to learn what gates find: mutants, which they must find, and nulls, of which they must not complain.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "scenes/image.h"

namespace photonproof {

/// Something done to an engine's images, or to the engine.
struct Variant {
  std::string name;         ///< "2 % energy"
  bool is_mutant = true;    ///< else a null
  /// Done to the finished image; null where nothing is done to it.
  Image (*change)(const Image& image) = nullptr;
  std::string fault{};                 ///< planted in photonproof-faulty (renderer/faults.h); empty: the program itself
  std::vector<std::string> further{};  ///< arguments after the engine's own
  int threads = 0;                     ///< of the engine; 0: the suite's
  /// Variants whose images come out of the engine as they do without them share those.
  bool draws_its_own() const { return !fault.empty() || !further.empty() || threads > 0; }
};

/// Mutants first.
std::span<const Variant> gate_variants();

}  // namespace photonproof
