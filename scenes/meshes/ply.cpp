#include "scenes/meshes/ply.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scenes/files/atomic_file.h"
#include "scenes/meshes/ply_layout.h"
#include "scenes/meshes/ply_values.h"

namespace photonproof::inline scenes_meshes {
namespace {

using namespace ply;

class MeshReader {
 public:
  MeshReader(std::string_view bytes, const std::string& file)
      : bytes_(bytes),
        file_(file),
        header_(read_header(bytes, file)),
        layout_(plan_layout(header_, bytes.substr(0, header_.size), file)),
        vertex_count_(header_.elements[layout_.vertices].count) {}

  TriangleMesh run() {
    switch (header_.format) {
      case Format::ascii:
        read_all(TextValues(file_, bytes_, header_.size));
        break;
      case Format::little_endian:
        read_all(BinaryValues<false>(file_, bytes_, header_.size));
        break;
      case Format::big_endian:
        read_all(BinaryValues<true>(file_, bytes_, header_.size));
    }
    return std::move(mesh_);
  }

 private:
  template <class Values>
  void read_all(Values in) {
    for (std::size_t e = 0; e < header_.elements.size(); ++e) {
      const Element& element = header_.elements[e];
      const std::vector<Step>& steps = layout_.elements[e];
      const std::size_t least = least_bytes<Values>(element);
      if (least == 0) continue;  // rows without values take no room, however many there are
      if (element.count > in.remaining() / least) fail_on_size(element, least);
      in.row.element = &element.name;
      if (e == layout_.vertices) {
        read_vertices(in, steps);
      } else if (e == layout_.faces) {
        read_faces(in, steps, element.count);
      } else {
        for (in.row.number = 0; in.row.number < element.count; ++in.row.number)
          for (const Step& step : steps) skip(in, step);
      }
    }
    in.finish();
  }

  /// Bytes of a row in the file when all its lists are empty.
  template <class Values>
  static std::size_t least_bytes(const Element& element) {
    std::size_t sum = 0;
    for (const Property& property : element.properties)
      sum += Values::least_bytes(property.count_type.value_or(property.type));
    return sum;
  }

  [[noreturn]] void fail_on_size(const Element& element, std::size_t least) const {
    fail_at_offset(file_, bytes_.substr(0, header_.size), element.offset,
                   "element " + in_quotes(element.name) + " has " + std::to_string(element.count) +
                       " rows of at least " + std::to_string(least) +
                       " bytes each, more than the rest of the file: it is truncated or its header is wrong");
  }

  template <class Values>
  static std::uint64_t list_size(Values& in, Type type) {
    const std::int64_t size = in.integer(type);
    if (size < 0) in.fail("has a list of " + std::to_string(size) + " values, expected at least 0");
    return static_cast<std::uint64_t>(size);
  }

  template <class Values>
  static void skip(Values& in, const Step& step) {
    in.skip(step.type, step.count_type ? list_size(in, *step.count_type) : 1);
  }

  template <class Values>
  void read_vertices(Values& in, const std::vector<Step>& steps) {
    mesh_.resize_positions(vertex_count_);
    if (layout_.has_normals) mesh_.normals.resize(vertex_count_);
    if (layout_.has_uvs) mesh_.uvs.resize(vertex_count_);
    std::array<float, kVertexSlots> values{};
    const std::size_t first = begin_attributes(layout_.of_vertices);
    for (in.row.number = 0; in.row.number < vertex_count_; ++in.row.number) {
      for (const Step& step : steps) {
        if (step.slot == kNowhere)
          skip(in, step);
        else if (step.slot >= kAttributes)
          attribute_value(step) = attribute_number(in, step.type);
        else
          values[static_cast<std::size_t>(step.slot)] = coordinate(in, step.type);
      }
      add_attributes(layout_.of_vertices, first);
      const std::uint64_t i = in.row.number;
      mesh_.positions[i] = {values[kX], values[kY], values[kZ]};
      if (layout_.has_normals) mesh_.normals[i] = {values[kNx], values[kNy], values[kNz]};
      if (layout_.has_uvs) mesh_.uvs[i] = {values[kU], values[kV]};
    }
  }

