// Mitsuba 3's hdrfilm with the filters box, tent and gaussian; defaults are its.
#include "scenes/parser/plugins.h"

namespace photonproof::scene_xml {
namespace {

constexpr std::int64_t kMaxSide = 65536;
constexpr std::int64_t kMaxPixels = std::int64_t{1} << 28;

using Filter = ReconstructionFilter;

Filter build_box(Params&) { return {Filter::Kind::box}; }

Filter build_tent(Params& params) {
  Filter filter{Filter::Kind::tent};
  filter.radius = params.positive("radius", filter.radius);
  params.expect(filter.radius <= 16, "radius", "is " + format_number(filter.radius) + ", expected at most 16 pixels");
  return filter;
}

Filter build_gaussian(Params& params) {
  Filter filter{Filter::Kind::gaussian};
  filter.stddev = params.positive("stddev", filter.stddev);
  params.expect(filter.stddev <= 4, "stddev", "is " + format_number(filter.stddev) + ", expected at most 4 pixels");
  return filter;
}

const std::vector<Plugin<Filter>>& filter_table() {
  static const std::vector<Plugin<Filter>> rows = {
      {"box", {}, {}, build_box},
      {"gaussian", {{"stddev", ParamType::number}}, {}, build_gaussian},
      {"tent", {{"radius", ParamType::number}}, {}, build_tent},
  };
  return rows;
}

void expect_one_of(Params& params, const std::string& name, const std::vector<std::string>& words) {
  const std::string value = params.string(name, words.front());
  params.expect(std::find(words.begin(), words.end(), value) != words.end(), name,
                "is " + in_quotes(value) + ", expected " + join_or(words));
}

std::optional<FilmDescription::Crop> read_crop(Params& params, const FilmDescription& film) {
  const bool given = params.has("crop_offset_x") || params.has("crop_offset_y") || params.has("crop_width") ||
                     params.has("crop_height");
  if (!given) return std::nullopt;
  FilmDescription::Crop crop{0, 0, film.width, film.height};
  crop.width = static_cast<int>(params.integer("crop_width", crop.width, 1, film.width));
  crop.height = static_cast<int>(params.integer("crop_height", crop.height, 1, film.height));
  crop.x = static_cast<int>(params.integer("crop_offset_x", 0, 0, film.width - crop.width));
  crop.y = static_cast<int>(params.integer("crop_offset_y", 0, 0, film.height - crop.height));
  return crop;
}

FilmDescription build_film(Params& params) {
  FilmDescription film;
  film.width = static_cast<int>(params.integer("width", film.width, 1, kMaxSide));
  film.height = static_cast<int>(params.integer("height", film.height, 1, kMaxSide));
  params.expect(
      std::int64_t{film.width} * film.height <= kMaxPixels, "width",
      "times height is " + std::to_string(std::int64_t{film.width} * film.height) + " pixels, expected at most 2^28");
  film.crop = read_crop(params, film);
  expect_one_of(params, "pixel_format", {"rgb", "rgba"});             // alpha is never written
  expect_one_of(params, "component_format", {"float32", "float16"});  // always written as float32
  expect_one_of(params, "file_format", {"openexr", "exr"});
  if (params.nested("rfilter").empty())
    film.filter = {Filter::Kind::gaussian};
  else
    film.filter =
        build_plugin(params.objects(), params.objects().target(params.only_nested("rfilter")), filter_table());
  return film;
}

const std::vector<Plugin<FilmDescription>>& film_table() {
  static const std::vector<Plugin<FilmDescription>> rows = {{"hdrfilm",
                                                             {{"width", ParamType::integer},
                                                              {"height", ParamType::integer},
                                                              {"crop_offset_x", ParamType::integer},
                                                              {"crop_offset_y", ParamType::integer},
                                                              {"crop_width", ParamType::integer},
                                                              {"crop_height", ParamType::integer},
                                                              {"pixel_format", ParamType::string},
                                                              {"component_format", ParamType::string},
                                                              {"file_format", ParamType::string}},
                                                             {{"rfilter"}},
                                                             build_film}};
  return rows;
}

}  // namespace

FilmDescription read_film(SceneObjects& objects, const Element& element) {
  return build_plugin(objects, element, film_table());
}

}  // namespace photonproof::scene_xml
