#include "scenes/meshes/serialized.h"

#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <new>
#include <type_traits>

#include "scenes/base/input_error.h"

namespace photonproof::inline scenes_meshes {
namespace {

static_assert(std::endian::native == std::endian::little, "the files are little-endian");

constexpr std::uint16_t kMagic = 0x041C;
constexpr std::size_t kHeaderBytes = 4;
constexpr std::uint64_t kMostExpansion = 1032;  ///< of a byte, by deflate

enum Flags : std::uint32_t { has_normals = 1, has_uvs = 2, has_colours = 8, double_precision = 0x2000 };

template <class T>
T load(std::string_view bytes, std::size_t at) {
  T value;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

/// The values of one compressed mesh, in sequence.
class Inflated {
 public:
  Inflated(std::string_view compressed, const std::string& file) : file_(file), left_(compressed) {
    if (inflateInit(&stream_) != Z_OK) throw std::bad_alloc();
  }
  ~Inflated() { inflateEnd(&stream_); }
  Inflated(const Inflated&) = delete;
  Inflated& operator=(const Inflated&) = delete;

  void read(void* target, std::size_t bytes) {
    auto* out = static_cast<unsigned char*>(target);
    while (bytes > 0) {
      const auto step = static_cast<uInt>(std::min<std::size_t>(bytes, std::size_t{1} << 30));
      stream_.next_out = out;
      stream_.avail_out = step;
      while (stream_.avail_out > 0) inflate_some();
      out += step;
      bytes -= step;
    }
  }
  template <class T>
  T value() {
    T result;
    read(&result, sizeof result);
    return result;
  }

 private:
  void inflate_some() {
    if (stream_.avail_in == 0 && !left_.empty()) {
      const std::size_t step = std::min<std::size_t>(left_.size(), std::size_t{1} << 30);
      stream_.next_in = reinterpret_cast<unsigned char*>(const_cast<char*>(left_.data()));
      stream_.avail_in = static_cast<uInt>(step);
      left_.remove_prefix(step);
    }
    const uInt before = stream_.avail_out;
    const int result = inflate(&stream_, Z_NO_FLUSH);
    if (result == Z_MEM_ERROR) throw std::bad_alloc();
    if (result != Z_OK && result != Z_STREAM_END && result != Z_BUF_ERROR)
      throw InputError(file_, "the compressed mesh is damaged");
    if (result == Z_STREAM_END && stream_.avail_out > 0) throw InputError(file_, "the mesh ends too early");
    if (stream_.avail_out == before && stream_.avail_in == 0 && left_.empty())
      throw InputError(file_, "the mesh ends too early");
  }

  const std::string& file_;
  std::string_view left_;
  z_stream stream_{};
};

/// The part of the file from mesh `index` on, its header cut off. The offsets stand at the end, their number last.
std::string_view stream_of(std::string_view bytes, std::uint16_t version, int index, const std::string& file) {
  if (index == 0) return bytes.substr(kHeaderBytes);
  const std::size_t word = version >= 4 ? 8 : 4;
  if (bytes.size() < kHeaderBytes + 4) throw InputError(file, "has no list of its meshes");
  const auto count = load<std::uint32_t>(bytes, bytes.size() - 4);
  if (static_cast<std::uint32_t>(index) >= count)
    throw InputError(
        file, "has no mesh " + std::to_string(index) + ", expected 0 to " + std::to_string(std::int64_t{count} - 1));
  if (count > (bytes.size() - 4) / word) throw InputError(file, "has no list of its meshes");
  const std::size_t at = bytes.size() - 4 - word * (count - static_cast<std::uint32_t>(index));
  const std::uint64_t offset = word == 8 ? load<std::uint64_t>(bytes, at) : load<std::uint32_t>(bytes, at);
  if (offset > bytes.size() - kHeaderBytes || load<std::uint16_t>(bytes, offset) != kMagic)
    throw InputError(file, "mesh " + std::to_string(index) + " is not where the list of meshes has it");
  return bytes.substr(offset + kHeaderBytes);
}

template <class Real>
void read_floats(Inflated& from, float* target, std::size_t count) {
  if constexpr (std::is_same_v<Real, float>) {
    from.read(target, count * sizeof(float));
  } else {
    constexpr std::size_t kBlock = 4096;
    double block[kBlock];
    for (std::size_t i = 0; i < count; i += kBlock) {
      const std::size_t step = std::min(kBlock, count - i);
      from.read(block, step * sizeof(double));
      std::transform(block, block + step, target + i, [](double v) { return static_cast<float>(v); });
    }
  }
}

struct Counts {
  std::size_t vertices, triangles;
};

Counts counts_of(Inflated& from, std::size_t compressed_bytes, const std::string& file) {
  const auto vertices = from.value<std::uint64_t>(), triangles = from.value<std::uint64_t>();
  if (vertices == 0 || triangles == 0) throw InputError(file, "the mesh has no triangles");
  const std::uint64_t most = compressed_bytes * kMostExpansion / 12;
  if (vertices > most || triangles > most || vertices > UINT32_MAX)
    throw InputError(file, "the mesh has " + std::to_string(vertices) + " vertices and " + std::to_string(triangles) +
                               " triangles, more than its bytes can hold");
  return {vertices, triangles};
}

template <class Real>
void read_vertices(Inflated& from, std::uint32_t flags, Counts counts, TriangleMesh& mesh) {
  mesh.resize_positions(counts.vertices);
  read_floats<Real>(from, &mesh.positions[0].x, 3 * counts.vertices);
  if (flags & has_normals) {
    mesh.normals.resize(counts.vertices);
    read_floats<Real>(from, &mesh.normals[0].x, 3 * counts.vertices);
  }
  if (flags & has_uvs) {
    mesh.uvs.resize(counts.vertices);
    read_floats<Real>(from, &mesh.uvs[0].x, 2 * counts.vertices);
  }
  if (flags & has_colours) {
    std::vector<float> skipped(3 * counts.vertices);
    read_floats<Real>(from, skipped.data(), skipped.size());
  }
}

void check(const TriangleMesh& mesh, const std::string& file) {
  const auto finite = [](const Vec3f& v) { return is_finite(v); };
  const auto finite_uv = [](const Vec2<float>& v) { return std::isfinite(v.x) && std::isfinite(v.y); };
  if (!std::ranges::all_of(mesh.positions, finite) || !std::ranges::all_of(mesh.normals, finite) ||
      !std::ranges::all_of(mesh.uvs, finite_uv))
    throw InputError(file, "the mesh has a number that is not finite");
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    for (const std::uint32_t corner : mesh.triangles[i])
      if (corner >= mesh.positions.size())
        throw InputError(file, "triangle " + std::to_string(i) + " has the vertex " + std::to_string(corner) +
                                   ", expected less than " + std::to_string(mesh.positions.size()));
}

}  // namespace

TriangleMesh parse_serialized(std::string_view bytes, const std::string& file, int index) {
  if (bytes.size() < kHeaderBytes || load<std::uint16_t>(bytes, 0) != kMagic)
    throw InputError(file, "is not a serialized mesh of Mitsuba");
  const auto version = load<std::uint16_t>(bytes, 2);
  if (version != 3 && version != 4)
    throw InputError(file, "has version " + std::to_string(version) + " of serialized meshes, expected 3 or 4");
  const std::string_view compressed = stream_of(bytes, version, index, file);
  Inflated from(compressed, file);
  const auto flags = from.value<std::uint32_t>();
  if (version >= 4)
    while (from.value<char>() != 0) {  // the name
    }
  const Counts counts = counts_of(from, compressed.size(), file);
  TriangleMesh mesh;
  if (flags & double_precision)
    read_vertices<double>(from, flags, counts, mesh);
  else
    read_vertices<float>(from, flags, counts, mesh);
  mesh.triangles.resize(counts.triangles);
  from.read(mesh.triangles.data(), counts.triangles * sizeof(TriangleMesh::Triangle));
  check(mesh, file);
  return mesh;
}

}  // namespace photonproof::inline scenes_meshes
