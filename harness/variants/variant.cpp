#include "harness/variants/variant.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "harness/variants/colours.h"
#include "harness/variants/draws.h"
#include "harness/variants/more_spheres.h"
#include "harness/variants/motions.h"
#include "harness/variants/split_light.h"
#include "scenes/base/text_numbers.h"

namespace photonproof::inline harness_variants {
namespace {

using ImageChange = std::function<Image(const Image&)>;

/// The variance of a pixel changes as the pixel does.
void predict_by(Variant& variant, const ImageChange& change) {
  variant.predicted = change;
  variant.predicted_variance = change;
}

Image same_image(const Image& image) { return image; }

/// pick(x, y, channel) gives the new image's value.
template <class Pick>
Image image_of(int width, int height, const Pick& pick) {
  Image image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < 3; ++c) image.pixel(x, y)[c] = pick(x, y, c);
  return image;
}

void make_mirror(Variant& variant, const VariantOptions&) {
  mirror_in_view(variant.scene);
  variant.says = "the whole scene mirrored left to right: its image is the base's, mirrored";
  predict_by(variant, [](const Image& base) {
    return image_of(base.width, base.height, [&](int x, int y, int c) { return base.pixel(base.width - 1 - x, y)[c]; });
  });
}

bool has_water(const SceneDescription& scene) {
  return std::any_of(scene.shapes.begin(), scene.shapes.end(), [](const ShapeDescription& shape) {
    return std::holds_alternative<HeightfieldDescription>(shape.geometry);
  });
}

/// Distance from the camera to the origin of the farthest shape: the unit of moves.
double scale_of(const SceneDescription& scene) {
  double far = 0;
  const Vec3d eye = scene.sensor.to_world.point({0, 0, 0});
  for (const ShapeDescription& shape : scene.shapes)
    if (!std::holds_alternative<PlaneDescription>(shape.geometry))
      far = std::max(far, length(shape.to_world.point({0, 0, 0}) - eye));
  return far > 0 ? far : 1;
}

Transform drawn_turn(const SceneDescription& scene, VariantDraws& draws, bool axis_aligned) {
  if (axis_aligned) {
    // 90, 180 or 270 degrees are cosines of 0 and 1 exactly, which rotate() would miss by rounding.
    if (has_water(scene)) return {};
    const std::array<std::array<double, 2>, 3> turns{{{0, 1}, {-1, 0}, {0, -1}}};
    const auto [cosine, sine] = turns[static_cast<std::size_t>(draws.below(3))];
    Transform turn;
    turn.m = {cosine, 0, sine, 0, 0, 1, 0, 0, -sine, 0, cosine, 0, 0, 0, 0, 1};
    return turn;
  }
  const double z = draws.between(-1, 1), angle = draws.between(0, 2 * M_PI), r = std::sqrt(1 - z * z);
  return Transform::rotate({r * std::cos(angle), r * std::sin(angle), z}, draws.between(20, 160));
}

void make_rigid_move(Variant& variant, const VariantOptions& options) {
  VariantDraws draws(variant.seed, 2);
  const Transform turn = drawn_turn(variant.scene, draws, options.axis_aligned);
  const double reach = scale_of(variant.scene) * 0.5;
  // Moves are whole numbers if the scene is large enough, so that a course's file stays easy to read.
  const auto step = [&] {
    const double by = draws.between(0.2, 1) * (draws.below(2) == 0 ? -reach : reach);
    return reach >= 10 ? std::round(by) : std::round(by * 16) / 16;
  };
  const double x = step(), y = step(), z = step();
  move_everything(variant.scene, Transform::translate({x, y, z}) * turn);
  variant.says = "everything, camera and lights too, turned and moved: its image is the base's";
  predict_by(variant, same_image);
}

void make_light_scale(Variant& variant, const VariantOptions&) {
  VariantDraws draws(variant.seed, 3);
  // A factor over 1 keeps clamped white clamped, so the prediction holds after clamping.
  const double factor = std::round(draws.between(1.25, 1.75) * 100) / 100;
  scale_lights(variant.scene, factor);
  const std::string words = format_number(factor);
  variant.says =
      "every light " + words + " times as bright: its image is " + words + " times the base's, before clamping";
  const auto times = [](double by) {
    return [by](const Image& base) {
      Image image = base;
      for (float& v : image.rgb) v = static_cast<float>(v * by);
      return image;
    };
  };
  variant.predicted = times(factor);
  variant.predicted_variance = times(factor * factor);
}

void make_colour_permutation(Variant& variant, const VariantOptions&) {
  static constexpr std::array<std::array<int, 3>, 5> orders{{{1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};
  const std::array<int, 3> order = orders[static_cast<std::size_t>(VariantDraws(variant.seed, 4).below(5))];
  change_all_colours(variant.scene, [order](const RgbD& c) {
    const double from[] = {c.x, c.y, c.z};
    return RgbD(from[order[0]], from[order[1]], from[order[2]]);
  });
  std::string words;
  for (const int channel : order) words += (words.empty() ? "" : ", ") + std::string(1, "RGB"[channel]);
  variant.says = "channels of every colour in the order " + words + ": so are its image's";
  predict_by(variant, [order](const Image& base) {
    return image_of(base.width, base.height,
                    [&](int x, int y, int c) { return base.pixel(x, y)[order[static_cast<std::size_t>(c)]]; });
  });
}

void make_superposition(Variant& variant, const VariantOptions&) {
  VariantDraws draws(variant.seed, 5);
  split_a_light(variant.scene, draws.below(1 << 16), draws.between(0.3, 0.7), draws.below(2) == 0);
  variant.says = "a light cut in two, which shine together: light adds up, and the image is the base's";
  predict_by(variant, same_image);
}

void make_object_order(Variant& variant, const VariantOptions&) {
  std::vector<ShapeDescription>& shapes = variant.scene.shapes;
  if (shapes.size() < 2) throw InputError("object-order", "the scene has fewer than two objects");
  VariantDraws draws(variant.seed, 6);
  // Sattolo's algorithm: one cycle, so that no object keeps its place.
  for (std::size_t i = shapes.size() - 1; i > 0; --i)
    std::swap(shapes[i], shapes[static_cast<std::size_t>(draws.below(static_cast<int>(i)))]);
  variant.says = "objects in another order: its image is the base's";
  predict_by(variant, same_image);
}

Image block_means(const Image& base, int side) {
  return image_of(base.width / side, base.height / side, [&](int x, int y, int c) {
    double sum = 0;
    for (int dy = 0; dy < side; ++dy)
      for (int dx = 0; dx < side; ++dx) sum += base.pixel(x * side + dx, y * side + dy)[c];
    return static_cast<float>(sum / (side * side));
  });
}

void make_resolution(Variant& variant, const VariantOptions&) {
  std::vector<int> sides;
  for (const int side : {2, 3, 4})
    if (variant.width % side == 0 && variant.height % side == 0 && std::min(variant.width, variant.height) / side >= 8)
      sides.push_back(side);
  if (sides.empty()) throw InputError("resolution", "the image's width and height are not both divisible by 2, 3 or 4");
  VariantDraws draws(variant.seed, 7);
  const int side = sides[static_cast<std::size_t>(draws.below(static_cast<int>(sides.size())))];
  variant.width /= side;
  variant.height /= side;
  const std::string words = std::to_string(side);
  variant.says =
      "1/" + words + " of the pixels a side: each is the mean of " + words + " x " + words + " of the base's";
  variant.predicted = [side](const Image& base) { return block_means(base, side); };
  variant.predicted_variance = [side](const Image& base) {
    Image variance = block_means(base, side);
    for (float& v : variance.rgb) v /= static_cast<float>(side * side);
    return variance;
  };
}

void make_crop(Variant& variant, const VariantOptions& options) {
  auto* camera = std::get_if<PerspectiveDescription>(&variant.scene.sensor.camera);
  if (!camera) throw InputError("crop", "only the view of a perspective camera is narrowed");
  VariantDraws draws(variant.seed, 9);
  const int quarters[] = {6, 8};  // base size by variant size, in quarters
  const int by = quarters[draws.below(2)];
  if (variant.width % 4 != 0 || variant.height % 4 != 0)
    throw InputError("crop", "the image's width and height must be multiples of 4");
  variant.base_width = variant.width * by / 4;
  variant.base_height = variant.height * by / 4;
  variant.usual_base = false;
  const double zoom = by / 4.0;
  int left = (variant.base_width - variant.width) / 2, top = (variant.base_height - variant.height) / 2;
  if (!options.axis_aligned) {
    left = draws.below(2 * left + 1);
    top = draws.below(2 * top + 1);
  }
  camera->fov_degrees = 2 * 180 / M_PI * std::atan(std::tan(camera->fov_degrees * M_PI / 360) / zoom);
  // The principal point's offset, in parts of the narrower view.
  const double half_x = 0.5 * (variant.base_width - variant.width),
               half_y = 0.5 * (variant.base_height - variant.height);
  camera->principal_x = camera->principal_x * zoom + (left - half_x) / variant.width;
  camera->principal_y = camera->principal_y * zoom + (top - half_y) / variant.height;
  variant.says = "a part of the view " + format_number(zoom) +
                 " times as large: its image is that part of a base with " + format_number(zoom) +
                 " times the pixels a side";
  const int width = variant.width, height = variant.height;
  predict_by(variant, [=](const Image& base) {
    return image_of(width, height, [&](int x, int y, int c) { return base.pixel(left + x, top + y)[c]; });
  });
}

void make_more_spheres(Variant& variant, const VariantOptions&) {
  variant.says = add_spheres(variant.scene, variant.seed) + ": a new reference";
}

struct KindRow {
  const char* name;
  void (*make)(Variant&, const VariantOptions&);
};
constexpr KindRow kind_rows[] = {
    {"mirror", make_mirror},
    {"rigid-move", make_rigid_move},
    {"light-scale", make_light_scale},
    {"colour-permutation", make_colour_permutation},
    {"superposition", make_superposition},
    {"object-order", make_object_order},
    {"resolution", make_resolution},
    {"crop", make_crop},
    {"more-spheres", make_more_spheres},
};

}  // namespace

const std::vector<std::string>& variant_kinds() {
  static const std::vector<std::string> kinds = [] {
    std::vector<std::string> names;
    for (const KindRow& row : kind_rows) names.emplace_back(row.name);
    return names;
  }();
  return kinds;
}

Variant make_variant(const std::string& kind, std::uint64_t seed, const SceneDescription& base, int width, int height,
                     const VariantOptions& options) {
  const auto* row =
      std::find_if(std::begin(kind_rows), std::end(kind_rows), [&](const KindRow& r) { return kind == r.name; });
  if (row == std::end(kind_rows)) {
    std::string names;
    for (const std::string& name : variant_kinds()) names += (names.empty() ? "" : ", ") + name;
    throw InputError("variant", "there is no kind " + in_quotes(kind) + ", expected one of " + names);
  }
  Variant variant;
  variant.kind = kind;
  variant.seed = seed;
  variant.scene = base;
  variant.width = variant.base_width = width;
  variant.height = variant.base_height = height;
  variant.scene.sensor.film.crop.reset();
  variant.scene.sensor.film.width = width;
  variant.scene.sensor.film.height = height;
  row->make(variant, options);
  variant.scene.sensor.film.width = variant.width;
  variant.scene.sensor.film.height = variant.height;
  return variant;
}

}  // namespace photonproof::inline harness_variants
