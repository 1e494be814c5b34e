#include "harness/verify/probes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "harness/cells/cells.h"
#include "reference/store/reference_store.h"
#include "scenes/base/input_error.h"
#include "scenes/base/percent_text.h"
#include "scenes/description/overloaded.h"
#include "scenes/files/atomic_file.h"
#include "scenes/parser/parser.h"

namespace photonproof::inline harness_verify {
namespace {

namespace fs = std::filesystem;

constexpr int kSide = 32;
/// Relative error beyond noise that counts as right: for engines that claim to be exact, and for others.
constexpr double kExact = 0.003, kOther = 0.01;

Image expected_image(const Probe& probe, int width, int height) {
  constexpr int points = 4;
  Image image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      RgbD sum(0.0);
      for (int i = 0; i < points * points; ++i)
        sum = sum + probe.radiance(2 * (x + (i % points + 0.5) / points) / width - 1,
                                   1 - 2 * (y + (i / points + 0.5) / points) / height);
      const RgbD mean = sum * (1.0 / (points * points));
      float* pixel = image.pixel(x, y);
      pixel[0] = static_cast<float>(mean.x);
      pixel[1] = static_cast<float>(mean.y);
      pixel[2] = static_cast<float>(mean.z);
    }
  return image;
}

/// Sums over all values: c the closed form's, y the picture's.
struct Sums {
  double n = 0, c = 0, y = 0, cc = 0, cy = 0, noise = 0;
};

Sums sums_of(const Image& expected, const EnginePicture& picture) {
  Sums s;
  for (std::size_t i = 0; i < expected.rgb.size(); ++i) {
    const double c = double{expected.rgb[i]}, y = double{picture.rendering.mean.rgb[i]};
    s.n += 1;
    s.c += c;
    s.y += y;
    s.cc += c * c;
    s.cy += c * y;
    s.noise += double{picture.rendering.variance->rgb[i]};
  }
  return s;
}

double residual_variance(const Image& expected, const EnginePicture& picture, double gain, double offset) {
  double sum = 0;
  for (std::size_t i = 0; i < expected.rgb.size(); ++i)
    sum += std::pow(double{picture.rendering.mean.rgb[i]} - gain * double{expected.rgb[i]} - offset, 2);
  return sum / std::max(1.0, double(expected.rgb.size()) - 2);
}

VerifyProbe judged(const Probe& probe, const VerifyEngine& engine, const EnginePicture& picture) {
  const ProbeFit fit = fit_probe(probe, picture);
  VerifyProbe out{engine.row.name, probe.kind, probe.what, "right", "", fit.gain, fit.gain_error, std::nullopt};
  if (fit.has_offset) out.offset = fit.offset;
  const double allowed = engine.row.trust == Trust::unbiased ? kExact : kOther;
  const auto beyond = [&](double off, double error) { return std::abs(off) > allowed + 4 * error; };
  if (beyond(fit.gain - 1, fit.gain_error) || (fit.has_offset && beyond(fit.offset, fit.offset_error)))
    out.verdict = "wrong";
  out.sentence = fmt::format("{}: {} {:.3g}x closed form", probe.what, engine.row.title, fit.gain);
  if (fit.has_offset && beyond(fit.offset, fit.offset_error))
    out.sentence += " " + signed_percent_text(fit.offset) + " of its mean";
  return out;
}

/// Content of the scene and its files.
std::string content_of(const Probe& probe) {
  std::vector<std::string> parts{probe.scene};
  for (const ProbeFile& file : probe.files) {
    parts.push_back(file.name);
    if (const auto* text = std::get_if<std::string>(&file.content)) {
      parts.push_back(*text);
      continue;
    }
    const Image& image = std::get<Image>(file.content);
    parts.push_back(std::to_string(image.width));
    parts.emplace_back(reinterpret_cast<const char*>(image.rgb.data()), image.rgb.size() * sizeof(float));
  }
  return length_prefixed(parts);
}

/// Cache file for a probe of this content. Empty without a home folder, or if the engine has no version.
fs::path cache_file(const std::string& content, const VerifyEngine& engine, double power) {
  if (engine.version.line.empty()) return {};
  try {
    const std::string key = content_key({{"probe", "2"},
                                         {"scene", content},
                                         {"engine", engine_content(engine.row)},
                                         {"version", engine.version.line},
                                         {"power", std::to_string(power)}});
    return cache_folder() / "probes" / (key + ".json");
  } catch (const InputError&) {
    return {};
  }
}

VerifyProbe probed(const EngineRenderer& renderer, const Probe& probe, const VerifyEngine& engine) {
  const std::string content = content_of(probe);
  const fs::path kept = cache_file(content, engine, renderer.options().power);
  if (!kept.empty() && fs::exists(kept))
    if (auto known = verify_probe_from(read_file(kept)); known && known->engine == engine.row.name) return *known;
  std::string name = probe.what;
  std::ranges::replace(name, ' ', '-');
  const fs::path file = renderer.options().folder / "probes" / (name + ".xml");
  fs::create_directories(file.parent_path());
  const SceneDescription description = write_probe(probe, file);
  const RenderedScene scene{"probe-" + name, file, content_key({{"probe", content}}), kSide, kSide, {}, &description};
  const EngineRender render = renderer.render(scene, engine);
  if (!render.picture) {
    VerifyProbe refused{engine.row.name, probe.kind, probe.what, "not rendered", render.detail, {}, {}, {}};
    return refused;
  }
  VerifyProbe result = judged(probe, engine, *render.picture);
  std::error_code ignored;  // failing to write the cache is no error
  if (!kept.empty() && (fs::create_directories(kept.parent_path(), ignored), !ignored)) {
    try {
      write_file_atomically(kept, verify_probe_text(result));
    } catch (const InputError&) {
    }
  }
  return result;
}

class Kinds {
 public:
  explicit Kinds(const SceneDescription& scene) {
    for (const EmitterDescription& emitter : scene.emitters)
      std::visit(Overloaded{[&](const PointLightDescription&) { add("point light"); },
                            [&](const SpotLightDescription&) { add("spot light"); },
                            [&](const DirectionalLightDescription&) { add("directional light"); },
                            [&](const ConstantLightDescription&) { add("constant sky"); },
                            [&](const EnvmapDescription&) { add("image sky"); },
                            [&](const SunSkyDescription&) { add("sun and sky"); },
                            [&](const IesLightDescription&) { add("IES light"); }, [](const ProjectorDescription&) {}},
                 emitter.light);
    for (const ShapeDescription& shape : scene.shapes) {
      if (!shape.radiance) continue;
      std::visit(Overloaded{[&](const RectangleDescription&) { add("rectangular light"); },
                            [&](const SphereDescription&) { add("spherical light"); },
                            [&](const DiskDescription&) { add("disk light"); },
                            [&](const CylinderDescription&) { add("cylindrical light"); },
                            [&](const MeshDescription&) { add("mesh light"); }, [](const auto&) {}},
                 shape.geometry);
    }
    for (const BsdfDescription& bsdf : scene.bsdfs)
      std::visit(
          Overloaded{
              [&](const DiffuseDescription&) { add("diffuse"); }, [&](const ConductorDescription&) { add("mirror"); },
              [&](const DielectricDescription&) { add("glass"), add("lossless glass"); },
              [&](const ThinDielectricDescription&) { add("thin glass"); },
              [&](const PlasticDescription&) { add("plastic"); }, [&](const MaskDescription&) { add("mask"); },
              [&](const BlendDescription&) { add("blend"); },
              [&](const RoughConductorDescription&) { add("rough metal"); },
              [&](const RoughDielectricDescription&) { add("rough glass"); },
              [](const DiffuseTransmitterDescription&) {},
              [&](const RoughPlasticDescription&) { add("rough plastic"); }, [](const PrincipledDescription&) {},
              [](const PrincipledThinDescription&) {}, [&](const PhongDescription&) { add("phong"); },
              [&](const LayeredDescription&) { add("lacquer"); },
              [&](const NormalMapDescription&) { add("normal map"); },
              [&](const BumpMapDescription&) { add("bump map"); },
              [&](const TwoSidedDescription&) { add("two-sided"); }, [&](const NullDescription&) { add("null"); }},
          bsdf.model);
    for (const TextureDescription& texture : scene.textures)
      std::visit(Overloaded{[&](const CheckerboardDescription&) { add("checkerboard"); },
                            [&](const BitmapDescription&) { add("bitmap"); }, [](const MeshAttributeDescription&) {},
                            [](const ScaledTextureDescription&) {}, [](const VolumeTextureDescription&) {}},
                 texture.pattern);
    std::visit(Overloaded{[&](const PerspectiveDescription&) { add("perspective camera"); },
                          [&](const ThinLensDescription&) { add("thin lens"); },
                          [&](const OrthographicDescription&) { add("orthographic camera"); },
                          [&](const FisheyeDescription&) { add("fisheye camera"); }, [](const auto&) {}},
               scene.sensor.camera);
    for (const MediumDescription& medium : scene.media) {
      if (medium.varies())
        add("varying medium");
      else
        add(max_component(bounds_of(medium).scattering) > 0 ? "scattering medium" : "absorbing medium");
    }
  }
  std::vector<std::string> names() const { return {names_.begin(), names_.end()}; }

