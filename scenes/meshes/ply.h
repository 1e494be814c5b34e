// Triangle meshes from and to PLY files (Turk, "The PLY polygon file format", 1994): text, and binary of either byte
// order. Files are untrusted: allocations are bounded by the file's own size.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "scenes/meshes/mesh.h"

namespace photonproof::inline scenes_meshes {

constexpr std::size_t kMaxPlyBytes = std::size_t{8} << 30;

/// Reads the elements `vertex` and `face` of a file. Vertices have x y z, nx ny nz, and u v (or texture_u texture_v, or
/// s t) of type float or double. Faces have vertex_index or vertex_indices; polygons are cut into fans around their
/// first corner. Further values of type float, double or uchar are attributes by Mitsuba's names (ply_layout.cpp).
/// Incomplete normals and texture coordinates, other properties and other elements are skipped. The mesh is padded.
/// Throws InputError: with file:line:col for the header and for text, with byte and row for binary values.
TriangleMesh read_ply(const std::string& path);

/// The same for bytes already in memory; `file` stands for the file in messages.
TriangleMesh parse_ply(std::string_view bytes, const std::string& file);

/// Writes binary little-endian, a whole file or none; read_ply reads back an equal mesh. Precondition: normals and uvs
/// are empty or one per vertex, attributes of vertices precede those of triangles. Throws InputError when it cannot be
/// written.
void write_ply(const std::filesystem::path& target, const TriangleMesh& mesh);

}  // namespace photonproof::inline scenes_meshes
