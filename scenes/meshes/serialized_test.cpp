// The reader of Mitsuba 0.6's serialized meshes. Files are made here by the format's public description.
#include "scenes/meshes/serialized.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <cstring>

#include "scenes/base/input_error.h"
#include "scenes/meshes/serialized_fuzz.h"

namespace photonproof::inline scenes_meshes {
namespace {

template <class T>
void put(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// Two triangles of a square of this size, with normals and texture coordinates.
template <class Real>
std::string square(std::uint16_t version, float size) {
  std::string raw;
  put(raw, std::uint32_t{sizeof(Real) == 8 ? 0x2003u : 0x1003u});
  if (version == 4) raw += std::string("square\0", 7);
  put(raw, std::uint64_t{4});
  put(raw, std::uint64_t{2});
  for (const int corner : {0, 1, 2, 3})
    for (const float v : {corner & 1 ? size : 0.f, corner & 2 ? size : 0.f, 5.f}) put(raw, static_cast<Real>(v));
  for (int corner = 0; corner < 4; ++corner)
    for (const float v : {0.f, 0.f, 1.f}) put(raw, static_cast<Real>(v));
  for (const int corner : {0, 1, 2, 3})
    for (const float v : {corner & 1 ? 1.f : 0.f, corner & 2 ? 1.f : 0.f}) put(raw, static_cast<Real>(v));
  for (const std::uint32_t i : {0, 1, 3, 0, 3, 2}) put(raw, i);
  std::string file;
  put(file, std::uint16_t{0x041C});
  put(file, version);
  uLongf packed = compressBound(raw.size());
  std::string compressed(packed, 0);
  compress(reinterpret_cast<Bytef*>(compressed.data()), &packed, reinterpret_cast<const Bytef*>(raw.data()),
           raw.size());
  return file + compressed.substr(0, packed);
}

/// Several meshes with the list of their offsets.
std::string file_of(const std::vector<std::string>& meshes, std::uint16_t version) {
  std::string file;
  std::vector<std::uint64_t> offsets;
  for (const std::string& mesh : meshes) {
    offsets.push_back(file.size());
    file += mesh;
  }
  for (const std::uint64_t offset : offsets)
    if (version == 4)
      put(file, offset);
    else
      put(file, static_cast<std::uint32_t>(offset));
  put(file, static_cast<std::uint32_t>(meshes.size()));
  return file;
}

std::string message_of(const std::string& bytes, int index = 0) {
  try {
    parse_serialized(bytes, "a.serialized", index);
    return "";
  } catch (const InputError& error) {
    return error.summary();
  }
}

TEST(serialized, gives_positions_normals_and_texture_coordinates_of_both_precisions) {
  for (const std::string& bytes : {file_of({square<float>(4, 2)}, 4), file_of({square<double>(4, 2)}, 4)}) {
    const TriangleMesh mesh = parse_serialized(bytes, "a.serialized", 0);
    ASSERT_EQ(mesh.positions.size(), 4u);
    EXPECT_EQ(mesh.positions[3], Vec3f(2, 2, 5));
    EXPECT_EQ(mesh.normals[2], Vec3f(0, 0, 1));
    EXPECT_EQ(mesh.uvs[1].x, 1);
    ASSERT_EQ(mesh.triangles.size(), 2u);
    EXPECT_EQ(mesh.triangles[1], (TriangleMesh::Triangle{0, 3, 2}));
    EXPECT_TRUE(mesh.is_padded());
  }
}

TEST(serialized, has_several_meshes_in_files_of_versions_3_and_4) {
  for (const std::uint16_t version : {std::uint16_t{3}, std::uint16_t{4}}) {
    const std::string bytes =
        file_of({square<float>(version, 2), square<float>(version, 3), square<float>(version, 4)}, version);
    for (const int i : {0, 1, 2})
      EXPECT_EQ(parse_serialized(bytes, "a.serialized", i).positions[3].x, static_cast<float>(2 + i)) << version;
    EXPECT_EQ(message_of(bytes, 3), "a.serialized: error: has no mesh 3, expected 0 to 2");
  }
}

TEST(serialized, that_is_damaged_is_refused) {
  const std::string good = file_of({square<float>(4, 2)}, 4);
  EXPECT_EQ(message_of("ply\n"), "a.serialized: error: is not a serialized mesh of Mitsuba");
  EXPECT_EQ(message_of(std::string("\x1c\x04\x05\x00", 4)),
            "a.serialized: error: has version 5 of serialized meshes, expected 3 or 4");
  EXPECT_EQ(message_of(good.substr(0, 30)), "a.serialized: error: the mesh ends too early");
  std::string damaged = good;
  damaged[8] = static_cast<char>(damaged[8] ^ 0x7f);
  EXPECT_NE(message_of(damaged), "");
  for (std::size_t size = 0; size < good.size(); ++size) {
    EXPECT_EQ(check_serialized(std::string_view(good).substr(0, size)), "") << size;
    std::string changed = good;
    changed[size] = static_cast<char>(changed[size] ^ (1 << (size % 8)));
    EXPECT_EQ(check_serialized(changed), "") << size;
  }
}

}  // namespace
}  // namespace photonproof::inline scenes_meshes
