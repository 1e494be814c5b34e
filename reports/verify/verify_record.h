// The record of `photonproof verify`: the engines that agree on a scene, each pair's minimum detectable error, and the
// wrong engine of a pair that differs. verify.schema.json is its contract.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace photonproof::inline reports_verify {

struct VerifyEngineRecord {
  std::string name, title, version;
  std::string problem{};  ///< why it cannot be used; else empty
};

/// One engine's picture of one scene, or the reason why there is none.
struct VerifyPicture {
  std::string engine;
  std::string status;  ///< "ok", "unsupported", "crash" ... (results.h)
  std::string detail;  ///< why there is no picture
  std::string command;
  double seconds = 0;         ///< wall time of its processes
  std::uint64_t samples = 0;  ///< per pixel; 0 if its budget does not count them
  std::array<double, 3> mean{};
  double declared_whole = 0, declared_block = 0;  ///< relative errors that are known
  std::string declared_reason;
  std::vector<std::string> losses;
  std::string picture;  ///< PNG, relative to the record
};

/// A pair agrees if its minimum detectable error is at most this many times the one asked for, and declared errors.
inline constexpr double accepted_power = 1.5;

/// Names of sides in pairs that are no engines.
inline constexpr const char *closed_form_side = "closed form", *stored_reference_side = "stored reference";

struct VerifyPair {
  std::string first, second;  ///< engines, or one of those two names
  std::string verdict;        ///< "agree", "differ", "undecided"
  std::string sentence;       ///< how they differ
  std::array<double, 3> shift{};
  std::optional<double> whole_shift;  ///< of the channels that differ together, else of all
  std::optional<double> would_see;    ///< minimum detectable relative error of the mean, with probability 0.99
  std::optional<double> relmse, ssim;
  /// The value for tables: whole_shift, or without it the largest channel's shift, signed.
  double shown_shift() const;
};

/// A wrong engine, or one of a group with a wrong engine.
struct VerifyFault {
  std::string engine;
  std::string sentence;  ///< size, place and channel of the error
  std::string place;     ///< in words of what the scene shows there: "below the glass sphere"
  std::string pass;      ///< "direct", "caustic" ... ; empty: not found
  std::string pass_words;
  std::string pass_sentence;                                   ///< the error in that pass
  std::string right_picture, odd_picture, difference_picture;  ///< PNGs of that pass, or of the whole
};

struct VerifyScene {
  std::string name, path, purpose;
  int width = 0, height = 0;
  double exposure = 0, seconds = 0;
  std::string verdict;  ///< "agree", "differ", "stale reference", "cannot tell which", "inconclusive", "failed"
  std::string sentence;
  std::vector<std::string> believed{};
  std::vector<VerifyPicture> pictures{};
  std::vector<VerifyPair> pairs{};
  std::vector<VerifyFault> faults{};
  std::vector<std::string> notes{};
  std::string title{};  ///< from expect.toml, for the page; empty: the name stands there

  const std::string& shown_name() const { return title.empty() ? name : title; }
};

/// The pair in either order; null if they were not compared.
const VerifyPair* pair_between(const VerifyScene& scene, const std::string& a, const std::string& b);

/// One engine's picture of a micro-scene, fitted to its closed form: image = gain * closed form + offset.
struct VerifyProbe {
  std::string engine, kind, what;                  ///< kind: "light", "material", "camera", "medium"
  std::string verdict;                             ///< "right", "wrong", "not rendered"
  std::string sentence;                            ///< "spot light: POV-Ray 1.02x closed form"
  std::optional<double> gain, gain_error, offset;  ///< the offset is relative to the closed form's mean
};

struct VerifyRecord {
  std::string created, program, host, command;
  double power = 0, seconds = 0;
  bool interrupted = false;
  std::vector<VerifyEngineRecord> engines{};
  std::vector<VerifyProbe> probes{};
  std::vector<VerifyScene> scenes{};
};

/// The largest minimum detectable error among pairs that agree; empty if none does.
std::optional<double> largest_detectable(const VerifyRecord& record);

/// "1.2 %"; "all" if noise hides everything, a dash if nothing is defined.
std::string error_words(const std::optional<double>& error);

/// Codes as of `gate`: 0 all agree, 1 an engine is wrong, 2 an engine cannot be started, 3 no engine is wrong but a
/// result is unknown; 130 interrupted.
int exit_code_of(const VerifyRecord& record);

/// Both throw InputError "FILE#POINTER" at an impossible value.
VerifyRecord read_verify_record(const std::filesystem::path& file);
void write_verify_record(const VerifyRecord& record, const std::filesystem::path& file);
std::string verify_record_text(const VerifyRecord& record);

/// One probe alone, as stored by its engine's version; empty if the text is none.
std::string verify_probe_text(const VerifyProbe& probe);
std::optional<VerifyProbe> verify_probe_from(const std::string& text);

/// The table for a terminal.
std::string verify_table(const VerifyRecord& record);

/// One row per scene with its engines side by side, for people.
std::string verify_markdown(const VerifyRecord& record);
/// RFC 4180, one row per pair: bias, relmse, ssim and minimum detectable error, all relative.
std::string verify_csv(const VerifyRecord& record);

/// A single self-contained file; pictures are read from `folder`.
void write_verify_page(const VerifyRecord& record, const std::filesystem::path& folder,
                       const std::filesystem::path& out);

}  // namespace photonproof::inline reports_verify
