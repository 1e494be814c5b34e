// Mitsuba 3's textures and 0.6's scale: rules that a description alone does not state.
#include "scenes/base/faults.h"
#include "scenes/description/description.h"
#include "scenes/parser/plugin_reader.h"

namespace photonproof::scene_xml {
namespace {

using Pattern = decltype(TextureDescription::pattern);

struct CompleteTexture {
  Params& params;

  void operator()(BitmapDescription& d) const {
    const auto loaded =
        params.objects().files().image(params.value_of("filename"), d.raw || has_fault(Fault::raw_srgb));
    d.filename = loaded.name;
    d.image = loaded.content;
  }
  void operator()(CheckerboardDescription&) const {}
  void operator()(MeshAttributeDescription& d) const {
    params.expect(d.name.starts_with("vertex_") || d.name.starts_with("face_"), "name",
                  "is " + in_quotes(d.name) + ", expected a name that begins with vertex_ or face_");
  }
  void operator()(ScaledTextureDescription&) const {}
  void operator()(VolumeTextureDescription&) const {}
};

}  // namespace

TextureDescription read_texture(SceneObjects& objects, const Element& element) {
  static const std::vector<Plugin<Pattern>> table = described_plugins<Pattern, CompleteTexture>();
  return {objects.sources().loc(element.at), id_of(element), build_plugin(objects, element, table)};
}

}  // namespace photonproof::scene_xml
