// The files that a scene names. A scene is untrusted: without permission its files lie in its own folder or below.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <tuple>

#include "scenes/description/description.h"
#include "scenes/parser/parser.h"
#include "scenes/xml/xml_source.h"

namespace photonproof::scene_xml {

/// The search path for files that a scene names, in Mitsuba's order. The folders given by <path> come first, the last
/// given before the others. The folder of the scene itself follows, also for names in an included file.
class SceneFolders {
 public:
  SceneFolders(const Sources& sources, const ParseOptions& options) : sources_(sources), options_(options) {}

  struct File {
    std::string name;             ///< relative to the folder of the scene, or absolute
    std::filesystem::path shown;  ///< for messages
    std::filesystem::path real;   ///< symbolic links followed
  };
  /// The first file of that name. Throws InputError at `filename` when there is none, or only one that leaves the
  /// folder of the scene without options.allow_outside.
  File find(const Attribute& filename) const;
  /// The same for <include>, which may also stand beside the file that contains it: an extension.
  File find_included(const Attribute& filename) const;
  /// Adds a folder, relative to the file that names it; failing that, found as files are.
  void add(const Attribute& path);

 private:
  std::filesystem::path scene_folder() const;
  /// The folder of the file in which `attribute` stands, relative to the scene's.
  std::filesystem::path folder_of(const Attribute& attribute) const;
  File find_in(const std::vector<std::filesystem::path>& folders, const Attribute& name, const char* what) const;

  const Sources& sources_;
  const ParseOptions& options_;
  std::vector<std::filesystem::path> folders_;  // of <path>, the last one first
};

/// Loads the files that shapes, textures, lights and volumes name, each once however many share it. All functions throw
/// InputError at `filename`, with the place in the file where that is to blame.
class SceneFiles {
 public:
  SceneFiles(const Sources& sources, const SceneFolders& folders) : sources_(sources), folders_(folders) {}

  template <class Content>
  struct Loaded {
    std::string name;  ///< relative to the folder of the scene
    std::shared_ptr<const Content> content;
  };
  /// `index`: of a serialized file.
  Loaded<TriangleMesh> mesh(const Attribute& filename, MeshDescription::Format format, int index);
  /// `raw`: 8- and 16-bit samples are numbers, not sRGB.
  Loaded<Image> image(const Attribute& filename, bool raw);
  Loaded<IesProfile> ies(const Attribute& filename);
  Loaded<VolumeGrid> volume(const Attribute& filename, VolValues allowed);
  /// `least`: control points of a curve.
  Loaded<CurveSet> curves(const Attribute& filename, std::size_t least);
  Loaded<EllipsoidCloud> ellipsoids(const Attribute& filename);
  /// The text of a small file.
  std::string text(const Attribute& filename);

 private:
  std::string read(const SceneFolders::File& file, const Attribute& filename, std::size_t most) const;
  /// The result of parse(bytes, name of the file).
  template <class Parse>
  auto parsed(const SceneFolders::File& file, const Attribute& filename, std::size_t most, const Parse& parse) const;

  const Sources& sources_;
  const SceneFolders& folders_;
  std::map<std::tuple<std::filesystem::path, MeshDescription::Format, int>, std::shared_ptr<const TriangleMesh>>
      meshes_;
  std::map<std::pair<std::filesystem::path, bool>, std::shared_ptr<const Image>> images_;
  std::map<std::filesystem::path, std::shared_ptr<const IesProfile>> profiles_;
  std::map<std::pair<std::filesystem::path, VolValues>, std::shared_ptr<const VolumeGrid>> volumes_;
  std::map<std::pair<std::filesystem::path, std::size_t>, std::shared_ptr<const CurveSet>> curves_;
  std::map<std::filesystem::path, std::shared_ptr<const EllipsoidCloud>> clouds_;
};

}  // namespace photonproof::scene_xml