  template <class Values>
  static float coordinate(Values& in, Type type) {
    const double value = in.number(type);
    if (!(std::abs(value) <= double{std::numeric_limits<float>::max()}))
      in.fail("has the value " + format_number(value) + ", expected finite numbers that fit single precision");
    return static_cast<float>(value);
  }

  /// Adds empty attributes to the mesh; returns the index of the first.
  std::size_t begin_attributes(const std::vector<Attribute>& attributes) {
    const std::size_t first = mesh_.attributes.size();
    for (const Attribute& attribute : attributes) mesh_.attributes.push_back({attribute.name, {}});
    row_.assign(3 * attributes.size(), 0.0f);
    return first;
  }

  float& attribute_value(const Step& step) { return row_[static_cast<std::size_t>(step.slot - kAttributes)]; }

  /// Adds the row's values to the attributes.
  void add_attributes(const std::vector<Attribute>& attributes, std::size_t first) {
    for (std::size_t i = 0; i < attributes.size(); ++i) {
      const float* v = &row_[3 * i];
      mesh_.attributes[first + i].values.push_back(attributes[i].grey ? Rgb(v[0]) : Rgb(v[0], v[1], v[2]));
    }
  }

  /// A value of an attribute. As in Mitsuba, bytes are numbers up to 255.
  template <class Values>
  static float attribute_number(Values& in, Type type) {
    if (is_floating(type)) return coordinate(in, type);
    const std::int64_t byte = in.integer(type);
    if (byte < 0 || byte > 255) in.fail("has the value " + std::to_string(byte) + ", expected from 0 to 255");
    return static_cast<float>(byte);
  }

  template <class Values>
  void read_faces(Values& in, const std::vector<Step>& steps, std::uint64_t count) {
    std::size_t triangle_bytes = 0;
    for (const Step& step : steps)
      triangle_bytes += Values::least_bytes(step.count_type.value_or(step.type)) +
                        (step.slot == kCorners ? 3 * Values::least_bytes(step.type) : 0);
    // Room for triangles, limited by the bytes that remain; polygons make it grow.
    mesh_.triangles.reserve(std::min<std::uint64_t>(count, in.remaining() / triangle_bytes));
    const std::size_t first = begin_attributes(layout_.of_faces);
    for (in.row.number = 0; in.row.number < count; ++in.row.number) {
      const std::size_t before = mesh_.triangles.size();
      for (const Step& step : steps) {
        if (step.slot == kCorners)
          read_polygon(in, step);
        else if (step.slot >= kAttributes)
          attribute_value(step) = attribute_number(in, step.type);
        else
          skip(in, step);
      }
      for (std::size_t i = before; i < mesh_.triangles.size(); ++i) add_attributes(layout_.of_faces, first);
    }
  }

  template <class Values>
  void read_polygon(Values& in, const Step& step) {
    const std::uint64_t corners = list_size(in, *step.count_type);
    if (corners < 3) in.fail("has " + std::to_string(corners) + " corners, expected at least 3");
    const std::uint32_t first = vertex(in, step.type);
    std::uint32_t previous = vertex(in, step.type);
    for (std::uint64_t i = 2; i < corners; ++i) {
      const std::uint32_t next = vertex(in, step.type);
      if (mesh_.triangles.size() == kMaxElements)
        in.fail("passes the limit of " + std::to_string(kMaxElements) + " triangles");
      mesh_.triangles.push_back({first, previous, next});
      previous = next;
    }
  }

  template <class Values>
  std::uint32_t vertex(Values& in, Type type) const {
    const std::int64_t index = in.integer(type);
    if (index < 0 || static_cast<std::uint64_t>(index) >= vertex_count_)
      in.fail("names vertex " + std::to_string(index) + ", expected 0 to " + std::to_string(vertex_count_ - 1));
    return static_cast<std::uint32_t>(index);
  }

  std::string_view bytes_;
  const std::string& file_;
  Header header_;
  Layout layout_;
  std::uint64_t vertex_count_;
  TriangleMesh mesh_;
  std::vector<float> row_;  ///< the attributes' values of the vertex or face that is read
};

}  // namespace

TriangleMesh parse_ply(std::string_view bytes, const std::string& file) { return MeshReader(bytes, file).run(); }

TriangleMesh read_ply(const std::string& path) { return parse_ply(read_file(path, kMaxPlyBytes), path); }

}  // namespace photonproof::inline scenes_meshes
