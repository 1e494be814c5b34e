// photonproof export: a scene file to POV-Ray's scene description language, Blender's Python or Mitsuba's XML, or a
// refusal.

#include <CLI/CLI.hpp>
#include <cctype>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "harness/verbs/engine_output.h"
#include "harness/verbs/povray_arguments.h"
#include "harness/verbs/usage/verb_usage.h"
#include "harness/verbs/verbs.h"
#include "reference/cycles/cycles_export.h"
#include "reference/mitsuba/mitsuba_export.h"
#include "reference/povray/povray_export.h"
#include "scenes/description/output_files.h"
#include "scenes/files/atomic_file.h"

namespace photonproof::inline harness_verbs {
namespace {

void print_crop(const FilmDescription& film) {
  if (const auto& crop = film.crop)
    std::printf("then keep %d x %d pixels from %d, %d\n", crop->width, crop->height, crop->x, crop->y);
}

struct ExportArguments : PovrayArguments {
  std::string program = "auto";  ///< "povray", "cycles", "mitsuba", or "auto": the file's ending chooses
};

std::string program_of(const ExportArguments& arguments) {
  if (arguments.program != "auto") return arguments.program;
  const std::string ending = std::filesystem::path(arguments.output).extension().string();
  return ending == ".py" ? "cycles" : ending == ".xml" ? "mitsuba" : "povray";
}

int export_python(const SceneDescription& description, const ExportArguments& arguments, const std::string& stem) {
  CyclesOptions options;
  options.seed = arguments.options.seed;
  options.stem = stem;
  const CyclesExport scene = export_cycles(description, options);
  write_script(scene, arguments.output);
  std::printf(
      "%s: render with: blender -b --factory-startup --python-exit-code 1 --python %s\n"
      "then average batch_*.exr, weighed by their samples\n",
      arguments.output.c_str(), std::filesystem::absolute(arguments.output).c_str());
  print_crop(scene.film);
  return 0;
}

int export_xml(const SceneDescription& description, const ExportArguments& arguments, const std::string& stem) {
  namespace fs = std::filesystem;
  MitsubaOptions options;
  options.seed = arguments.options.seed;
  options.stem = stem;
  const MitsubaExport scene = export_mitsuba(description, options);
  write_mitsuba(scene, arguments.output);
  if (scene.plugins.empty()) {
    std::printf("%s: render with: mitsuba %s\n", arguments.output.c_str(), arguments.output.c_str());
  } else {
    const fs::path script = fs::path(arguments.output).parent_path() / (stem + "_render.py"),
                   job = fs::path(arguments.output).parent_path() / (stem + "_render.json");
    write_file_atomically(script, mitsuba_script());
    write_file_atomically(job, mitsuba_job(scene));
    std::printf(
        "%s: render with: python3 %s %s %s .\n"
        "then average batch_*.exr, weighed by their samples\n",
        arguments.output.c_str(), script.c_str(), arguments.output.c_str(), job.c_str());
  }
  print_crop(scene.picture.film);
  return 0;
}

int run_export(const ExportArguments& arguments) {
  const SceneDescription description = load_scene(arguments.scene);
  prepare_outputs({arguments.output}, scene_inputs(description));
  PovrayOptions options = arguments.options;
  options.stem = std::filesystem::path(arguments.output).stem().string();
  for (char& c : options.stem)  // it stands between quotes in the text
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  const std::string program = program_of(arguments);
  if (program == "cycles") return export_python(description, arguments, options.stem);
  if (program == "mitsuba") return export_xml(description, arguments, options.stem);
  const PovrayExport scene = export_povray(description, options);
  write_sdl(scene, arguments.output);
  std::string antialias;
  for (const std::string& word : scene.antialias) antialias += " " + word;
  std::printf("%s: render with: povray +I%s +Oscene.exr +FE +W%d +H%d -D -P +WT1%s\n", arguments.output.c_str(),
              arguments.output.c_str(), (scene.width + 2 * scene.margin) * scene.grid,
              (scene.height + 2 * scene.margin) * scene.grid, antialias.c_str());
  if (scene.margin > 0)
    std::printf("then filter %dx%d sub-pixels a pixel, with %d pixels around the picture\n", scene.grid, scene.grid,
                scene.margin);
  else if (scene.grid > 1)
    std::printf("then average %dx%d pixels\n", scene.grid, scene.grid);
  if (scene.exposure != 1) std::printf("then divide by %g\n", scene.exposure);
  print_crop(scene.film);
  for (const std::string& skip : scene.skipped) std::printf("skipped %s\n", skip.c_str());
  for (const std::string& loss : scene.losses) std::printf("loss: %s\n", loss.c_str());
  return 0;
}

}  // namespace

void add_export_verb(CLI::App& program, int& exit_code) {
  auto arguments = std::make_shared<ExportArguments>();
  CLI::App* verb = add_verb(
      program, {.name = "export",
                .group = render_group,
                .purpose = "Write a scene for POV-Ray (SDL), Blender's Cycles (.py) or Mitsuba 3 (.xml)",
                .examples = {"photonproof export scenes/library/cornell/scene.xml -o cornell.pov",
                             "photonproof export scenes/library/cornell/scene.xml -o cornell.py",
                             "photonproof export scenes/library/cornell/scene.xml --for mitsuba -o cornell-3.xml"},
                .exit_codes = {done, bad_input, not_representable, internal_error}});
  add_povray_arguments(*verb, *arguments, "SDL, .py or .xml to write");
  verb->add_option("--for", arguments->program, "program to write for (default: the file's ending chooses)")
      ->check(CLI::IsMember({"povray", "cycles", "mitsuba"}))
      ->type_name("NAME");
  verb->callback([arguments, &exit_code] { exit_code = refusing_with_3([&] { return run_export(*arguments); }); });
}

}  // namespace photonproof::inline harness_verbs
