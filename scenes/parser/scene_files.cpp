#include "scenes/parser/scene_files.h"

#include "scenes/base/text_numbers.h"
#include "scenes/curves/curve_set.h"
#include "scenes/files/atomic_file.h"
#include "scenes/files/inside_folder.h"
#include "scenes/meshes/ies.h"
#include "scenes/meshes/obj.h"
#include "scenes/meshes/ply.h"
#include "scenes/meshes/serialized.h"

namespace photonproof::scene_xml {
namespace fs = std::filesystem;

fs::path SceneFolders::scene_folder() const { return fs::path(sources_.name(0)).parent_path(); }

fs::path SceneFolders::folder_of(const Attribute& attribute) const {
  const fs::path folder = fs::path(sources_.name(attribute.at.file)).parent_path();
  const fs::path relative = folder.lexically_relative(scene_folder());
  if (relative == ".") return {};
  return relative.empty() ? folder : relative;
}

SceneFolders::File SceneFolders::find_in(const std::vector<fs::path>& folders, const Attribute& name,
                                         const char* what) const {
  if (name.value.empty() || name.value.find('\0') != std::string::npos)
    fail_at(sources_, name, std::string("expected a ") + what + " name");
  bool left = false;
  for (const fs::path& folder : folders) {
    const fs::path spelled = folder / name.value;
    const fs::path shown = scene_folder() / spelled;
    std::error_code error;
    const fs::path real = real_path(shown, error);
    if (error) fail_at(sources_, name, "cannot read " + in_quotes(name.value) + ": " + error.message());
    if (!options_.allow_outside && !is_inside(real, scene_folder()))
      left = true;
    else if (fs::exists(real, error))
      return {spelled.string(), shown, real};
  }
  if (left)
    fail_at(sources_, name, in_quotes(name.value) + " lies outside the scene's folder (--allow-outside permits it)");
  fail_at(sources_, name, std::string("no such ") + what + ": " + in_quotes(name.value));
}

SceneFolders::File SceneFolders::find(const Attribute& filename) const {
  std::vector<fs::path> folders = folders_;
  folders.emplace_back();
  return find_in(folders, filename, "file");
}

SceneFolders::File SceneFolders::find_included(const Attribute& filename) const {
  std::vector<fs::path> folders = folders_;
  folders.emplace_back();
  folders.push_back(folder_of(filename));
  return find_in(folders, filename, "file");
}

void SceneFolders::add(const Attribute& path) {
  std::vector<fs::path> folders = folders_;
  folders.insert(folders.begin(), folder_of(path));
  folders.emplace_back();
  const File found = find_in(folders, path, "folder");
  std::error_code error;
  if (!fs::is_directory(found.real, error)) fail_at(sources_, path, in_quotes(path.value) + " is not a folder");
  folders_.insert(folders_.begin(), found.name);
}

std::string SceneFiles::read(const SceneFolders::File& file, const Attribute& filename, std::size_t most) const {
  try {
    return read_file(file.shown, most);
  } catch (const InputError& error) {
    fail_at(sources_, filename, "cannot read " + error.summary());
  }
}

template <class Parse>
auto SceneFiles::parsed(const SceneFolders::File& file, const Attribute& filename, std::size_t most,
                        const Parse& parse) const {
  const std::string bytes = read(file, filename, most);
  try {
    return parse(bytes, file.shown.string());
  } catch (const InputError& error) {
    fail_at(sources_, filename, "cannot use " + error.summary());
  }
}

SceneFiles::Loaded<TriangleMesh> SceneFiles::mesh(const Attribute& filename, MeshDescription::Format format,
                                                  int index) {
  const SceneFolders::File file = folders_.find(filename);
  std::shared_ptr<const TriangleMesh>& mesh = meshes_[{file.real, format, index}];
  if (!mesh) {
    const auto load = [&] {
      switch (format) {
        case MeshDescription::Format::ply:
          return parsed(file, filename, kMaxPlyBytes, parse_ply);
        case MeshDescription::Format::obj:
          return parsed(file, filename, kMaxObjBytes, parse_obj);
        default:
          return parsed(file, filename, kMaxSerializedBytes, [&](const std::string& bytes, const std::string& name) {
            return parse_serialized(bytes, name, index);
          });
      }
    };
    mesh = std::make_shared<const TriangleMesh>(load());
  }
  return {file.name, mesh};
}

SceneFiles::Loaded<Image> SceneFiles::image(const Attribute& filename, bool raw) {
  const SceneFolders::File file = folders_.find(filename);
  std::shared_ptr<const Image>& image = images_[{file.real, raw}];
  if (!image) try {
      image = std::make_shared<const Image>(read_texture_image(file.shown.string(), raw));
    } catch (const InputError& error) {
      fail_at(sources_, filename, "cannot use " + error.summary());
    }
  return {file.name, image};
}

SceneFiles::Loaded<IesProfile> SceneFiles::ies(const Attribute& filename) {
  const SceneFolders::File file = folders_.find(filename);
  std::shared_ptr<const IesProfile>& profile = profiles_[file.real];
  if (!profile) profile = std::make_shared<const IesProfile>(parsed(file, filename, kMaxIesBytes, parse_ies));
  return {file.name, profile};
}

SceneFiles::Loaded<VolumeGrid> SceneFiles::volume(const Attribute& filename, VolValues allowed) {
  const SceneFolders::File file = folders_.find(filename);
  std::shared_ptr<const VolumeGrid>& volume = volumes_[{file.real, allowed}];
  const auto parse = [&](const std::string& bytes, const std::string& name) { return parse_vol(bytes, name, allowed); };
  if (!volume) volume = std::make_shared<const VolumeGrid>(parsed(file, filename, kMaxVolBytes, parse));
  return {file.name, volume};
}

SceneFiles::Loaded<CurveSet> SceneFiles::curves(const Attribute& filename, std::size_t least) {
  const SceneFolders::File file = folders_.find(filename);
  std::shared_ptr<const CurveSet>& curves = curves_[{file.real, least}];
  const auto parse = [&](const std::string& text, const std::string& name) { return parse_curves(text, name, least); };
  if (!curves) curves = std::make_shared<const CurveSet>(parsed(file, filename, kMaxCurveBytes, parse));
  return {file.name, curves};
}

SceneFiles::Loaded<EllipsoidCloud> SceneFiles::ellipsoids(const Attribute& filename) {
  const SceneFolders::File file = folders_.find(filename);
  std::shared_ptr<const EllipsoidCloud>& cloud = clouds_[file.real];
  if (!cloud) cloud = std::make_shared<const EllipsoidCloud>(parsed(file, filename, kMaxCloudBytes, parse_ellipsoids));
  return {file.name, cloud};
}

std::string SceneFiles::text(const Attribute& filename) {
  return read(folders_.find(filename), filename, std::size_t{1} << 20);
}

}  // namespace photonproof::scene_xml
