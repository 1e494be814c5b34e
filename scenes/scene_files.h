// The files a scene names beside itself. A scene is untrusted: without leave its files lie in its own folder or below.
#pragma once

#include <filesystem>
#include <map>
#include <memory>

#include "scenes/mesh.h"
#include "scenes/parser.h"
#include "scenes/xml_source.h"

namespace photonproof::scene_xml {

/// The real path of `shown`, which the attribute `filename` names, with symbolic links followed. Throws InputError
/// there when it leaves the folder of the first of `sources` without options.allow_outside, or does not exist.
std::filesystem::path resolve_file(const Sources& sources, const ParseOptions& options, const Attribute& filename,
                                   const std::filesystem::path& shown);

/// Loads the meshes that shapes name, each file once however many shapes share it.
class MeshFiles {
 public:
  MeshFiles(const Sources& sources, const ParseOptions& options) : sources_(sources), options_(options) {}

  /// `filename` is relative to the folder of the scene itself, also in an included file: that is Mitsuba's rule, and
  /// lets the writer put a scene of many files into one. Throws InputError there, or in the mesh file.
  std::shared_ptr<const TriangleMesh> load(const Attribute& filename);

 private:
  std::string read(const std::filesystem::path& path, const Attribute& filename) const;

  const Sources& sources_;
  const ParseOptions& options_;
  std::map<std::filesystem::path, std::shared_ptr<const TriangleMesh>> loaded_;
};

}  // namespace photonproof::scene_xml
