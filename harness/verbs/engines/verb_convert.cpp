// photonproof convert: a scene or a model as a folder with a scene in this format and all its files.

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <set>

#include "harness/verbs/scene_options.h"
#include "harness/verbs/usage/verb_usage.h"
#include "harness/verbs/verbs.h"
#include "scenes/base/input_error.h"
#include "scenes/description/file_names.h"
#include "scenes/dialect/model_file.h"
#include "scenes/files/atomic_file.h"
#include "scenes/files/scratch_folder.h"
#include "scenes/parser/parser.h"
#include "scenes/xml/writer.h"

namespace photonproof::inline harness_verbs_engines {
namespace {

namespace fs = std::filesystem;

struct ConvertArguments {
  SceneOptions scene;
  std::string folder;
  bool force = false;
};

/// Gathers the files that a scene names, and gives them names within a folder.
class FileNames {
 public:
  explicit FileNames(fs::path from) : from_(std::move(from)) {}

  void gather(std::string& name) {
    const fs::path source = (from_ / name).lexically_normal();
    const auto known = names_.find(source);
    name = known != names_.end() ? known->second : names_[source] = free_name(name);
  }
  /// Source and name of every file.
  const std::map<fs::path, std::string>& all() const { return names_; }

 private:
  /// The name itself if it stays below the scene, else its last part, with a number where another file has that.
  std::string free_name(const std::string& name) {
    const fs::path plain = fs::path(name).lexically_normal();
    const fs::path kept = plain.is_absolute() || plain.begin()->string() == ".." ? plain.filename() : plain;
    fs::path result = kept;
    for (int number = 2; !taken_.insert(result.string()).second; ++number)
      result = kept.parent_path() / (plain.stem().string() + "-" + std::to_string(number) + plain.extension().string());
    return result.string();
  }

  fs::path from_;
  std::map<fs::path, std::string> names_;
  std::set<std::string> taken_{"scene.xml"};
};

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw InputError(folder.string(), "cannot be made: " + error.message());
}

/// Throws InputError if a file of another content would be lost, or could not be replaced.
void check_nothing_is_lost(const fs::path& source, const fs::path& target, bool force) {
  std::error_code error;
  if (!fs::exists(target, error) || fs::equivalent(source, target, error)) return;
  if (!force) throw InputError(target.string(), "already exists (--force overwrites it)");
  check_replaceable(target);
}

/// Throws InputError where the scene would replace a text that it was read from.
void check_is_not_read(const SceneDescription& scene, const fs::path& target) {
  std::error_code error;
  for (const std::string& file : scene.files)
    if (fs::equivalent(file, target, error))
      throw InputError(target.string(), "is the scene that is read, expected another folder");
}

void copy_whole(const fs::path& source, const fs::path& target) {
  std::error_code error;
  if (fs::equivalent(source, target, error)) return;
  make_folder(target.parent_path());
  replace_atomically(target, [&](const fs::path& temporary) {
    fs::copy_file(source, temporary, fs::copy_options::overwrite_existing, error);
    if (error) throw InputError(source.string(), "cannot be copied to " + target.string() + ": " + error.message());
  });
}

int run_convert(const ConvertArguments& arguments) {
  const fs::path folder = arguments.folder, target = folder / "scene.xml";
  if (fs::exists(target) && !arguments.force)
    throw InputError(target.string(), "already exists (--force overwrites it)");
  // A model that cannot be read leaves nothing in the folder.
  const ScratchFolder scratch("convert");
  SceneDescription scene = load_scene_into(arguments.scene, scratch.path().string());
  FileNames files(fs::path(scene.files.front()).parent_path());
  visit_file_names(scene, [&](std::string& name) { files.gather(name); });
  check_is_not_read(scene, target);
  for (const auto& [source, name] : files.all()) check_nothing_is_lost(source, folder / name, arguments.force);
  make_folder(folder);
  for (const auto& [source, name] : files.all()) copy_whole(source, folder / name);
  write_file_atomically(target, write_scene(scene));
  std::printf("%s: shapes %zu, BSDFs %zu, files %zu\n", target.c_str(), scene.shapes.size(), scene.bsdfs.size(),
              files.all().size());
  for (const SceneNote& note : scene.notes) std::printf("note: %s: %s\n", note.where.c_str(), note.text.c_str());
  return 0;
}

}  // namespace

void add_convert_verb(CLI::App& program, int& exit_code) {
  auto arguments = std::make_shared<ConvertArguments>();
  CLI::App* verb = add_verb(
      program, {.name = "convert",
                .group = render_group,
                .purpose = "Write a scene of Mitsuba or pbrt, or a glTF, OBJ or PLY model, in this format",
                .examples = {"photonproof convert model.glb model", "photonproof convert old.xml new --lenient"},
                .exit_codes = {done, bad_input, internal_error}});
  add_scene_options(*verb, arguments->scene);
  verb->add_option("FOLDER", arguments->folder, "folder to write scene.xml and its files into")->required();
  verb->add_flag("--force", arguments->force, "overwrite a scene in FOLDER");
  verb->callback([arguments, &exit_code] { exit_code = run_convert(*arguments); });
}

}  // namespace photonproof::inline harness_verbs_engines
