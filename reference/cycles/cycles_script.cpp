#include "reference/cycles/cycles_script.h"

#include <fstream>
#include <ios>
#include <utility>

#include "scenes/base/input_error.h"
#include "scenes/files/atomic_file.h"

namespace photonproof::inline reference_cycles {
namespace {

template <class T>
void put(std::ofstream& out, const T& value) {
  out.write(reinterpret_cast<const char*>(&value), sizeof value);
}

void write_mesh(const CyclesFile& file, const std::filesystem::path& target) {
  const TriangleMesh& mesh = *file.mesh;
  std::ofstream out(target, std::ios::binary);
  for (const Vec3f& p : mesh.positions)
    for (const float x : {p.x, p.y, p.z}) put(out, x);
  for (const auto& [a, b, c] : mesh.triangles) {
    put(out, a);
    put(out, file.turned ? c : b);
    put(out, file.turned ? b : c);
  }
  for (const Vec2<float>& uv : mesh.uvs) {
    put(out, uv.x);
    put(out, file.flip_v ? 1 - uv.y : uv.y);
  }
  const float sign = file.turned ? -1.0f : 1.0f;
  for (const Vec3f& n : mesh.normals)
    for (const float x : {n.x, n.y, n.z}) put(out, sign * x);
  out.close();
  if (!out) throw InputError(target.string(), "cannot be written (permission or disk full)");
}

}  // namespace

void write_cycles_file(const CyclesFile& file, const std::filesystem::path& folder) {
  const std::filesystem::path target = folder / file.name;
  if (file.image) return write_exr(target.string(), Rendering{*file.image, {}, {}});
  replace_atomically(target, [&](const std::filesystem::path& temporary) { write_mesh(file, temporary); });
}

void CyclesScript::explain(std::string_view text) {
  std::string comment(text);
  for (char& c : comment)
    if (c < ' ' || c > '~') c = '?';
  explanations_.push_back(comment);
  line("# " + comment);
}

void CyclesScript::line(std::string_view python) {
  text_ += python;
  text_ += '\n';
}

std::string CyclesScript::file_of(const std::shared_ptr<const Image>& image) {
  for (const CyclesFile& file : files_)
    if (file.image == image) return file.name;
  CyclesFile file;
  file.name = stem_ + "_image_" + std::to_string(files_.size()) + ".exr";
  file.image = image;
  files_.push_back(file);
  return file.name;
}

std::string CyclesScript::file_of(const CyclesFile& mesh) {
  for (const CyclesFile& file : files_)
    if (file.mesh == mesh.mesh && file.turned == mesh.turned && file.flip_v == mesh.flip_v) return file.name;
  files_.push_back(mesh);
  files_.back().name = stem_ + "_mesh_" + std::to_string(files_.size() - 1) + ".bin";
  return files_.back().name;
}

}  // namespace photonproof::inline reference_cycles
