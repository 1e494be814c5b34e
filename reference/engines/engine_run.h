// How a run of another engine ended, in the words that are the same for all of them.
#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "scenes/base/process.h"
#include "scenes/description/description.h"
#include "scenes/images/image.h"

namespace photonproof::inline reference_engines {

/// An engine ran and did not finish with an image: its own message, or the limit that ended it.
class EngineFailure : public std::runtime_error {
 public:
  enum class Kind { failed, limit, interrupted };
  EngineFailure(Kind what_kind, const std::string& message) : std::runtime_error(message), kind(what_kind) {}
  Kind kind;
};

struct EngineProgram {
  std::string name;     ///< "POV-Ray"
  std::string program;  ///< what was run
  std::string package;  ///< Debian's, which has it
};

/// For an outcome that is not ok: throws InputError when the program could not be started, EngineFailure else, with
/// what the engine `said` where it failed by itself.
[[noreturn]] void report_failure(const EngineProgram& engine, const ProcessOutcome& outcome, const std::string& said);

/// As one would type it.
std::string command_line(const std::vector<std::string>& argv);

/// The film's crop, or all where it has none, of an image of the whole film.
Image kept_part(const FilmDescription& film, const Image& image);
/// Where that part lies; empty: it is all.
std::optional<ImagePlace> kept_place(const FilmDescription& film);

/// A sentence where values are not finite, which ends with `why`; nothing else.
std::vector<std::string> find_non_finite(const Image& image, const std::string& why);

}  // namespace photonproof::inline reference_engines
