// A person accepts a scene's new look: its reference is rendered anew and replaces the committed one. The provenance's
// history keeps the old and new reference, the reason, the person, and the difference between the two.
#pragma once

#include <atomic>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "harness/gates/gate_suite.h"
#include "reference/store/provenance.h"

namespace photonproof::inline harness_gates {

struct AcceptOptions {
  std::filesystem::path program;  ///< this program
  std::string gate;               ///< the gate of the scene whose reference is replaced
  std::string reason;
  std::string who;
  std::optional<double> standard_error{};  ///< relative standard error of the new reference; default: the old one's
  const std::atomic<bool>* interrupt = nullptr;
  std::map<std::string, std::string> versions{};  ///< for a reference that an engine renders
};

struct Accepted {
  std::filesystem::path file;
  Provenance provenance;
  std::string sentence;  ///< compares the new reference with the old
};

/// The reference of a scene that only an engine reads is rendered by the engine of the old one, else by the gate's.
/// Empty when interrupted. Throws InputError without a reason, for an unknown gate, and when no reference can be
/// rendered or committed.
std::optional<Accepted> accept_reference(const GateSuite& suite, const AcceptOptions& options);

/// git's user.name, else $USER, else "somebody".
std::string name_of_user();

}  // namespace photonproof::inline harness_gates
