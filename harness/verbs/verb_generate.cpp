// photonproof generate: writes scenes that are made rather than stored.

#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "harness/verbs/usage/verb_usage.h"
#include "harness/verbs/verbs.h"
#include "scenes/base/input_error.h"
#include "scenes/files/atomic_file.h"
#include "scenes/generators/library_assets.h"
#include "scenes/generators/many_lights.h"
#include "scenes/generators/million.h"
#include "scenes/generators/showcase_assets.h"
#include "scenes/generators/showcase_shapes.h"

namespace photonproof::inline harness_verbs {
namespace {

namespace fs = std::filesystem;

struct GenerateArguments {
  std::string triangles;
  int lights = 1000;
  double detail = 1;
  std::string folder;
  bool force = false;
};

/// "1000000" or "1e6"; throws InputError on anything else and outside the range.
std::uint64_t triangle_count(const std::string& text) {
  double count = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
  const bool whole = error == std::errc{} && end == text.data() + text.size() && count == std::floor(count);
  if (!whole || count < static_cast<double>(kFewestTriangles) || count > static_cast<double>(kMostTriangles))
    throw InputError("--triangles", "'" + text + "' is not a whole number from 1e3 to 1e7");
  return static_cast<std::uint64_t>(count);
}

/// Throws InputError when a file would be overwritten without leave.
void check_free(const fs::path& folder, const std::vector<std::string>& files, bool force) {
  for (const std::string& file : files)
    if (!force && fs::exists(folder / file))
      throw InputError((folder / file).string(), "already exists (--force overwrites it)");
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw InputError(folder.string(), "cannot be made: " + error.message());
}

int run_million(const GenerateArguments& arguments) {
  const MillionPlan plan = plan_million(triangle_count(arguments.triangles));
  const fs::path folder = arguments.folder;
  check_free(folder, million_files(), arguments.force);
  make_folder(folder);
  write_million(folder, plan);
  std::printf("%s: %llu triangles; %u rocks of %d triangles each\n", (folder / "scene.xml").c_str(),
              static_cast<unsigned long long>(plan.triangles()), plan.rocks, 20 << (2 * plan.rock_level));
  return 0;
}

int run_many_lights(const GenerateArguments& arguments) {
  const fs::path folder = arguments.folder;
  check_free(folder, {"scene.xml", "expect.toml"}, arguments.force);
  make_folder(folder);
  write_file_atomically(folder / "scene.xml", many_lights_scene(arguments.lights));
  write_file_atomically(folder / "expect.toml", many_lights_expect(arguments.lights));
  std::printf("%s: %d lights\n", (folder / "scene.xml").c_str(), arguments.lights);
  return 0;
}

/// Writes the files of a table of assets; `write_one` takes one and its file.
template <class Asset, class Write>
int write_assets(const std::vector<Asset>& assets, const GenerateArguments& arguments, const Write& write_one) {
  const fs::path folder = arguments.folder;
  std::vector<std::string> files;
  for (const Asset& asset : assets) files.push_back(asset.path);
  check_free(folder, files, arguments.force);
  for (const Asset& asset : assets) {
    make_folder((folder / asset.path).parent_path());
    write_one(asset, folder / asset.path);
    std::printf("%s\n", (folder / asset.path).c_str());
  }
  return 0;
}

int run_assets(const GenerateArguments& arguments) {
  return write_assets(library_assets(), arguments,
                      [](const LibraryAsset& asset, const fs::path& file) { asset.write(file); });
}

int run_showcase(const GenerateArguments& arguments) {
  return write_assets(showcase_assets(), arguments,
                      [&](const ShowcaseAsset& asset, const fs::path& file) { asset.write(file, arguments.detail); });
}

/// Where to write, and whether over what is there: every scene's options.
void add_folder_options(CLI::App& verb, GenerateArguments& arguments) {
  begin_option_group(verb, output_group);
  verb.add_option("-o,--output", arguments.folder, "folder to write; made when it does not exist")->required();
  verb.add_flag("--force", arguments.force, "overwrite the files of an earlier scene");
}

}  // namespace

void add_generate_verb(CLI::App& program, int& exit_code) {
  CLI::App* verb =
      add_verb(program, {.name = "generate",
                         .group = render_group,
                         .purpose = "Write a scene, or files of the scene library, that are computed and not stored",
                         .examples = {"photonproof generate million --triangles 1e6 -o million",
                                      "photonproof generate many-lights --lights 1000 -o many-lights",
                                      "photonproof generate showcase --detail 10 -o showcase"},
                         .exit_codes = {done, bad_input, internal_error}});
  verb->require_subcommand(1);
  auto arguments = std::make_shared<GenerateArguments>();
  CLI::App* million = verb->add_subcommand("million", "A landscape of as many triangles as asked for");
  million->group("Scenes");
  begin_option_group(*million, input_group);
  million->add_option("--triangles", arguments->triangles, "number of triangles, from 1e3 to 1e7, met within 1 %")
      ->required();
  add_folder_options(*million, *arguments);
  million->callback([arguments, &exit_code] { exit_code = run_million(*arguments); });
  CLI::App* many_lights =
      verb->add_subcommand("many-lights", "Blocks and balls among as many small lights as asked for");
  many_lights->group("Scenes");
  begin_option_group(*many_lights, input_group);
  many_lights->add_option("--lights", arguments->lights, "number of lights")
      ->check(CLI::Range(kFewestLights, kMostLights))
      ->capture_default_str();
  add_folder_options(*many_lights, *arguments);
  many_lights->callback([arguments, &exit_code] { exit_code = run_many_lights(*arguments); });
  CLI::App* assets = verb->add_subcommand("assets", "The textures, meshes and light data of the scene library");
  assets->group("Files");
  add_folder_options(*assets, *arguments);
  assets->callback([arguments, &exit_code] { exit_code = run_assets(*arguments); });
  CLI::App* showcase =
      verb->add_subcommand("showcase", "The meshes and textures of the scenes to show, as fine as asked for");
  showcase->group("Files");
  begin_option_group(*showcase, input_group);
  showcase->add_option("--detail", arguments->detail, "factor of the number of triangles of curved bodies")
      ->check(CLI::Range(kLeastDetail, kMostDetail))
      ->capture_default_str();
  add_folder_options(*showcase, *arguments);
  showcase->callback([arguments, &exit_code] { exit_code = run_showcase(*arguments); });
}

}  // namespace photonproof::inline harness_verbs
