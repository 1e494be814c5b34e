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

/// Copies the files that a scene names into a folder, and renames them there.
class FileCopies {
 public:
  FileCopies(fs::path from, fs::path to) : from_(std::move(from)), to_(std::move(to)) {}

  void copy(std::string& name) {
    const fs::path source = from_ / name;
    const auto [known, is_new] = copied_.try_emplace(source.lexically_normal().string(), free_name(name));
    const fs::path target = to_ / known->second;
    std::error_code error;
    if (is_new && !fs::equivalent(source, target, error)) {
      fs::create_directories(target.parent_path(), error);
      if (!error) fs::copy_file(source, target, fs::copy_options::overwrite_existing, error);
      if (error) throw InputError(source.string(), "cannot be copied to " + target.string() + ": " + error.message());
    }
    name = known->second;
  }
  std::size_t count() const { return copied_.size(); }

 private:
  /// The name itself if it stays below the scene, else its last part, with a number where another file has that.
  std::string free_name(const std::string& name) {
    const fs::path plain = fs::path(name).lexically_normal();
    fs::path result = plain.is_absolute() || plain.begin()->string() == ".." ? plain.filename() : plain;
    for (int number = 2; !taken_.insert(result.string()).second; ++number)
      result =
          result.parent_path() / (plain.stem().string() + "-" + std::to_string(number) + plain.extension().string());
    return result.string();
  }

  fs::path from_, to_;
  std::map<std::string, std::string> copied_;
  std::set<std::string> taken_;
};

int run_convert(const ConvertArguments& arguments) {
  const fs::path folder = arguments.folder, target = folder / "scene.xml";
  if (fs::exists(target) && !arguments.force)
    throw InputError(target.string(), "already exists (--force overwrites it)");
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw InputError(folder.string(), "cannot be made: " + error.message());
  SceneDescription scene = load_scene_into(arguments.scene, folder.string());
  FileCopies copies(fs::path(scene.files.front()).parent_path(), folder);
  visit_file_names(scene, [&](std::string& name) { copies.copy(name); });
  write_file_atomically(target, write_scene(scene));
  std::printf("%s: shapes %zu, BSDFs %zu, files %zu\n", target.c_str(), scene.shapes.size(), scene.bsdfs.size(),
              copies.count());
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
