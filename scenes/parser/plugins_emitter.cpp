// Mitsuba 3's emitters and the extension ies: rules that a description alone does not state.
#include "scenes/description/description.h"
#include "scenes/parser/plugin_reader.h"

namespace photonproof::scene_xml {
namespace {

using Light = decltype(EmitterDescription::light);

/// The image, or one of at least 2x3 pixels that shows the same: rows and columns of a single one are repeated, and
/// between two rows comes their mean. Interpolation between pixels needs that size.
std::shared_ptr<const Image> at_least_2x3(const std::shared_ptr<const Image>& image) {
  if (image->width >= 2 && image->height >= 3) return image;
  auto larger = std::make_shared<Image>(std::max(image->width, 2), std::max(image->height, 3));
  const auto pixel = [&](int x, int y) {
    const std::size_t at =
        3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image->width) + static_cast<std::size_t>(x));
    return Rgb(image->rgb[at], image->rgb[at + 1], image->rgb[at + 2]);
  };
  std::size_t at = 0;
  for (int y = 0; y < larger->height; ++y)
    for (int x = 0; x < larger->width; ++x) {
      const int column = std::min(x, image->width - 1),
                first = std::min(image->height == 2 ? y / 2 : y, image->height - 1);
      const int second = image->height == 2 ? (y + 1) / 2 : first;
      const Rgb colour = (pixel(column, first) + pixel(column, second)) * 0.5f;
      for (const float c : {colour.x, colour.y, colour.z}) larger->rgb[at++] = c;
    }
  return larger;
}

struct CompleteEmitter {
  Params& params;

  /// A light without a file is complete; one with a place may be moved, turned and scaled evenly.
  template <class Light>
  requires(!requires(Light & d) { d.filename; }) void operator()(Light&) const {
    if constexpr (requires(Light & d) { d.to_world; }) expect_similarity(params, "the light");
  }
  void operator()(PointLightDescription& d) const {
    expect_alone(params, "position", "to_world");
    if (params.has("to_world")) d.position = params.transform("to_world").point({0, 0, 0});
  }
  void operator()(SpotLightDescription& d) const {
    expect_similarity(params, "the light");
    params.expect(d.beam_degrees >= 0 && d.beam_degrees <= d.cutoff_degrees, "beam_width",
                  "is " + format_number(d.beam_degrees) + ", expected from 0 to cutoff_angle, " +
                      format_number(d.cutoff_degrees));
  }
  void operator()(DirectionalLightDescription& d) const {
    expect_alone(params, "direction", "to_world");
    if (!params.has("to_world")) return;
    const Transform to_world = params.transform("to_world");
    params.expect(to_world.inverse().has_value(), "to_world", "is singular: it flattens the light");
    d.direction = normalize(to_world.vector({0, 0, 1}));
  }
  void operator()(EnvmapDescription& d) const {
    params.expect(is_even(d.to_world), "to_world", "scales unevenly or shears the map, expected a uniform scale");
    const auto loaded = params.objects().files().image(params.value_of("filename"), false);
    d.filename = loaded.name;
    d.image = at_least_2x3(loaded.content);
  }
  /// Its place is checked with the sun's direction (PluginReader::sun).
  void operator()(SunSkyDescription&) const {}
  void operator()(IesLightDescription& d) const {
    expect_similarity(params, "the light");
    const auto loaded = params.objects().files().ies(params.value_of("filename"));
    d.filename = loaded.name;
    d.profile = loaded.content;
  }
};

const std::vector<Plugin<Light>>& scene_table() {
  static const std::vector<Plugin<Light>> rows = described_plugins<Light, CompleteEmitter>();
  return rows;
}

bool has_type(const Element& element, const std::string& type) {
  const Attribute* given = element.find("type");
  return given && given->value == type;
}

}  // namespace

ShapeEmission read_shape_emitter(SceneObjects& objects, const Element& element) {
  for (const auto& row : scene_table())
    if (has_type(element, row.type))
      objects.sources().fail(element.find("type")->at,
                             "emitter '" + row.type + "' cannot stand in a shape, expected it directly in <scene>");
  using Emitter = std::variant<AreaEmitter, DirectionalAreaEmitter>;
  static const std::vector<Plugin<Emitter>> shape_table = described_plugins<Emitter, CompleteEmitter>();
  const Emitter emitter = build_plugin(objects, element, shape_table);
  if (const auto* beam = std::get_if<DirectionalAreaEmitter>(&emitter)) return {beam->radiance, true};
  return {std::get<AreaEmitter>(emitter).radiance};
}

EmitterDescription read_emitter(SceneObjects& objects, const Element& element) {
  for (const char* type : {"area", "directionalarea"})
    if (has_type(element, type))
      objects.sources().fail(element.find("type")->at,
                             "emitter " + in_quotes(type) + " needs a surface, expected it inside a <shape>");
  return {objects.sources().loc(element.at), id_of(element), build_plugin(objects, element, scene_table())};
}

}  // namespace photonproof::scene_xml
