#include "harness/references/suite_scene.h"

#include <algorithm>
#include <vector>

#include "harness/suites/suite_rows.h"
#include "scenes/base/input_error.h"
#include "scenes/base/shell_text.h"
#include "scenes/description/scene_hash.h"
#include "scenes/files/checksum.h"
#include "scenes/files/file_checksum.h"
#include "scenes/parser/parser.h"

namespace photonproof::inline harness_references {
namespace {

namespace fs = std::filesystem;

void add_text(Checksum& checksum, const std::string& text) {
  const std::uint64_t size = text.size();
  checksum.add(&size, sizeof size);
  checksum.add(text.data(), text.size());
}

/// Adds names and bytes of a folder's files in the order of their names; hidden ones do not count.
void add_folder(Checksum& checksum, const fs::path& folder) {
  std::vector<fs::path> files;
  for (auto entry = fs::recursive_directory_iterator(folder, fs::directory_options::follow_directory_symlink);
       entry != fs::recursive_directory_iterator(); ++entry) {
    const bool is_hidden = entry->path().filename().native().front() == '.';
    if (is_hidden && entry->is_directory()) entry.disable_recursion_pending();
    if (!is_hidden && entry->is_regular_file()) files.push_back(entry->path().lexically_relative(folder));
  }
  std::ranges::sort(files);
  for (const fs::path& file : files) {
    add_text(checksum, file.generic_string());
    add_text(checksum, file_checksum(folder / file));
  }
}

std::string hash_of_opaque(const SuiteScene& scene) {
  Checksum checksum;
  try {
    if (scene.reader == SceneReader::engine_by_word) {
      add_text(checksum, "word");
      add_text(checksum, scene.given_path);
    } else if (fs::is_directory(scene.path)) {
      add_text(checksum, "folder");
      add_folder(checksum, scene.path);
    } else {
      add_text(checksum, "file");
      const std::string bytes = file_checksum(scene.path);
      if (bytes.empty()) throw InputError(scene.path.string(), "cannot be read");
      add_text(checksum, bytes);
    }
  } catch (const fs::filesystem_error& error) {
    throw InputError(scene.path.string(), "cannot be read: " + std::string(error.code().message()));
  }
  return checksum.hex();
}

}  // namespace

SceneContent content_of(const SuiteScene& scene) {
  if (scene.is_opaque()) return {hash_of_opaque(scene), {}};
  try {
    const SceneDescription description = parse_scene_file(scene.path.string());
    return {scene_hash(description), crop_of(description.sensor.film, scene.width, scene.height)};
  } catch (const InputError& error) {
    throw with_reader_advice(error, scene.name, scene.suite_file);
  }
}

std::optional<Expect> expectations_of(const SuiteScene& scene) {
  if (scene.is_opaque()) return std::nullopt;
  const std::string path = expect_path_of(scene.path.string());
  return fs::exists(path) ? std::optional(read_expect(path)) : std::nullopt;
}

ParameterValues viewing_of(const SuiteScene& scene) {
  const std::optional<Expect> expect = expectations_of(scene);
  if (!expect) return {.exposure = scene.exposure.value_or(0)};
  return {.exposure = scene.exposure.value_or(expect->exposure), .hdr_exposures = expect->hdr_exposures};
}

std::optional<std::string> note_on_opaque(const std::vector<const SuiteScene*>& scenes) {
  std::string names;
  for (const SuiteScene* scene : scenes)
    if (scene->is_opaque()) names += (names.empty() ? "" : ", ") + scene->name;
  if (names.empty()) return std::nullopt;
  return "only the engine reads " + names +
         ": our own integrators, verify and the diagnosis by parts of light do not apply";
}

fs::path stored_beside(const SuiteScene& scene) {
  if (!scene.is_opaque()) return scene.path;
  const fs::path folder = scene.suite_file.parent_path() / "references" / scene.name;
  return folder / (scene.reader == SceneReader::engine ? fs::absolute(scene.path).lexically_normal().filename()
                                                       : fs::path("scene"));
}

std::string opaque_reference_command(const SuiteScene& scene) {
  return shell_line({"photonproof", "reference", scene.suite_file.string(), "--scene", scene.name});
}

StoredReference reference_of(const SuiteScene& scene) {
  const SceneContent content = content_of(scene);
  if (!scene.is_opaque()) return load_reference(scene.path, scene.width, scene.height);
  const fs::path exr = committed_reference_path(stored_beside(scene), scene.width, scene.height);
  const std::string command = opaque_reference_command(scene),
                    make = command + " --from IMAGE, or " + command + " --engine NAME";
  if (!fs::exists(exr) && !fs::exists(provenance_path(exr)))
    throw InputError(scene.given_path, "scene '" + scene.name + "' has no reference: there is no " + exr.string() +
                                           "; make it with: " + make);
  return read_reference(exr, content.hash, scene.width, scene.height, make);
}

}  // namespace photonproof::inline harness_references
