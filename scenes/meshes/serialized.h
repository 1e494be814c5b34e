// Triangle meshes from Mitsuba 0.6's compressed files (.serialized, versions 3 and 4), which may hold several. Files
// are untrusted: allocations are bounded by what the file's bytes can expand to.
#pragma once

#include <string>
#include <string_view>

#include "scenes/meshes/mesh.h"

namespace photonproof::inline scenes_meshes {

constexpr std::size_t kMaxSerializedBytes = std::size_t{4} << 30;

/// Reads mesh number `index`, counted from 0: its positions, and normals and texture coordinates where it has them, in
/// single or double precision. Colours and the name are skipped. The mesh is padded. Throws InputError, with the byte
/// where that is known; `file` stands for the file in messages.
TriangleMesh parse_serialized(std::string_view bytes, const std::string& file, int index);

}  // namespace photonproof::inline scenes_meshes
