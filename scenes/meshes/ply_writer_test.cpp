#include <gtest/gtest.h>

#include <filesystem>

#include "scenes/base/input_error.h"
#include "scenes/files/atomic_file.h"
#include "scenes/files/test_folder.h"
#include "scenes/meshes/ply.h"

namespace photonproof::inline scenes_meshes {
namespace {

class PlyWriter : public FolderTest {
 protected:
  std::filesystem::path file() const { return folder_ / "mesh.ply"; }
  TriangleMesh written_and_read(const TriangleMesh& mesh) const {
    write_ply(file(), mesh);
    return read_ply(file().string());
  }
};

/// A strip of `count` triangles with numbers that need every bit.
TriangleMesh strip(std::uint32_t count) {
  TriangleMesh mesh;
  mesh.resize_positions(count + 2);
  for (std::uint32_t i = 0; i < count + 2; ++i)
    mesh.positions[i] = {static_cast<float>(i) / 3, i % 2 == 0 ? 1e-38f : -0.0f, static_cast<float>(i)};
  for (std::uint32_t i = 0; i < count; ++i) mesh.triangles.push_back({i, i + 1, i + 2});
  return mesh;
}

TEST_F(PlyWriter, writes_what_the_reader_gives_back) {
  TriangleMesh mesh = strip(100'000);  // more than one buffer of a megabyte
  EXPECT_EQ(written_and_read(mesh), mesh);
  mesh.normals.assign(mesh.positions.size(), Vec3f(0, 0, 1));
  EXPECT_EQ(written_and_read(mesh), mesh);
  mesh.uvs.assign(mesh.positions.size(), Vec2<float>{0.25f, 0.75f});
  EXPECT_EQ(written_and_read(mesh), mesh);
  mesh.attributes = {{"vertex_color", {}}, {"vertex_a_b_color", {}}, {"face_heat", {}}};
  mesh.attributes[0].values.assign(mesh.positions.size(), Rgb(1, 2, 3));
  mesh.attributes[1].values.assign(mesh.positions.size(), Rgb(4, 5, 6));
  mesh.attributes[2].values.assign(mesh.triangles.size(), Rgb(7));
  EXPECT_EQ(written_and_read(mesh), mesh);
}

TEST_F(PlyWriter, takes_12_bytes_a_vertex_and_13_a_triangle) {
  write_ply(file(), strip(1));
  EXPECT_EQ(read_file(file()),
            "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
            "property float z\nelement face 1\nproperty list uchar uint vertex_indices\nend_header\n" +
                read_file(file()).substr(std::filesystem::file_size(file()) - 3 * 12 - 13));
}

TEST_F(PlyWriter, says_when_it_cannot_write) {
  try {
    write_ply("/nonexistent/mesh.ply", strip(1));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "/nonexistent/mesh.ply: error: folder '/nonexistent' does not exist");
  }
}

}  // namespace
}  // namespace photonproof::inline scenes_meshes
