// The origin of a stored reference: the JSON beside its EXR, for people, for diffs, and for the checks on reading.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace photonproof::inline reference_store {

/// One replacement of a reference by another, with its reason.
struct Acceptance {
  std::string date;  ///< UTC, ISO 8601
  std::string reason;
  std::map<std::string, std::string> before, after;  ///< facts() of the old and of the new one
  friend bool operator==(const Acceptance&, const Acceptance&) = default;
};

/// An independent reference: its estimator shares no sampling path with the first, and agrees with it.
struct ReferenceWitness {
  std::string estimator;
  std::uint64_t samples = 0;          ///< per pixel, in all batches
  double standard_error = 0;          ///< relative, of its pixels
  std::optional<double> would_see{};  ///< minimum detectable relative error of the mean, with probability 0.99
  friend bool operator==(const ReferenceWitness&, const ReferenceWitness&) = default;
};

/// The origin of a reference that none of our own integrators rendered: images that somebody gave, or an engine's.
struct GivenImages {
  std::string noise;                      ///< the source of the variance: "images", "stated" or "unknown"
  std::uint64_t images = 0;               ///< that the mean is of
  std::vector<std::string> files;         ///< names, without folders; empty where an engine rendered the images
  std::vector<std::string> checksums;     ///< one a file
  std::optional<std::string> transfer{};  ///< that the values were decoded from; empty: linear
  std::optional<std::string> command{};   ///< of the engine, for its first image
  friend bool operator==(const GivenImages&, const GivenImages&) = default;
};
inline constexpr const char* noise_of_images = "images";  ///< from the differences between several images
inline constexpr const char* stated_noise = "stated";     ///< by a variance image
inline constexpr const char* unknown_noise = "unknown";   ///< one image without a variance

struct Provenance {
  std::string scene_hash;                ///< of the scene and its assets (scenes/description/scene_hash.h)
  std::vector<std::string> definitions;  ///< "name=value" of -D, sorted; empty: the unchanged scene
  int width = 0, height = 0;
  std::string estimator;             ///< The integrator: "bdpt".
  std::uint64_t samples = 0;         ///< Per pixel, in all batches.
  std::vector<std::uint64_t> seeds;  ///< One per independent batch; the variance has one degree of freedom less.
  double standard_error = 0;         ///< Relative, of the pixels as stored (reference_store.h).
  /// Relative bias of the pixels as the estimator states it: progressive photon mapping's radius is never 0. The truth
  /// is within both errors together. 0: unbiased.
  double bias = 0;
  /// Empty for references older than this check, and where no other estimator renders the scene.
  std::optional<ReferenceWitness> witness{};
  std::optional<GivenImages> given{};  ///< empty: our own integrators' batches
  std::string pixels;                  ///< checksum of the stored mean and variance
  std::map<std::string, std::string> versions;
  std::string host;
  std::string date;                     ///< UTC, ISO 8601
  std::vector<Acceptance> acceptances;  ///< oldest first
  friend bool operator==(const Provenance&, const Provenance&) = default;
};

/// Whether nothing states the reference's noise: it is one image without a variance, which may have any.
inline bool has_unknown_noise(const Provenance& provenance) {
  return provenance.given && provenance.given->noise == unknown_noise;
}

/// The degrees of freedom of the reference's variance. A stated variance has those of 32 batches.
double freedom_of(const Provenance& provenance);

/// Facts as text: "estimator", "samples", "batches", "standard_error", "scene_hash", "pixels", "date", "host" and
/// "version", and "definitions" and "witness" where there are any. Used in reports and in an Acceptance.
std::map<std::string, std::string> facts(const Provenance& provenance);

/// Indented JSON that ends in a line break. Precondition: the standard error is finite.
std::string provenance_text(const Provenance& provenance);

/// Throws InputError, naming `file`, when the text is not JSON, lacks a key, or has an unknown key or an impossible
/// value.
Provenance parse_provenance(const std::string& text, const std::string& file);

}  // namespace photonproof::inline reference_store
