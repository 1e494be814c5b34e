// Mitsuba 3's homogeneous medium with the phase functions isotropic and hg.
#include "scenes/description/description.h"
#include "scenes/parser/plugin_reader.h"

namespace photonproof::scene_xml {
namespace {

using Model = decltype(MediumDescription::model);
using Phase = decltype(HomogeneousDescription::phase);

struct CompleteMedium {
  Params& params;

  void operator()(HomogeneousDescription& d) const {
    static const std::vector<Plugin<Phase>> phases = described_plugins<Phase, CompleteMedium>();
    if (!params.nested("phase").empty())
      d.phase = build_plugin(params.objects(), params.objects().target(params.only_nested("phase")), phases);
  }
  void operator()(IsotropicDescription&) const {}
  void operator()(HenyeyGreensteinDescription&) const {}
};

}  // namespace

MediumDescription read_medium(SceneObjects& objects, const Element& element) {
  static const std::vector<Plugin<Model>> table = described_plugins<Model, CompleteMedium>();
  return {objects.sources().loc(element.at), id_of(element), build_plugin(objects, element, table)};
}

}  // namespace photonproof::scene_xml
