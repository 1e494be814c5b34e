// References: a scene's mean image with the variance of that mean, and its provenance. Small ones are committed beside
// the scene as reference-<W>x<H>.exr and .json; all others are kept in a cache by the scene's content.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "reference/store/provenance.h"
#include "scenes/images/image.h"

namespace photonproof::inline reference_store {

struct StoredReference {
  Rendering rendering;  ///< always has the variance of the mean, including rounding to half floats
  Provenance provenance;
  std::filesystem::path file;  ///< the EXR that was read
};

/// The scene's reference of this size: the one beside the scene, else the cache's. Throws InputError when the scene
/// cannot be parsed. Also throws when the reference is missing, cannot be read whole, has a non-finite value, or is not
/// of the scene's present content. The message ends in the command that makes a new one. A bad one beside the
/// scene is an error whatever the cache has. The reference of a scene with a crop is the crop, with its place.
StoredReference load_reference(const std::filesystem::path& scene_file, int width, int height);

/// The same checks on one file; a crop stays a part with its place. The provenance lies beside the file with the
/// extension .json. Messages end in the command `rebuild`.
StoredReference read_reference(const std::filesystem::path& exr, const std::string& scene_hash, int width, int height,
                               const std::string& rebuild);

/// How the pixels of a reference are kept.
enum class ReferenceSamples {
  floats,
  halves,  ///< mean as half floats (reference/store/half_rounding.h); for committed references
};

/// Writes the EXR and, after it, the JSON; fills in `pixels` and `standard_error` and returns the provenance written.
/// Throws InputError when a value is not finite, a variance is negative or missing, or a mean exceeds the largest half
/// float (65504).
Provenance write_reference(const std::filesystem::path& exr, const Rendering& rendering, Provenance provenance,
                           ReferenceSamples samples);

/// Puts a reference beside the scene, as halves. To replace a good one of the scene's present content, `reason` must
/// state why; the new one keeps the old one's list of acceptances and adds one. Throws InputError also when the image
/// has more than 256 x 256 pixels.
Provenance commit_reference(const std::filesystem::path& scene_file, const Rendering& rendering, Provenance provenance,
                            const std::string& reason);

/// The same for an image of any size, in floats: what somebody gives is stored as it is.
Provenance store_given_reference(const std::filesystem::path& scene_file, const Rendering& rendering,
                                 Provenance provenance, const std::string& reason);

/// Throws the errors of commit_reference that depend on the size alone.
void check_committable(const std::filesystem::path& scene_file, int width, int height);

/// Whether a reference beside the scene is good and of this content: replacing it needs a reason.
bool has_good_commit(const std::filesystem::path& scene_file, const std::string& scene_hash, int width, int height);
inline constexpr const char* reason_is_missing =
    "is a good reference of this scene: say why it is replaced with --reason TEXT";

/// sqrt(mean over pixels and channels of variance / (mean^2 + 0.01)): the square root of the relmse that the
/// rendering's own noise causes. Precondition: there is a variance.
double relative_standard_error(const Rendering& rendering);

/// The provenance file of a reference: beside it, with the extension .json.
std::filesystem::path provenance_path(std::filesystem::path exr);

/// <folder of the scene>/reference-<W>x<H>.exr
std::filesystem::path committed_reference_path(const std::filesystem::path& scene_file, int width, int height);

/// $PHOTONPROOF_CACHE, else $XDG_CACHE_HOME/photonproof, else ~/.cache/photonproof. Throws InputError when none of
/// those is set.
std::filesystem::path cache_folder();

/// <cache>/references/<scene hash>-<W>x<H>: the cache's reference.exr and .json of this content, and the files they are
/// made from.
std::filesystem::path cached_reference_folder(const std::string& scene_hash, int width, int height);

/// "photonproof reference SCENE --size WxH", with " --commit" where the reference belongs beside the scene.
std::string reference_command(const std::filesystem::path& scene_file, int width, int height, bool commit);

/// "2026-01-31T12:00:00Z"
std::string utc_now();

}  // namespace photonproof::inline reference_store
