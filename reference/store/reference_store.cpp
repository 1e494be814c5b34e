#include "reference/store/reference_store.h"

#include <cmath>
#include <cstdlib>
#include <ctime>
#include <tuple>
#include <utility>

#include "reference/store/half_rounding.h"
#include "scenes/base/input_error.h"
#include "scenes/base/size_text.h"
#include "scenes/description/film_part.h"
#include "scenes/description/scene_hash.h"
#include "scenes/files/atomic_file.h"
#include "scenes/files/checksum.h"
#include "scenes/parser/parser.h"

namespace photonproof::inline reference_store {
namespace {

namespace fs = std::filesystem;

constexpr int largest_committed_pixels = 256 * 256;

std::string checksum_of(const Rendering& rendering) {
  Checksum checksum;
  for (const Image* image : {&rendering.mean, &*rendering.variance})
    checksum.add(image->rgb.data(), image->rgb.size() * sizeof(float));
  return checksum.hex();
}

/// Size of the whole image, where the rendering is a part of one.
std::pair<int, int> whole_size(const Rendering& rendering) {
  return rendering.place ? std::pair(rendering.place->width, rendering.place->height)
                         : std::pair(rendering.mean.width, rendering.mean.height);
}

std::string place_of(const Image& image, std::size_t value) {
  const auto width = static_cast<std::size_t>(image.width);
  return "pixel (" + std::to_string(value / 3 % width) + ", " + std::to_string(value / 3 / width) + ") " +
         "RGB"[value % 3];
}

/// Why the values cannot be a reference's; empty when they can.
std::string defect_of(const Rendering& rendering) {
  if (!rendering.variance) return "has no variance";
  for (std::size_t i = 0; i < rendering.mean.rgb.size(); ++i) {
    if (!std::isfinite(rendering.mean.rgb[i])) return place_of(rendering.mean, i) + " is not finite";
    const float variance = rendering.variance->rgb[i];
    if (!std::isfinite(variance)) return "the variance of " + place_of(rendering.mean, i) + " is not finite";
    if (variance < 0) return "the variance of " + place_of(rendering.mean, i) + " is negative";
  }
  return {};
}

void check_halves(const fs::path& exr, const Image& mean) {
  for (std::size_t i = 0; i < mean.rgb.size(); ++i)
    if (std::abs(mean.rgb[i]) > largest_half)
      throw InputError(exr.string(), place_of(mean, i) + " is " + std::to_string(mean.rgb[i]) +
                                         ", more than a half float can be (65504): keep this reference in the cache");
}

/// Throws the defect's message, without the command.
StoredReference checked(const fs::path& exr, const std::string& hash, int width, int height) {
  const fs::path json = provenance_path(exr);
  StoredReference stored{{}, parse_provenance(read_file(json), json.string()), exr};
  const Provenance& p = stored.provenance;
  const auto refuse = [&](const std::string& what) { throw InputError(exr.string(), what); };
  if (p.scene_hash != hash)
    refuse("is out of date: the scene's content is now " + hash + ", this reference is of " + p.scene_hash);
  stored.rendering = read_rendering(exr.string(), "", ImageWindow::stored);
  const auto [image_width, image_height] = whole_size(stored.rendering);
  if (image_width != width || image_height != height || p.width != width || p.height != height)
    refuse("is " + size_text(image_width, image_height) + " and its provenance of " + size_text(p.width, p.height) +
           ", expected " + size_text(width, height));
  if (const std::string defect = defect_of(stored.rendering); !defect.empty()) refuse(defect);
  if (checksum_of(stored.rendering) != p.pixels) refuse("does not hold the pixels its provenance is of");
  return stored;
}

/// For a POSIX shell.
std::string quoted(const std::string& word) {
  const bool plain =
      word.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_./+-=@%,:") ==
      std::string::npos;
  if (plain && !word.empty()) return word;
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

std::string folder_from(const char* variable) {
  const char* value = std::getenv(variable);
  return value == nullptr ? "" : value;
}

bool is_there(const fs::path& file) {
  std::error_code ignored;
  return fs::exists(file, ignored);
}

}  // namespace

fs::path provenance_path(fs::path exr) { return exr.replace_extension(".json"); }

StoredReference read_reference(const fs::path& exr, const std::string& hash, int width, int height,
                               const std::string& rebuild) {
  try {
    return checked(exr, hash, width, height);
  } catch (const InputError& error) {
    std::string text = error.summary();
    // The place comes first in the sentence already.
    const std::string separator = ": error: ";
    const std::size_t at = text.find(separator);
    throw InputError(text.substr(0, at), text.substr(at + separator.size()) + "; make it again with: " + rebuild);
  }
}

namespace {

/// A reference of the whole film is cut to the scene's crop.
StoredReference without_surroundings(StoredReference stored, const FilmDescription& film, int width, int height) {
  const FilmPart part = crop_of(film, width, height).value_or(whole_film(width, height));
  stored.rendering = *part_of(std::move(stored.rendering), part);  // the film's size has been checked
  return stored;
}

}  // namespace

StoredReference load_reference(const fs::path& scene_file, int width, int height) {
  const SceneDescription scene = parse_scene_file(scene_file.string());
  const std::string hash = scene_hash(scene);
  const auto read = [&](const fs::path& exr, const std::string& command) {
    return without_surroundings(read_reference(exr, hash, width, height, command), scene.sensor.film, width, height);
  };
  const fs::path beside = committed_reference_path(scene_file, width, height);
  if (is_there(beside) || is_there(provenance_path(beside)))
    return read(beside, reference_command(scene_file, width, height, true));
  const std::string command = reference_command(scene_file, width, height, false);
  const fs::path cached = cached_reference_folder(hash, width, height) / "reference.exr";
  if (is_there(provenance_path(cached))) return read(cached, command);
  throw InputError(scene_file.string(), "has no reference of " + size_text(width, height) + " pixels, neither " +
                                            beside.filename().string() + " beside it nor in the cache " +
                                            cache_folder().string() + "; make it with: " + command);
}

Provenance write_reference(const fs::path& exr, const Rendering& rendering, Provenance provenance,
                           ReferenceSamples samples) {
  if (const std::string defect = defect_of(rendering); !defect.empty()) throw InputError(exr.string(), defect);
  const bool halves = samples == ReferenceSamples::halves;
  if (halves) check_halves(exr, rendering.mean);
  Rendering stored = halves ? rounded_to_halves(rendering) : rendering;
  stored.metadata.clear();  // equal pixels, equal bytes; everything else is in the JSON
  std::tie(provenance.width, provenance.height) = whole_size(stored);
  provenance.pixels = checksum_of(stored);
  provenance.standard_error = relative_standard_error(stored);
  // A process that ends between the two writes leaves pixels that do not fit; reading detects this.
  write_exr(exr.string(), stored, halves ? ExrColour::half : ExrColour::single);
  write_file_atomically(provenance_path(exr), provenance_text(provenance));
  return provenance;
}

void check_committable(const fs::path& scene_file, int width, int height) {
  if (std::int64_t{width} * height > largest_committed_pixels)
    throw InputError(scene_file.string(),
                     "a reference of " + size_text(width, height) +
                         " pixels is too large to be committed (256x256 at most): keep it in the cache");
}

bool has_good_commit(const fs::path& scene_file, const std::string& hash, int width, int height) {
  try {
    checked(committed_reference_path(scene_file, width, height), hash, width, height);
    return true;
  } catch (const InputError&) {
    return false;
  }
}

namespace {

/// Puts a reference beside the scene; see commit_reference.
Provenance put_beside(const fs::path& scene_file, const Rendering& rendering, Provenance provenance,
                      const std::string& reason, ReferenceSamples samples) {
  const auto [width, height] = whole_size(rendering);
  const fs::path exr = committed_reference_path(scene_file, width, height);
  std::optional<Provenance> old;
  bool good = false;
  if (is_there(provenance_path(exr))) {
    try {
      old = parse_provenance(read_file(provenance_path(exr)), exr.string());
      good = checked(exr, provenance.scene_hash, width, height).provenance == *old;
    } catch (const InputError&) {
      // A damaged one needs no reason to be replaced, nor does one of other content.
    }
  }
  // There already: a cached one may be committed twice. A given one is made anew each time, if within the same second.
  const bool is_made_anew = samples == ReferenceSamples::floats && !reason.empty();
  if (good && old->date == provenance.date && old->seeds == provenance.seeds && !is_made_anew) return *old;
  if (good && reason.empty()) throw InputError(exr.string(), reason_is_missing);
  if (old) provenance.acceptances = old->acceptances;
  const Provenance written = write_reference(exr, rendering, provenance, samples);
  if (!old) return written;
  const std::string why = !reason.empty()                            ? reason
                          : old->scene_hash != provenance.scene_hash ? "the scene has changed"
                                                                     : "the old one was damaged";
  provenance.acceptances.push_back({utc_now(), why, facts(*old), facts(written)});
  return write_reference(exr, rendering, provenance, samples);
}

}  // namespace

Provenance commit_reference(const fs::path& scene_file, const Rendering& rendering, Provenance provenance,
                            const std::string& reason) {
  const auto [width, height] = whole_size(rendering);
  check_committable(scene_file, width, height);
  return put_beside(scene_file, rendering, std::move(provenance), reason, ReferenceSamples::halves);
}

Provenance store_given_reference(const fs::path& scene_file, const Rendering& rendering, Provenance provenance,
                                 const std::string& reason) {
  return put_beside(scene_file, rendering, std::move(provenance), reason, ReferenceSamples::floats);
}

double relative_standard_error(const Rendering& rendering) {
  constexpr double epsilon = 0.01;  // as in relmse
  double sum = 0;
  const std::vector<float>& mean = rendering.mean.rgb;
  for (std::size_t i = 0; i < mean.size(); ++i)
    sum += double{rendering.variance->rgb[i]} / (double{mean[i]} * mean[i] + epsilon);
  return std::sqrt(sum / static_cast<double>(mean.size()));
}

fs::path committed_reference_path(const fs::path& scene_file, int width, int height) {
  return scene_file.parent_path() / ("reference-" + size_text(width, height) + ".exr");
}

fs::path cache_folder() {
  if (const std::string own = folder_from("PHOTONPROOF_CACHE"); !own.empty()) return own;
  if (const std::string cache = folder_from("XDG_CACHE_HOME"); !cache.empty()) return fs::path(cache) / "photonproof";
  if (const std::string home = folder_from("HOME"); !home.empty()) return fs::path(home) / ".cache" / "photonproof";
  throw InputError("PHOTONPROOF_CACHE", "is not set, nor is HOME: there is no folder for references");
}

fs::path cached_reference_folder(const std::string& hash, int width, int height) {
  return cache_folder() / "references" / (hash + "-" + size_text(width, height));
}

std::string reference_command(const fs::path& scene_file, int width, int height, bool commit) {
  return "photonproof reference " + quoted(scene_file.string()) + " --size " + size_text(width, height) +
         (commit ? " --commit" : "");
}

std::string utc_now() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text;
}

}  // namespace photonproof::inline reference_store
