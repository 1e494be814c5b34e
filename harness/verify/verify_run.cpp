#include "harness/verify/verify_run.h"

#include <algorithm>
#include <cctype>
#include <utility>

#include "harness/cells/folder_lock.h"
#include "harness/cells/host.h"
#include "harness/verify/probes.h"
#include "harness/verify/scene_verdict.h"
#include "reference/store/reference_store.h"
#include "scenes/base/input_error.h"
#include "scenes/base/timer.h"
#include "scenes/description/scene_hash.h"
#include "scenes/parser/parser.h"

namespace photonproof::inline harness_verify {
namespace {

namespace fs = std::filesystem;

/// A scene as it was read, before anything is rendered.
struct ReadScene {
  RenderedScene scene;
  SceneDescription description;
  std::string purpose, title;
};

fs::path file_of(const fs::path& given) { return fs::is_directory(given) ? given / "scene.xml" : given; }

std::string name_of(const fs::path& file) {
  const fs::path absolute = fs::absolute(file).lexically_normal();
  std::string name =
      absolute.filename() == "scene.xml" ? absolute.parent_path().filename().string() : absolute.stem().string();
  for (char& c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '-' && c != '_' && c != '.') c = '_';
  return name;
}

/// Size of the largest reference beside the scene; else the film's, reduced to 64 pixels on its longer side.
std::pair<int, int> usual_size(const fs::path& file, const FilmDescription& film) {
  for (const int side : {128, 96, 64, 48, 32})
    if (fs::exists(committed_reference_path(file, side, side))) return {side, side};
  const double part = std::min(1.0, 64.0 / std::max(film.width, film.height));
  const auto scaled = [&](int pixels) { return std::max(8, static_cast<int>(pixels * part + 0.5)); };
  return {scaled(film.width), scaled(film.height)};
}

ReadScene read_scene(const fs::path& given, const VerifyOptions& options) {
  ReadScene read;
  read.scene.file = file_of(given);
  read.scene.name = name_of(read.scene.file);
  read.description = parse_scene_file(read.scene.file.string());
  read.scene.content = scene_hash(read.description);
  FilmDescription& film = read.description.sensor.film;
  const std::string expect = expect_path_of(read.scene.file.string());
  if (fs::exists(expect)) read.scene.expect = read_expect(expect);
  if (read.scene.expect) {
    read.purpose = read.scene.expect->purpose;
    read.title = read.scene.expect->title;
  }
  const auto [width, height] =
      options.width > 0 ? std::pair(options.width, options.height) : usual_size(read.scene.file, film);
  // A closed form describes the scene's whole own view.
  const bool other_shape = film.crop || std::int64_t{width} * film.height != std::int64_t{height} * film.width;
  if (read.scene.expect && other_shape) read.scene.expect->analytic.reset();
  read.scene.crop = crop_of(film, width, height);
  read.scene.has_answers = true;
  film.crop.reset();
  film.width = read.scene.width = width;
  film.height = read.scene.height = height;
  return read;
}

std::vector<ReadScene> read_scenes(const VerifyOptions& options) {
  std::vector<ReadScene> scenes;
  for (const fs::path& given : options.scenes) {
    ReadScene read = read_scene(given, options);
    const auto same = [&](const ReadScene& other) { return other.scene.name == read.scene.name; };
    for (int n = 2; std::ranges::any_of(scenes, same); ++n)
      read.scene.name = name_of(read.scene.file) + "-" + std::to_string(n);
    scenes.push_back(std::move(read));
  }
  return scenes;
}

/// An engine requested by name must be installed.
void check_engines(const std::vector<VerifyEngine>& engines, const EngineChoice& choice) {
  for (const VerifyEngine& engine : engines)
    if (engine.version.problem && !choice.names.empty())
      throw InputError("--engine", "'" + engine.row.name + "' cannot be used: " + *engine.version.problem);
}

VerifyRecord new_record(const VerifyOptions& options, const std::vector<VerifyEngine>& engines) {
  VerifyRecord record;
  record.created = utc_now();
  record.program = options.version;
  record.command = options.command;
  record.power = options.renderer.power;
  const Host host = describe_host();
  record.host = host.cpu + ", " + std::to_string(host.cores) + " cores, " + host.os;
  for (const VerifyEngine& engine : engines)
    record.engines.push_back(
        {engine.row.name, engine.row.title, engine.version.line, engine.version.problem.value_or("")});
  return record;
}

}  // namespace

VerifyRecord run_verify(VerifyOptions options) {
  const std::vector<ReadScene> scenes = read_scenes(options);
  const std::vector<VerifyEngine> engines = verify_engines(options.engines);
  check_engines(engines, options.engines);
  const FolderLock lock(options.renderer.folder);
  fs::create_directories(options.renderer.folder / "pictures");
  const EngineRenderer renderer(options.renderer);
  const Timer timer;
  VerifyRecord record = new_record(options, engines);
  const fs::path file = options.renderer.folder / "verify.json";
  try {
    for (const ReadScene& read : scenes) {
      if (options.probes)
        for (VerifyProbe& probe : probe_engines(renderer, engines, kinds_in(read.description), record.probes))
          record.probes.push_back(std::move(probe));
      RenderedScene scene = read.scene;
      scene.description = &read.description;
      record.scenes.push_back(verify_scene(renderer, scene, read.description, engines, record.probes));
      record.scenes.back().purpose = read.purpose;
      record.scenes.back().title = read.title;
      record.seconds = timer.seconds();
      write_verify_record(record, file);
      if (options.ended) options.ended(record.scenes.back());
    }
  } catch (const VerifyInterrupted&) {
    record.interrupted = true;
  }
  record.seconds = timer.seconds();
  write_verify_record(record, file);
  return record;
}

}  // namespace photonproof::inline harness_verify
