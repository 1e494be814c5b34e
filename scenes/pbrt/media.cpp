#include "scenes/pbrt/media.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scenes/base/text_numbers.h"

namespace photonproof::inline scenes_pbrt {
namespace {

constexpr int kMostCells = 1 << 20;  ///< along an axis

double share(double part, double whole) { return whole > 0 ? part / whole : 0; }
RgbD share(const RgbD& part, const RgbD& whole) {
  return {share(part.x, whole.x), share(part.y, whole.y), share(part.z, whole.z)};
}

PhaseDescription phase_of(const PbrtParameters& p) {
  const double g = p.number("g", 0);
  if (g == 0) return IsotropicDescription{};
  return HenyeyGreensteinDescription{std::clamp(g, -0.999, 0.999)};
}

HomogeneousDescription homogeneous(PbrtContext& context, const PbrtParameters& p) {
  if (p.has("preset")) p.fail("names a measured material, expected sigma_a and sigma_s");
  const double scale = p.number("scale", 1, 0, 1e30);
  // The defaults are pbrt's.
  const RgbD absorbed = context.spectra.colour(p, "sigma_a").value_or(RgbD(0.0011, 0.0024, 0.014)) * scale;
  const RgbD scattered = context.spectra.colour(p, "sigma_s").value_or(RgbD(2.55, 3.21, 3.77)) * scale;
  HomogeneousDescription medium;
  medium.sigma_t = absorbed + scattered;
  medium.albedo = share(scattered, medium.sigma_t);
  return medium;
}

/// The cells of a grid and the box around them.
class PbrtGrid {
 public:
  PbrtGrid(PbrtContext& context, const PbrtEntity& medium) : context_(context), p_(medium.parameters) {
    int* const cells[] = {&empty_.width, &empty_.height, &empty_.depth};
    const char* const names[] = {"nx", "ny", "nz"};
    for (std::size_t axis = 0; axis < 3; ++axis) *cells[axis] = p_.integer(names[axis], 1, 1, kMostCells);
    const Vec3d low = p_.point("p0", Vec3d(0.0)), high = p_.point("p1", Vec3d(1.0));
    const Vec3d size = high - low;
    if (!(size.x > 0 && size.y > 0 && size.z > 0)) p_.fail("expected p1 above p0 in x, y and z");
    to_world_ = context.to_ours * medium.ctm * Transform::translate(low) * Transform::scale(size);
    if (!to_world_.inverse()) p_.fail("is flattened by its transform");
  }

  std::size_t count() const {
    return static_cast<std::size_t>(empty_.width) * static_cast<std::size_t>(empty_.height) *
           static_cast<std::size_t>(empty_.depth);
  }

  /// The values of a parameter, `channels` for each cell; empty where it is not given.
  std::vector<double> values(const char* name, const char* type, std::size_t channels) const {
    std::vector<double> given = p_.numbers(name, {type});
    if (!p_.has(name)) return {};
    const PbrtParameter& parameter = *p_.find(name, {type});
    if (given.size() != channels * count())
      p_.fail(parameter, "has " + std::to_string(given.size()) + " values, expected " +
                             std::to_string(channels * count()) + " for nx times ny times nz cells");
    if (std::ranges::any_of(given, [](double v) { return !(v >= 0 && v <= 1e30); }))
      p_.fail(parameter, "has a value that is negative or too large");
    return given;
  }

  GridVolumeDescription volume(const std::vector<double>& values, int channels) const {
    VolumeGrid grid = empty_;
    grid.channels = channels;
    grid.values.assign(values.begin(), values.end());
    if (has_dense_border(grid))
      context_.log.note(p_.at(),
                        "the outer half of a grid's outer cells is as dense as their middle: pbrt fades it out");
    GridVolumeDescription made;
    made.filename = context_.files.write(grid);
    made.to_world = to_world_;
    return made;
  }

 private:
  static bool has_dense_border(const VolumeGrid& grid) {
    const auto width = static_cast<std::size_t>(grid.width), height = static_cast<std::size_t>(grid.height),
               depth = static_cast<std::size_t>(grid.depth), channels = static_cast<std::size_t>(grid.channels);
    for (std::size_t i = 0; i < grid.values.size(); ++i) {
      const std::size_t cell = i / channels, x = cell % width, y = cell / width % height, z = cell / width / height;
      const bool border = x == 0 || x + 1 == width || y == 0 || y + 1 == height || z == 0 || z + 1 == depth;
      if (border && grid.values[i] > 0) return true;
    }
    return false;
  }

