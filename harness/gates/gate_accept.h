// A person accepts that a scene now looks different: its reference is rendered anew and replaces the committed one. Old
// and new, the reason, who, and how far apart the two are stay in the provenance's history.
#pragma once

#include <atomic>
#include <filesystem>
#include <optional>
#include <string>

#include "harness/gates/gate_suite.h"
#include "reference/store/provenance.h"

namespace photonproof::inline harness_gates {

struct AcceptOptions {
  std::filesystem::path program;  ///< this program
  std::string gate;               ///< whose scene's reference is replaced
  std::string reason;
  std::string who;
  std::optional<double> standard_error{};  ///< of the new one; the old one's where not given
  const std::atomic<bool>* interrupt = nullptr;
};

struct Accepted {
  std::filesystem::path file;
  Provenance provenance;
  std::string sentence;  ///< the new one against the old
};

/// Empty when interrupted. Throws InputError without a reason, for an unknown gate, and when no reference can be
/// rendered or committed.
std::optional<Accepted> accept_reference(const GateSuite& suite, const AcceptOptions& options);

/// git's user.name, else $USER, else "somebody".
std::string name_of_user();

}  // namespace photonproof::inline harness_gates
