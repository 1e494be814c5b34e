#include "harness/variants/own_engine.h"

#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

#include "scenes/base/process.h"
#include "scenes/description/file_names.h"
#include "scenes/files/atomic_file.h"
#include "scenes/files/checksum.h"
#include "scenes/files/file_checksum.h"
#include "scenes/files/scratch_folder.h"
#include "scenes/xml/writer.h"

namespace photonproof::inline harness_variants {
namespace {

namespace fs = std::filesystem;

std::string cache_name(const OwnEngine& engine, const std::string& text, const OwnRender& render) {
  Checksum sum;
  for (const std::string& part : render_command(engine.program, render, text, ""))
    sum.add(part.c_str(), part.size() + 1);
  const std::string program = file_checksum(engine.program);
  sum.add(program.data(), program.size());
  return sum.hex() + ".exr";
}

}  // namespace

std::vector<std::string> render_command(const fs::path& program, const OwnRender& render, const std::string& scene,
                                        const std::string& out) {
  std::vector<std::string> command{program.string(),
                                   "render",
                                   scene,
                                   "-o",
                                   out,
                                   "--size",
                                   std::to_string(render.width) + "x" + std::to_string(render.height),
                                   "--spp",
                                   std::to_string(render.spp),
                                   "--seed",
                                   std::to_string(render.seed),
                                   "--allow-outside",
                                   "--quiet"};
  if (!render.integrator.empty()) command.insert(command.end(), {"--integrator", render.integrator});
  command.insert(command.end(), render.more.begin(), render.more.end());
  return command;
}

Rendering render_with(const OwnEngine& engine, const SceneDescription& scene, const OwnRender& render) {
  const std::string text = write_scene(with_absolute_files(scene));
  const fs::path kept = engine.cache.empty() ? fs::path() : engine.cache / cache_name(engine, text, render);
  if (!kept.empty() && fs::exists(kept)) return read_rendering(kept.string());
  const ScratchFolder scratch("grade");
  const fs::path file = scratch.path() / "scene.xml", out = scratch.path() / "image.exr";
  write_file_atomically(file, text);
  ProcessOptions options;
  options.wall_limit_seconds = engine.seconds;
  options.interrupt = engine.interrupt;
  const ProcessOutcome outcome =
      run_process(render_command(engine.program, render, file.string(), out.string()), options);
  if (!outcome.ok())
    throw InputError(engine.program.string(), "rendering what is compared with, it " + outcome.sentence() + ": " +
                                                  last_line(outcome.standard_error));
  Rendering rendering = read_rendering(out.string());
  if (!kept.empty()) {
    fs::create_directories(engine.cache);
    write_exr(kept.string(), rendering);
  }
  return rendering;
}

}  // namespace photonproof::inline harness_variants
