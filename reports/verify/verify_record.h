// The record of `photonproof verify`: which engines agree on a scene, how small an error each pair would have shown,
// and who is wrong where they do not. verify.schema.json is its contract.
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
  std::string problem{};  ///< why it cannot be used; empty where it can
};

/// One engine's picture of one scene, or why there is none.
struct VerifyPicture {
  std::string engine;
  std::string status;  ///< "ok", "unsupported", "crash" ... (results.h)
  std::string detail;  ///< why there is no picture
  std::string command;
  double seconds = 0;         ///< wall time of its processes
  std::uint64_t samples = 0;  ///< a pixel; 0 where its budget does not count them
  std::array<double, 3> mean{};
  double declared_whole = 0, declared_block = 0;  ///< relative errors that are known
  std::string declared_reason;
  std::vector<std::string> losses;
  std::string picture;  ///< PNG, relative to the record
};

/// What stands beside engines in pairs.
inline constexpr const char *closed_form_side = "closed form", *stored_reference_side = "stored reference";

struct VerifyPair {
  std::string first, second;  ///< engines, and those two
  std::string verdict;        ///< "agree", "differ", "undecided"
  std::string sentence;       ///< how they differ
  std::array<double, 3> shift{};
  std::optional<double> whole_shift;  ///< of the channels that differ together, else of all
  std::optional<double> would_see;    ///< the least relative error of the mean that shows with probability 0.99
  std::optional<double> relmse, ssim;
  /// What tables show: whole_shift, or without one that of the channel which is off most, signed.
  double shown_shift() const;
};

/// One that is wrong, or one of those of which one is.
struct VerifyFault {
  std::string engine;
  std::string sentence;  ///< by how much, where, in which channel
  std::string place;     ///< in words of what the scene shows there: "below the glass sphere"
  std::string pass;      ///< "direct", "caustic" ... ; empty: not found
  std::string pass_words;
  std::string pass_sentence;                                   ///< how it is off there
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
};

/// In either order; null where they were not compared.
const VerifyPair* pair_between(const VerifyScene& scene, const std::string& a, const std::string& b);

/// One micro-scene by one engine, fitted to its closed form: image = gain * closed form + offset.
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

/// "1.2 %"; "all" where noise hides everything, a dash where nothing is defined.
std::string error_words(const std::optional<double>& error);

/// gate's: 0 all agree, 1 something is wrong, 2 an engine cannot be started, 3 nothing is wrong but something is not
/// known; 130 interrupted.
int exit_code_of(const VerifyRecord& record);

/// Both throw InputError "FILE#POINTER" at a value that cannot be.
VerifyRecord read_verify_record(const std::filesystem::path& file);
void write_verify_record(const VerifyRecord& record, const std::filesystem::path& file);
std::string verify_record_text(const VerifyRecord& record);

/// One probe alone, as it is kept by its engine's version; empty where the text is none.
std::string verify_probe_text(const VerifyProbe& probe);
std::optional<VerifyProbe> verify_probe_from(const std::string& text);

/// The table for a terminal.
std::string verify_table(const VerifyRecord& record);

/// A row a scene, engines beside each other: for people.
std::string verify_markdown(const VerifyRecord& record);
/// RFC 4180, a row a pair: its bias, relmse and ssim, and the error that it would have shown, all relative.
std::string verify_csv(const VerifyRecord& record);

/// One file that needs no other; pictures are read from `folder`.
void write_verify_page(const VerifyRecord& record, const std::filesystem::path& folder,
                       const std::filesystem::path& out);

}  // namespace photonproof::inline reports_verify
