// The result of a soak: the record soak.json, and its one line.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "harness/stress/soak/drift.h"

namespace photonproof::inline harness_stress_soak {

/// One quantity over the cycles of a soak.
struct SoakSeries {
  std::string name;            ///< "peak memory of a render's process".
  std::string unit;            ///< "bytes".
  std::vector<double> values;  ///< One a cycle, including the warm-up.
  std::size_t warm_up = 0;     ///< Cycles that the drift leaves out.
  double bound = 0;            ///< A growth a render that is too small to matter.
  Drift drift{};               ///< Growth a render.
};

/// A scene, a way to render it, and the one checksum of all its images.
struct SoakKind {
  std::string scene, method;
  std::string checksum;
  std::string refused;  ///< The program's message where it refuses the kind; such a kind is not repeated.
};

struct SoakRecord {
  std::string created, program, checksum, command, host;
  std::uint64_t asked = 0;  ///< Renders by processes, and as many within one.
  std::uint64_t by_processes = 0, within_one = 0;
  std::vector<SoakKind> kinds;
  std::vector<SoakSeries> series;
  std::vector<std::string> problems;  ///< A sentence each: an image with different bits, a failed render, a new file.
  double seconds = 0;
  bool interrupted = false;

  /// grows if a series grows or there is a problem; unclear if a series is.
  DriftVerdict verdict() const;
};

/// "flat: 1000 renders by processes and 1000 within one ...": one line without its end.
std::string soak_sentence(const SoakRecord& record);

void write_soak_record(const SoakRecord& record, const std::filesystem::path& file);

}  // namespace photonproof::inline harness_stress_soak
