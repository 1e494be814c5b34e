// The writing half of ply.h.
#include <bit>
#include <cstring>
#include <fstream>

#include "scenes/base/input_error.h"
#include "scenes/files/atomic_file.h"
#include "scenes/meshes/ply.h"

namespace photonproof::inline scenes_meshes {
namespace {

static_assert(std::endian::native == std::endian::little, "values are written as they are in memory");

/// Gathers small writes into large ones.
class ByteStream {
 public:
  explicit ByteStream(const std::filesystem::path& path) : out_(path, std::ios::binary) {
    buffer_.reserve(kFull + kRow);
  }

  template <class T>
  void put(const T& value) {
    const std::size_t at = buffer_.size();
    buffer_.resize(at + sizeof(T));
    std::memcpy(buffer_.data() + at, &value, sizeof(T));
    if (buffer_.size() >= kFull) flush();
  }
  void put_text(const std::string& text) { buffer_ += text; }
  /// False when anything could not be written.
  bool close() {
    flush();
    out_.close();
    return static_cast<bool>(out_);
  }

 private:
  static constexpr std::size_t kFull = std::size_t{1} << 20, kRow = 64;
  void flush() {
    out_.write(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
    buffer_.clear();
  }
  std::ofstream out_;
  std::string buffer_;
};

std::string header_of(const TriangleMesh& mesh) {
  std::string header = "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(mesh.positions.size()) +
                       "\nproperty float x\nproperty float y\nproperty float z\n";
  if (!mesh.normals.empty()) header += "property float nx\nproperty float ny\nproperty float nz\n";
  if (!mesh.uvs.empty()) header += "property float u\nproperty float v\n";
  const auto add_attributes = [&](bool per_vertex) {
    for (const MeshAttribute& attribute : mesh.attributes)
      if (attribute.per_vertex() == per_vertex)
        for (const char* end : {"_x", "_y", "_z"})
          header += "property float " + attribute.name.substr(attribute.name.find('_') + 1) + end + "\n";
  };
  add_attributes(true);
  header += "element face " + std::to_string(mesh.triangles.size()) + "\nproperty list uchar uint vertex_indices\n";
  add_attributes(false);
  return header + "end_header\n";
}

void put_attributes(ByteStream& out, const TriangleMesh& mesh, bool per_vertex, std::size_t i) {
  for (const MeshAttribute& attribute : mesh.attributes)
    if (attribute.per_vertex() == per_vertex) out.put(attribute.values[i]);
}

}  // namespace

void write_ply(const std::filesystem::path& target, const TriangleMesh& mesh) {
  replace_atomically(target, [&](const std::filesystem::path& temporary) {
    ByteStream out(temporary);
    out.put_text(header_of(mesh));
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
      out.put(mesh.positions[i]);
      if (!mesh.normals.empty()) out.put(mesh.normals[i]);
      if (!mesh.uvs.empty()) out.put(mesh.uvs[i]);
      put_attributes(out, mesh, true, i);
    }
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      out.put(std::uint8_t{3});
      out.put(mesh.triangles[i]);
      put_attributes(out, mesh, false, i);
    }
    if (!out.close()) throw InputError(target.string(), "cannot be written (permission or disk full)");
  });
}

}  // namespace photonproof::inline scenes_meshes
