// The outcome of a run of another engine, with messages common to all engines.
#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "scenes/base/process.h"
#include "scenes/description/description.h"
#include "scenes/images/image.h"

namespace photonproof::inline reference_engines {

/// An engine ran and finished without an image: its own message, or the limit that ended it.
class EngineFailure : public std::runtime_error {
 public:
  enum class Kind { failed, limit, interrupted };
  EngineFailure(Kind what_kind, const std::string& message) : std::runtime_error(message), kind(what_kind) {}
  Kind kind;
};

struct EngineProgram {
  std::string name;     ///< "POV-Ray"
  std::string program;  ///< the program that ran
  std::string package;  ///< the Debian package that has it
};

/// Reports an outcome that is not ok. Throws InputError when the program could not be started, else EngineFailure, with
/// the engine's message `said` where it failed by itself.
[[noreturn]] void report_failure(const EngineProgram& engine, const ProcessOutcome& outcome, const std::string& said);

/// The command as typed in a shell.
std::string command_line(const std::vector<std::string>& argv);

/// The film's crop of an image of the whole film; the whole image where the film has no crop.
Image kept_part(const FilmDescription& film, const Image& image);
/// The place of that crop; empty where the film has none.
std::optional<ImagePlace> kept_place(const FilmDescription& film);

/// One sentence, ending with `why`, where values are not finite; else empty.
std::vector<std::string> find_non_finite(const Image& image, const std::string& why);

}  // namespace photonproof::inline reference_engines