 private:
  void add(const char* name) { names_.insert(name); }
  std::set<std::string> names_;
};

}  // namespace

std::vector<std::string> kinds_in(const SceneDescription& scene) { return Kinds(scene).names(); }

SceneDescription write_probe(const Probe& probe, const fs::path& file) {
  for (const ProbeFile& beside : probe.files) {
    const fs::path path = file.parent_path() / beside.name;
    std::visit(Overloaded{[&](const std::string& text) { write_file_atomically(path, text); },
                          [&](const Image& image) {
                            write_exr(path.string(), {image, {}, {}});
                          }},
               beside.content);
  }
  write_file_atomically(file, probe.scene);
  return parse_scene_text(probe.scene, file.string());
}

ProbeFit fit_probe(const Probe& probe, const EnginePicture& picture) {
  const Image expected = expected_image(probe, picture.rendering.mean.width, picture.rendering.mean.height);
  const Sums s = sums_of(expected, picture);
  const double mean = s.c / s.n, spread = s.cc - s.c * s.c / s.n;
  ProbeFit fit;
  const double independent = s.n / 3;      // channels of a pixel may share samples
  constexpr double least_variation = 0.1;  // relative deviation over the image
  fit.has_offset = std::sqrt(std::max(0.0, spread / s.n)) > least_variation * mean;
  const auto gain_alone = [&] {
    ProbeFit alone;
    alone.gain = s.y / s.c;
    const double variance = std::max(s.noise / s.n, residual_variance(expected, picture, alone.gain, 0));
    alone.gain_error = std::sqrt(variance / independent) / mean;
    return alone;
  };
  if (!fit.has_offset) return gain_alone();
  fit.gain = (s.cy - s.c * s.y / s.n) / spread;
  const double offset = (s.y - fit.gain * s.c) / s.n;
  const double variance = std::max(s.noise / s.n, residual_variance(expected, picture, fit.gain, offset));
  fit.gain_error = std::sqrt(3 * variance / spread);
  constexpr double told_apart = 0.1;  // noise hides which of the two it is
  if (fit.gain_error > told_apart) return gain_alone();
  fit.offset = offset / mean;
  fit.offset_error = std::sqrt(variance * (1 / independent + 3 * mean * mean / spread)) / mean;
  return fit;
}

std::vector<VerifyProbe> probe_engines(const EngineRenderer& renderer, const std::vector<VerifyEngine>& engines,
                                       const std::vector<std::string>& kinds, const std::vector<VerifyProbe>& known) {
  std::vector<VerifyProbe> results;
  for (const Probe& probe : probe_rows()) {
    if (std::ranges::find(kinds, probe.what) == kinds.end()) continue;
    for (const VerifyEngine& engine : engines) {
      const auto is_this = [&](const VerifyProbe& p) { return p.what == probe.what && p.engine == engine.row.name; };
      if (engine.version.problem || std::ranges::any_of(known, is_this)) continue;
      results.push_back(probed(renderer, probe, engine));
    }
  }
  return results;
}

}  // namespace photonproof::inline harness_verify
