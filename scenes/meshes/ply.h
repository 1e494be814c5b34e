// Triangle meshes from and to PLY files (Turk, "The PLY polygon file format", 1994): text, and binary of either byte
// order. Files are untrusted: nothing is allocated that the file's own size does not back.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "scenes/meshes/mesh.h"

namespace photonproof::inline scenes_meshes {

constexpr std::size_t kMaxPlyBytes = std::size_t{8} << 30;

/// The elements `vertex` and `face` of a file: x y z, nx ny nz, and u v (also texture_u texture_v, or s t) of type
/// float or double; vertex_index or vertex_indices, polygons cut into fans around their first corner. Normals and
/// texture coordinates that are not complete, other properties and other elements are skipped. The mesh is padded.
/// Throws InputError: with file:line:col for the header and for text, with the byte and the row for binary values.
TriangleMesh read_ply(const std::string& path);

/// The same for bytes already in memory; `file` stands for the file in messages.
TriangleMesh parse_ply(std::string_view bytes, const std::string& file);

/// Binary little-endian, in a whole file or none; read_ply gives back an equal mesh. Precondition: normals and uvs are
/// empty or one a vertex. Throws InputError when it cannot be written.
void write_ply(const std::filesystem::path& target, const TriangleMesh& mesh);

}  // namespace photonproof::inline scenes_meshes
