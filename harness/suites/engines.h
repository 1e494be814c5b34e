// Engines that render scenes, as data: a program with its command line, behind a process boundary. Our own integrators,
// POV-Ray and a student's program are rows of the same table (engines.toml; a suite may add its own).
#pragma once

#include <string>
#include <vector>

#include "harness/suites/toml_table.h"

namespace photonproof::inline harness_suites {

/// How reliable an engine's image is: its expectation is right, it has a known error that shrinks with the budget, or
/// its error is unknown.
enum class Trust { unbiased, biased, external };
std::string to_string(Trust trust);

struct Engine {
  std::string name;
  std::string title;
  std::vector<std::string> command;  ///< template, see harness/suites/engine_command.h
  /// Each command prints a version as its first line; empty when the engine has none.
  std::vector<std::vector<std::string>> version_commands;
  std::vector<std::string> budget_kinds;  ///< what {budget} may be: "spp", "photons", ...
  Trust trust = Trust::external;
  std::string image_extension = "exr";  ///< of the file it writes at {output}
  bool denoises = false;                ///< its images are filtered, so that nothing is known of their error
  std::string layer{};                  ///< layer of that file with its picture; empty: as read_rendering chooses

  bool accepts(const std::string& budget_kind) const;
};

/// Rows of engines.toml, which is part of this program.
std::vector<Engine> builtin_engines();

/// A row of our own program that no suite names. An empty integrator is the scene's own, with its parameters.
Engine own_row(const std::string& integrator);

/// The [[engine]] rows of a document. Throws InputError with the place on unknown keys, wrong types, unknown
/// placeholders and names that occur twice, in the document or in `existing`.
std::vector<Engine> engines_from_toml(const TomlTable& document, const std::vector<Engine>& existing);

}  // namespace photonproof::inline harness_suites
