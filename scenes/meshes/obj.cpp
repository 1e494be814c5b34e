#include "scenes/meshes/obj.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numeric>
#include <optional>

#include "scenes/base/input_error.h"
#include "scenes/base/line_words.h"
#include "scenes/base/text_numbers.h"
#include "scenes/files/atomic_file.h"

namespace photonproof::inline scenes_meshes {
namespace {

constexpr std::uint32_t kNone = 0xFFFFFFFF;

/// Indices of a position, a texture coordinate and a normal; the last two may be kNone.
using Corner = std::array<std::uint32_t, 3>;

class ObjReader : LineWords {
 public:
  ObjReader(std::string_view text, const std::string& file) : LineWords(text, file) {
    constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
    if (text.starts_with(byte_order_mark)) next_ = byte_order_mark.size();
  }

  TriangleMesh run() {
    for (; begin_line(); skip_line()) read_line();
    if (triangles_.empty()) throw InputError(file_, "has no faces, expected at least one");
    return build();
  }

 private:
  void read_line() {
    const std::string_view statement = word();
    if (statement == "v") {
      positions_.push_back(vector("a vertex"));
    } else if (statement == "vn") {
      normals_.push_back(vector("a normal"));
    } else if (statement == "vt") {
      const float u = number("a texture coordinate");
      const std::string_view v = word();
      uvs_.push_back({u, v.empty() ? 0.0f : to_float(v, "a texture coordinate")});
    } else if (statement == "f") {
      read_face();
    }
  }

  Vec3f vector(const char* what) {
    const float x = number(what), y = number(what), z = number(what);
    return {x, y, z};
  }

  float number(const char* what) {
    const std::string_view text = word();
    if (text.empty()) fail(end_, std::string(what) + " has too few numbers");
    return to_float(text, what);
  }

  float to_float(std::string_view text, const char* what) const {
    double value = 0;
    const std::string_view digits = text[0] == '+' ? text.substr(1) : text;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error == std::errc::result_out_of_range && end == digits.data() + digits.size())
      value = std::strtod(std::string(digits).c_str(), nullptr);  // 0 or infinity, which from_chars does not tell
    else if (error != std::errc{} || end != digits.data() + digits.size())
      fail(word_, std::string(what) + " has " + in_quotes(text) + ", expected a number");
    if (!(std::abs(value) <= double{std::numeric_limits<float>::max()}))
      fail(word_, std::string(what) + " has " + in_quotes(text) + ", expected a finite number of single precision");
    return static_cast<float>(value);
  }

  void read_face() {
    const std::size_t start = word_;
    std::array<std::uint32_t, 2> ends{};  // the fan's first corner and the one before
    std::size_t count = 0;
    for (std::string_view text = word(); !text.empty() && text[0] != '#'; text = word()) {
      if (corners_.size() >= kNone) fail(word_, "the file has too many faces");
      const auto corner = static_cast<std::uint32_t>(corners_.size());
      corners_.push_back(corner_of(text));
      if (count == 0) ends[0] = corner;
      if (count >= 2) triangles_.push_back({ends[0], ends[1], corner});
      ends[1] = corner;
      ++count;
    }
    if (count < 3) fail(start, "a face has " + std::to_string(count) + " corners, expected at least 3");
  }

  /// "v", "v/vt", "v//vn" or "v/vt/vn".
  Corner corner_of(std::string_view text) const {
    const std::size_t first = text.find('/'), second = first == text.npos ? text.npos : text.find('/', first + 1);
    const auto part = [&](std::size_t begin, std::size_t end) { return text.substr(begin, end - begin); };
    Corner corner = {index_of(part(0, std::min(first, text.size())), positions_.size(), "vertex"), kNone, kNone};
    if (first == text.npos) return corner;
    const std::string_view uv = part(first + 1, std::min(second, text.size()));
    if (!uv.empty()) corner[1] = index_of(uv, uvs_.size(), "texture coordinate");
    if (second != text.npos) corner[2] = index_of(text.substr(second + 1), normals_.size(), "normal");
    return corner;
  }

  std::uint32_t index_of(std::string_view text, std::size_t count, const char* what) const {
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size())
      fail(word_, "a face has " + in_quotes(text) + ", expected the number of a " + what);
    const auto known = static_cast<std::int64_t>(count);
    const std::int64_t index = value < 0 ? known + value : value - 1;
    if (value == 0 || index < 0 || index >= known || index >= kNone)
      fail(word_, std::string("a face names ") + what + " " + std::to_string(value) + " of " + std::to_string(count));
    return static_cast<std::uint32_t>(index);
  }

  /// For every corner the vertex it becomes, numbered in the order of first use, and the corner each vertex was first.
  /// By sorting, so that no choice of indices makes it slow.
  std::pair<std::vector<std::uint32_t>, std::vector<std::uint32_t>> unite() const {
    std::vector<std::uint32_t> order(corners_.size()), first(corners_.size());
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
      return corners_[a] != corners_[b] ? corners_[a] < corners_[b] : a < b;
    });
    for (std::size_t i = 0; i < order.size(); ++i) {
      const bool same = i > 0 && corners_[order[i]] == corners_[order[i - 1]];
      first[order[i]] = same ? first[order[i - 1]] : order[i];
    }
    std::vector<std::uint32_t> vertex(corners_.size()), corner;
    for (std::uint32_t c = 0; c < corners_.size(); ++c) {
      if (first[c] == c) {
        vertex[c] = static_cast<std::uint32_t>(corner.size());
        corner.push_back(c);
      } else {
        vertex[c] = vertex[first[c]];
      }
    }
    return {std::move(vertex), std::move(corner)};
  }

  TriangleMesh build() const {
    const auto [vertex, corner] = unite();
    TriangleMesh mesh;
    mesh.resize_positions(corner.size());
    const auto lacks = [](std::size_t i) { return [i](const Corner& c) { return c[i] == kNone; }; };
    const bool with_uvs = !std::all_of(corners_.begin(), corners_.end(), lacks(1));
    const bool with_normals = std::none_of(corners_.begin(), corners_.end(), lacks(2));
    if (with_uvs) mesh.uvs.resize(corner.size());
    if (with_normals) mesh.normals.resize(corner.size());
    for (std::size_t v = 0; v < corner.size(); ++v) {
      const Corner& from = corners_[corner[v]];
      mesh.positions[v] = positions_[from[0]];
      if (with_uvs && from[1] != kNone) mesh.uvs[v] = uvs_[from[1]];
      if (with_normals) mesh.normals[v] = normals_[from[2]];
    }
    mesh.triangles.reserve(triangles_.size());
    for (const auto& t : triangles_) mesh.triangles.push_back({vertex[t[0]], vertex[t[1]], vertex[t[2]]});
    return mesh;
  }

  std::vector<Vec3f> positions_, normals_;
  std::vector<Vec2<float>> uvs_;
  std::vector<Corner> corners_;
  std::vector<TriangleMesh::Triangle> triangles_;  // of corners
};

}  // namespace

TriangleMesh read_obj(const std::string& path) { return parse_obj(read_file(path, kMaxObjBytes), path); }

TriangleMesh parse_obj(std::string_view text, const std::string& file) { return ObjReader(text, file).run(); }

}  // namespace photonproof::inline scenes_meshes
