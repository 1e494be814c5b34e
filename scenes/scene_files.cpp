#include "scenes/scene_files.h"

#include "scenes/atomic_file.h"
#include "scenes/ply.h"
#include "scenes/text_numbers.h"

namespace photonproof::scene_xml {
namespace fs = std::filesystem;

fs::path resolve_file(const Sources& sources, const ParseOptions& options, const Attribute& filename,
                      const fs::path& shown) {
  std::error_code error;
  if (filename.value.empty() || filename.value.find('\0') != std::string::npos)
    fail_at(sources, filename, "expected a file name");
  fs::path path = fs::weakly_canonical(shown, error);
  if (error) fail_at(sources, filename, "cannot read " + in_quotes(filename.value) + ": " + error.message());
  const fs::path folder = fs::path(sources.name(0)).parent_path();
  const fs::path relative =
      path.lexically_relative(fs::weakly_canonical(folder.empty() ? fs::path(".") : folder, error));
  if (!options.allow_outside && (relative.empty() || *relative.begin() == ".."))
    fail_at(sources, filename,
            in_quotes(filename.value) + " lies outside the scene's folder (--allow-outside permits it)");
  if (!fs::exists(path, error)) fail_at(sources, filename, "no such file: " + in_quotes(filename.value));
  return path;
}

std::string MeshFiles::read(const fs::path& path, const Attribute& filename) const {
  try {
    return read_file(path, kMaxPlyBytes);
  } catch (const InputError& error) {
    fail_at(sources_, filename, "cannot read " + error.summary());
  }
}

std::shared_ptr<const TriangleMesh> MeshFiles::load(const Attribute& filename) {
  const fs::path shown = fs::path(sources_.name(0)).parent_path() / filename.value;
  const fs::path path = resolve_file(sources_, options_, filename, shown);
  std::shared_ptr<const TriangleMesh>& mesh = loaded_[path];
  if (!mesh) mesh = std::make_shared<const TriangleMesh>(parse_ply(read(path, filename), shown.string()));
  return mesh;
}

}  // namespace photonproof::scene_xml
