#include "scenes/pbrt/files.h"

#include <zlib.h>

#include <array>
#include <cctype>
#include <charconv>
#include <cstdint>
#include <memory>

#include "scenes/base/text_numbers.h"
#include "scenes/files/atomic_file.h"
#include "scenes/files/inside_folder.h"
#include "scenes/meshes/ply.h"

namespace photonproof::inline scenes_pbrt {
namespace {

namespace fs = std::filesystem;

/// Letters, digits, '-' and '_' of a name; the rest becomes '-'.
std::string plain(std::string name) {
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-' && c != '_') c = '-';
  return name.empty() ? "file" : name.substr(0, 60);
}

/// The fewest digits from which the number is read back.
std::string shortest(float value) {
  std::array<char, 32> text;
  const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), value);
  return {text.data(), end};
}

/// A volume of Mitsuba, of which parse_vol makes an equal grid.
std::string bytes_of(const VolumeGrid& grid) {
  std::string bytes = "VOL\x03";
  const auto add = [&](const auto& value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof value); };
  for (const std::int32_t v : {1, grid.width, grid.height, grid.depth, grid.channels}) add(v);
  for (const Vec3f& corner : {grid.low, grid.high}) {
    add(corner.x);
    add(corner.y);
    add(corner.z);
  }
  bytes.append(reinterpret_cast<const char*>(grid.values.data()), grid.values.size() * sizeof(float));
  return bytes;
}

/// A file of curves, of which parse_curves makes an equal set.
std::string text_of(const CurveSet& curves) {
  std::string text;
  std::size_t next = 0;
  for (std::size_t i = 0; i < curves.points.size(); ++i) {
    if (next < curves.first.size() && curves.first[next] == i) {
      if (next > 0) text += "\n";
      ++next;
    }
    const CurvePoint& q = curves.points[i];
    for (const float v : {q.p.x, q.p.y, q.p.z, q.radius}) text += shortest(v) + " ";
    text.back() = '\n';
  }
  return text;
}

}  // namespace

fs::path PbrtFiles::find(const std::string& name, const Place& at) const {
  if (name.empty() || name.find('\0') != std::string::npos) sources_.fail(at, "expected a file name");
  const fs::path spelled = scene_folder_ / name;
  std::error_code error;
  const fs::path real = real_path(spelled, error);
  if (error) sources_.fail(at, "cannot read " + in_quotes(name) + ": " + error.message());
  if (!allow_outside_ && !is_inside(real, scene_folder_))
    sources_.fail(at, in_quotes(name) + " lies outside the scene's folder (--allow-outside permits it)");
  if (!fs::is_regular_file(real, error)) sources_.fail(at, "no such file: " + in_quotes(name));
  return spelled;
}

std::string PbrtFiles::copy(const fs::path& file) {
  std::error_code error;
  const std::string key = fs::weakly_canonical(file, error).string();
  if (const auto known = copied_.find(key); known != copied_.end()) return known->second;
  const std::string name =
      new_name(file.stem().string(), plain(file.extension().string().substr(file.extension().empty() ? 0 : 1)));
  if (!made_folder_.empty()) fs::copy_file(file, made_folder_ / name, fs::copy_options::overwrite_existing, error);
  if (error) throw InputError(file.string(), "cannot be copied: " + error.message());
  return copied_[key] = name;
}

std::string PbrtFiles::new_name(const std::string& stem, const std::string& ending) {
  const std::string base = plain(stem);
  std::string name = base + "." + ending;
  while (!taken_.insert(name).second) name = base + "-" + std::to_string(++count_[base + ending]) + "." + ending;
  return name;
}

std::string PbrtFiles::write(const TriangleMesh& mesh) {
  const std::string name = new_name("mesh-" + std::to_string(++count_["mesh"]), "ply");
  if (!made_folder_.empty()) write_ply(made_folder_ / name, mesh);
  return name;
}

std::string PbrtFiles::write(const VolumeGrid& grid) {
  const std::string name = new_name("grid-" + std::to_string(++count_["grid"]), "vol");
  if (!made_folder_.empty()) write_file_atomically(made_folder_ / name, bytes_of(grid));
  return name;
}

std::string PbrtFiles::write(const CurveSet& curves) {
  const std::string name = new_name("curves-" + std::to_string(++count_["curves"]), "txt");
  if (!made_folder_.empty()) write_file_atomically(made_folder_ / name, text_of(curves));
  return name;
}

std::string PbrtFiles::write(const Rendering& image, const std::string& stem) {
  const std::string name = new_name(stem, "exr");
  if (!made_folder_.empty()) write_exr((made_folder_ / name).string(), image);
  return name;
}

TriangleMesh read_plain_or_packed_ply(const fs::path& file) {
  if (file.extension() != ".gz") return read_ply(file.string());
  constexpr std::size_t most = std::size_t{2} << 30, piece = std::size_t{1} << 20;
  const auto close = [](gzFile_s* f) { gzclose(f); };
  const std::unique_ptr<gzFile_s, decltype(close)> packed(gzopen(file.c_str(), "rb"), close);
  if (!packed) throw InputError(file.string(), "cannot be opened");
  std::string bytes;
  for (;;) {
    const std::size_t size = bytes.size();
    if (size > most) throw InputError(file.string(), "has more than 2 GiB");
    bytes.resize(size + piece);
    const int got = gzread(packed.get(), bytes.data() + size, piece);
    if (got < 0) throw InputError(file.string(), "cannot be unpacked");
    bytes.resize(size + static_cast<std::size_t>(got));
    if (got == 0) break;
  }
  return parse_ply(bytes, file.string());
}

}  // namespace photonproof::inline scenes_pbrt
