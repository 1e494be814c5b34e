#include "harness/variants/own_engine.h"

#include <string>

#include "harness/cells/cells.h"
#include "harness/images/image_source.h"
#include "scenes/description/file_names.h"
#include "scenes/description/film_part.h"
#include "scenes/files/atomic_file.h"
#include "scenes/files/file_checksum.h"
#include "scenes/files/scratch_folder.h"
#include "scenes/xml/writer.h"

namespace photonproof::inline harness_variants {

Rendering render_with(const OwnEngine& engine, const SceneDescription& scene, const OwnRender& render) {
  const ScratchFolder scratch("grade");
  const std::string text = write_scene(with_absolute_files(scene));
  SuiteScene file;
  file.name = "scene";
  file.path = scratch.path() / "scene.xml";
  file.width = render.width;
  file.height = render.height;
  write_file_atomically(file.path, text);
  const ImageSourceOptions options{.use = ImageUse::verdict,
                                   .folder = engine.kept ? engine.kept->folder() : scratch.path(),
                                   .store = engine.kept,
                                   .program = engine.program,
                                   .limits = {.seconds = engine.seconds, .memory_mb = 0},
                                   .reused = {Status::ok},
                                   .interrupt = engine.interrupt};
  const Engine row = own_row(render.integrator);
  const ImageEngine drawn_by{&row, engine.kept ? file_checksum(engine.program) : "", render.more};
  const ImageScene drawn{&file, content_key({{"text", text}}), crop_of(scene.sensor.film, render.width, render.height)};
  const Budget budget{"spp", static_cast<double>(render.spp)};
  const std::optional<KeptImage> image = ImageSource(options).draw(drawn_by, drawn, budget, render.seed);
  if (!image || image->kept.result.status != Status::ok)
    throw InputError(engine.program.string(),
                     "rendering what is compared with, it " + (image ? image->kept.result.detail : "interrupted"));
  return read_rendering((options.folder / image->kept.result.image).string());
}

}  // namespace photonproof::inline harness_variants
