// Mitsuba 3's bitmap and checkerboard; defaults are its.
#include "scenes/parser/plugins.h"
#include "scenes/text/faults.h"

namespace photonproof::scene_xml {
namespace {

using Pattern = decltype(TextureDescription::pattern);

TextureFilter filter_of(Params& params) {
  const std::string filter = params.string("filter_type", "bilinear");
  if (filter == "bilinear") return TextureFilter::bilinear;
  if (filter == "nearest") return TextureFilter::nearest;
  params.fail("filter_type", "is " + in_quotes(filter) + ", expected bilinear or nearest");
}

TextureWrap wrap_of(Params& params) {
  const std::string wrap = params.string("wrap_mode", "repeat");
  if (wrap == "repeat") return TextureWrap::repeat;
  if (wrap == "mirror") return TextureWrap::mirror;
  if (wrap == "clamp") return TextureWrap::clamp;
  params.fail("wrap_mode", "is " + in_quotes(wrap) + ", expected repeat, mirror or clamp");
}

Pattern build_bitmap(Params& params) {
  BitmapDescription bitmap;
  params.expect(params.has("filename"), "filename", "is missing, expected the name of an image");
  params.string("filename", "");
  bitmap.raw = params.boolean("raw", false);
  bitmap.filter = filter_of(params);
  bitmap.wrap = wrap_of(params);
  bitmap.to_uv = params.transform("to_uv");
  const auto loaded =
      params.objects().files().image(params.value_of("filename"), bitmap.raw || has_fault(Fault::raw_srgb));
  bitmap.filename = loaded.name;
  bitmap.image = loaded.content;
  return bitmap;
}

Pattern build_checkerboard(Params& params) {
  CheckerboardDescription board;
  board.color0 = params.colour_map("color0", constant(board.color0), 0, kUnbounded);
  board.color1 = params.colour_map("color1", constant(board.color1), 0, kUnbounded);
  board.to_uv = params.transform("to_uv");
  return board;
}

const std::vector<Plugin<Pattern>>& table() {
  static const std::vector<Plugin<Pattern>> rows = {
      {"bitmap",
       {{"filename", ParamType::string},
        {"raw", ParamType::boolean},
        {"filter_type", ParamType::string},
        {"wrap_mode", ParamType::string},
        {"to_uv", ParamType::transform}},
       {},
       build_bitmap},
      {"checkerboard",
       {{"color0", ParamType::colour_map}, {"color1", ParamType::colour_map}, {"to_uv", ParamType::transform}},
       {},
       build_checkerboard},
  };
  return rows;
}

}  // namespace

TextureDescription read_texture(SceneObjects& objects, const Element& element) {
  return {objects.sources().loc(element.at), id_of(element), build_plugin(objects, element, table())};
}

}  // namespace photonproof::scene_xml
