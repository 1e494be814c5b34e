// Expands files into one tree: includes are inlined, <default> and -D values replace `$name`, <path> adds a folder.
#pragma once

#include "scenes/parser/parser.h"
#include "scenes/parser/scene_files.h"
#include "scenes/xml/xml_source.h"

namespace photonproof::scene_xml {

constexpr std::size_t kMaxIncludes = 256;                            ///< over a whole scene
constexpr std::size_t kMaxFolders = 64;                              ///< of <path>
constexpr std::size_t kMaxSubstitutedBytes = std::size_t{16} << 20;  ///< of all values in which `$name` was replaced

/// Expands `file` of `sources` completely; its root is <scene>. Included files are added to `sources`, the folders of
/// <path> to `folders`, which are also searched for later includes. Throws InputError on a missing, cyclic or outside
/// include, an undefined `$name`, an unused -D, or an exceeded limit.
Element expand_scene(Sources& sources, int file, SceneFolders& folders, const ParseOptions& options);

}  // namespace photonproof::scene_xml
