// From files to one tree: includes are inlined, <default> and -D values replace `$name`.
#pragma once

#include "scenes/parser.h"
#include "scenes/xml_source.h"

namespace photonproof::scene_xml {

constexpr std::size_t kMaxIncludes = 256;                            ///< over a whole scene
constexpr std::size_t kMaxSubstitutedBytes = std::size_t{16} << 20;  ///< of all values in which `$name` was replaced

/// `file` of `sources` with everything expanded; its root is <scene>. Included files are added to `sources`. Throws
/// InputError on a missing, cyclic or outside include, an undefined `$name`, an unused -D, or an exceeded limit.
Element expand_scene(Sources& sources, int file, const ParseOptions& options);

}  // namespace photonproof::scene_xml
