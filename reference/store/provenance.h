// Where a stored reference comes from: the JSON beside its EXR, for people, for diffs, and for the checks on reading.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace photonproof::inline reference_store {

/// One time that somebody replaced a reference by another, and why.
struct Acceptance {
  std::string date;  ///< UTC, ISO 8601
  std::string reason;
  std::map<std::string, std::string> before, after;  ///< facts() of the old and of the new one
  friend bool operator==(const Acceptance&, const Acceptance&) = default;
};

/// The second parent: an estimator that shares no sampling path with the first, and agrees with it.
struct ReferenceWitness {
  std::string estimator;
  std::uint64_t samples = 0;          ///< a pixel, in all batches
  double standard_error = 0;          ///< relative, of its pixels
  std::optional<double> would_see{};  ///< the least relative error of the mean that shows with probability 0.99
  friend bool operator==(const ReferenceWitness&, const ReferenceWitness&) = default;
};

struct Provenance {
  std::string scene_hash;                ///< of the scene and its assets (scenes/description/scene_hash.h)
  std::vector<std::string> definitions;  ///< "name=value" of -D, sorted; empty: the scene as it is
  int width = 0, height = 0;
  std::string estimator;             ///< the integrator: "bdpt"
  std::uint64_t samples = 0;         ///< a pixel, in all batches
  std::vector<std::uint64_t> seeds;  ///< one an independent batch; the variance has one degree of freedom less
  double standard_error = 0;         ///< relative, of the pixels as stored (reference_store.h)
  /// Relative, of the pixels, as the estimator knows it itself: of progressive photon mapping, whose radius is never 0.
  /// The truth is within both of them together. 0: unbiased.
  double bias = 0;
  /// Empty of references from before there were any, and where no other estimator renders the scene.
  std::optional<ReferenceWitness> witness{};
  std::string pixels;  ///< checksum of the stored mean and variance
  std::map<std::string, std::string> versions;
  std::string host;
  std::string date;                       ///< UTC, ISO 8601
  std::vector<Acceptance> state_of_path;  ///< oldest first
  friend bool operator==(const Provenance&, const Provenance&) = default;
};

/// In words: "estimator", "samples", "batches", "standard_error", "scene_hash", "pixels", "date", "host" and
/// "version", and "definitions" and "witness" where there are any. For reports, and for what an Acceptance keeps.
std::map<std::string, std::string> facts(const Provenance& provenance);

/// Indented JSON that ends in a line break. Precondition: the standard error is finite.
std::string provenance_text(const Provenance& provenance);

/// Throws InputError, naming `file`, when the text is not JSON, lacks a key, has one that is not known, or a value that
/// cannot be.
Provenance parse_provenance(const std::string& text, const std::string& file);

}  // namespace photonproof::inline reference_store
