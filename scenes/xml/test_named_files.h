// Files of every kind that scenes name, for tests.
#pragma once

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>

#include "scenes/curves/curve_set.h"
#include "scenes/description/description.h"
#include "scenes/files/atomic_file.h"
#include "scenes/files/scratch_folder.h"
#include "scenes/images/image.h"
#include "scenes/meshes/ies.h"
#include "scenes/meshes/obj.h"
#include "scenes/meshes/ply.h"
#include "scenes/meshes/vol.h"

namespace photonproof::inline scenes_xml {

/// A folder with a file of every kind.
class NamedFiles {
 public:
  NamedFiles() {
    const std::filesystem::path corpora = PHOTONPROOF_CORPORA;
    std::filesystem::copy(corpora / "ply_corpus/ascii_quad.ply", folder_ / "a.ply");
    std::filesystem::copy(corpora / "obj_corpus/quad.obj", folder_ / "a.obj");
    std::filesystem::copy(corpora / "ies_corpus/rotational.ies", folder_ / "a.ies");
    Image grey(2, 2);
    std::fill(grey.rgb.begin(), grey.rgb.end(), 0.5f);
    write_exr((folder_ / "a.exr").string(), {grey, {}, {}});
    std::filesystem::copy(corpora / "vol_corpus/00", folder_ / "a.vol");
    grid = std::make_shared<const VolumeGrid>(parse_vol(read_file(folder_ / "a.vol"), "a.vol"));
    std::filesystem::copy(corpora / "curve_set_corpus/bspline", folder_ / "a.txt");
    curves = std::make_shared<const CurveSet>(parse_curves(read_file(folder_ / "a.txt"), "a.txt", 4));
    std::string slope("VOL\x03\x01\0\0\0\x02\0\0\0\x02\0\0\0\x02\0\0\0\x01\0\0\0", 24);
    for (const float word : {0.f, 0.f, 0.f, 1.f, 1.f, 1.f, -1.f, -1.f, -1.f, -1.f, 1.f, 1.f, 1.f, 1.f})
      slope.append(reinterpret_cast<const char*>(&word), sizeof word);
    write_file_atomically(folder_ / "b.vol", slope);
    distances = std::make_shared<const VolumeGrid>(parse_vol(slope, "b.vol", VolValues::any));
    mesh_of_ply = std::make_shared<const TriangleMesh>(read_ply((folder_ / "a.ply").string()));
    mesh_of_obj = std::make_shared<const TriangleMesh>(read_obj((folder_ / "a.obj").string()));
    profile = std::make_shared<const IesProfile>(read_ies((folder_ / "a.ies").string()));
    image = std::make_shared<const Image>(grey);
    const std::string one =
        "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n"
        "property float nx\nproperty float ny\nproperty float nz\nproperty float opacities\n"
        "property float scale_0\nproperty float scale_1\nproperty float scale_2\nproperty float rot_0\n"
        "property float rot_1\nproperty float rot_2\nproperty float rot_3\nend_header\n"
        "1 2 3 0 0 0 .5 -1 0 -2 1 0 0 .5\n";
    write_file_atomically(folder_ / "e.ply", one);
    cloud = std::make_shared<const EllipsoidCloud>(parse_ellipsoids(one, "e.ply"));
  }

  std::string scene() const { return (folder_ / "scene.xml").string(); }

  std::shared_ptr<const TriangleMesh> mesh_of_ply, mesh_of_obj;
  std::shared_ptr<const IesProfile> profile;
  std::shared_ptr<const Image> image;
  std::shared_ptr<const VolumeGrid> grid, distances;
  std::shared_ptr<const CurveSet> curves;
  std::shared_ptr<const EllipsoidCloud> cloud;

 private:
  const ScratchFolder scratch_{"writer-test"};
  const std::filesystem::path& folder_ = scratch_.path();
};

}  // namespace photonproof::inline scenes_xml
