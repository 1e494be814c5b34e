#include "scenes/pbrt/pbrt_scene.h"

#include <algorithm>

#include "scenes/files/atomic_file.h"
#include "scenes/xml/writer.h"

namespace photonproof::inline scenes_pbrt {

PbrtReport write_pbrt_scene(const std::filesystem::path& file, const std::filesystem::path& folder,
                            const PbrtOptions& options, bool lenient) {
  constexpr std::size_t most_bytes = std::size_t{1} << 30;
  PbrtSources sources;
  PbrtLog log(sources);
  PbrtReport report;
  std::vector<InputError> errors;
  SceneDescription scene;
  try {
    scene = read_pbrt(sources, log, read_file(file, most_bytes), file.string(), folder, options);
    errors = log.obstacles().errors();
  } catch (const InputError& error) {
    errors = log.obstacles().errors();
    errors.push_back(error);
    lenient = false;  // there is no scene
  }
  for (const InputError& error : errors)
    if (lenient)
      report.notes.push_back({error.place(), "left out: " + error.message()});
    else
      report.problems.push_back({error, sources.line(error.place().substr(0, error.place().find(':')), error.line())});
  for (std::size_t i = 1; i < sources.count(); ++i) report.included.push_back(sources.name(i));
  report.notes.insert(report.notes.end(), log.notes().begin(), log.notes().end());
  if (report.problems.empty()) write_file_atomically(folder / "scene.xml", write_scene(scene));
  return report;
}

}  // namespace photonproof::inline scenes_pbrt