  PbrtContext& context_;
  const PbrtParameters& p_;
  VolumeGrid empty_;
  Transform to_world_;
};

/// A density times colours that are the same everywhere.
HeterogeneousDescription uniform_grid(PbrtContext& context, const PbrtEntity& entity) {
  const PbrtParameters& p = entity.parameters;
  if (p.has("temperature")) p.fail("emits light, which media here do not");
  const PbrtGrid grid(context, entity);
  const std::vector<double> density = grid.values("density", "float", 1);
  if (density.empty()) p.fail("expected a \"float density\"");
  const RgbD absorbed = context.spectra.colour(p, "sigma_a").value_or(RgbD(1.0));
  const RgbD scattered = context.spectra.colour(p, "sigma_s").value_or(RgbD(1.0));
  const RgbD extinction = absorbed + scattered;
  HeterogeneousDescription medium;
  medium.albedo = share(scattered, extinction);
  medium.scale = p.number("scale", 1, 0, 1e30);
  if (extinction.x == extinction.y && extinction.y == extinction.z) {
    medium.sigma_t = grid.volume(density, 1);
    medium.scale *= extinction.x;
    return medium;
  }
  std::vector<double> colours;
  colours.reserve(3 * density.size());
  for (const double d : density) colours.insert(colours.end(), {d * extinction.x, d * extinction.y, d * extinction.z});
  medium.sigma_t = grid.volume(colours, 3);
  return medium;
}

/// Colours in each cell. One of the two that is not given is 1 everywhere, as in pbrt.
HeterogeneousDescription rgb_grid(PbrtContext& context, const PbrtEntity& entity) {
  const PbrtParameters& p = entity.parameters;
  const PbrtGrid grid(context, entity);
  std::vector<double> absorbed = grid.values("sigma_a", "rgb", 3), scattered = grid.values("sigma_s", "rgb", 3);
  if (absorbed.empty() && scattered.empty()) p.fail("expected \"rgb sigma_a\" or \"rgb sigma_s\"");
  absorbed.resize(3 * grid.count(), absorbed.empty() ? 1 : 0);
  scattered.resize(3 * grid.count(), scattered.empty() ? 1 : 0);
  std::vector<double> extinction = absorbed, albedo = scattered;
  bool varies = false;
  for (std::size_t i = 0; i < extinction.size(); ++i) {
    extinction[i] += scattered[i];
    albedo[i] = share(scattered[i], extinction[i]);
    varies = varies || albedo[i] != albedo[i % 3];
  }
  HeterogeneousDescription medium;
  medium.sigma_t = grid.volume(extinction, 3);
  medium.scale = p.number("scale", 1, 0, 1e30);
  if (varies) {
    context.log.note(p.at(), "the albedo of an 'rgbgrid' is interpolated between cells in place of sigma_s");
    medium.albedo = grid.volume(albedo, 3);
  } else {
    medium.albedo = RgbD(albedo[0], albedo[1], albedo[2]);
  }
  return medium;
}

}  // namespace

void add_pbrt_medium(PbrtContext& context, const std::string& name, const PbrtEntity& entity) {
  const PbrtParameters& p = entity.parameters;
  const std::string type = p.text("type", "");
  if (type == "nanovdb") p.fail("names a grid of NanoVDB, which is not read, expected uniformgrid or rgbgrid");
  if (type != "homogeneous" && type != "uniformgrid" && type != "rgbgrid")
    p.fail("has the type " + in_quotes(type) + ", expected homogeneous, uniformgrid or rgbgrid");
  if (p.has("Le") || p.has("Lescale")) p.fail("emits light, which media here do not");
  MediumDescription medium;
  medium.id = "medium-" + std::to_string(context.scene.media.size());
  if (type == "homogeneous")
    medium.model = homogeneous(context, p);
  else
    medium.model = type == "rgbgrid" ? rgb_grid(context, entity) : uniform_grid(context, entity);
  scenes_description::phase_of(medium) = phase_of(p);
  p.finish();
  context.media[name] = {static_cast<std::uint32_t>(context.scene.media.size())};
  context.scene.media.push_back(medium);
}

}  // namespace photonproof::inline scenes_pbrt
