#include "scenes/dialect/integrator_stand_ins.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "scenes/base/edit_distance.h"

namespace photonproof::scene_xml {
namespace {

using Names = std::vector<std::string>;

/// Names in use elsewhere that an edit turns into one of ours.
const Names kElsewhere = {"volpathmis", "vcm", "ppm", "vpl", "prbvolpath", "prbpath", "mcpath"};
const Names kOurs = {"bdpt", "direct",  "moment",           "path",   "photonmapper", "ptracer",
                     "sppm", "volpath", "volprim_rf_basic", "whitted"};

bool is_one_of(std::string_view name, const Names& names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::string nearest_of_ours(const std::string& type, bool scene_has_media) {
  const auto has = [&](std::string_view part) { return type.find(part) != std::string::npos; };
  if (type == "vcm" || type == "upbp") return "bdpt";
  if (type == "direct_projective") return "direct";
  if (has("ppm")) return "sppm";
  if (has("photon")) return "photonmapper";
  if (has("ptracer") || has("particle")) return "ptracer";
  return has("vol") || scene_has_media ? "volpath" : "path";
}

std::string loss_of(const std::string& type) {
  if (type == "depth" || type == "field" || type == "aov") return "the image shows light, not " + type;
  if (type == "stokes") return "without polarisation";
  return {};
}

void keep_parameters(Element& object, const Names& kept) {
  std::erase_if(object.children, [&](const Element& child) { return !is_one_of(value_of(child, "name"), kept); });
}

/// Parameters of Mitsuba 0.6's photon mappers. Their radii are relative to the scene; their photons are those stored.
constexpr std::array kPhotonMapping = {
    "auto_cancel_gathering", "caustic_lookup_radius", "direct_samples", "emitter_samples", "glossy_samples",
    "global_lookup_radius",  "granularity",           "gather_locally", "lookup_size",     "max_passes",
    "photon_map_type",       "volume_lookup_radius",  "volume_photons", "lookup_radius",   "dump_iteration"};

void drop_photon_parameters(Element& integrator, StandInNotes& notes) {
  std::string dropped;
  for (const char* name : kPhotonMapping)
    if (!take_parameter(integrator, name).tag.empty()) dropped += (dropped.empty() ? "" : ", ") + std::string(name);
  if (!dropped.empty())
    notes.add(integrator, "integrator " + in_quotes(value_of(integrator, "type")) +
                              " chooses radii and gather rays by itself, without " + dropped);
}

}  // namespace

void replace_integrator(Element& integrator, bool scene_has_media, StandInNotes& notes) {
  const std::string type = value_of(integrator, "type");
  if (type.empty()) return;
  if (!is_one_of(type, kOurs)) {
    const auto nested =
        std::ranges::find_if(integrator.children, [](const Element& c) { return c.tag == "integrator"; });
    if (nested != integrator.children.end()) {
      notes.add(integrator, "integrator " + in_quotes(type) + " is left out: only the one that it nests is rendered");
      Element inner = std::move(*nested);
      integrator = std::move(inner);
      return replace_integrator(integrator, scene_has_media, notes);
    }
    if (!is_one_of(type, kElsewhere) && !did_you_mean(type, kOurs).empty()) return;
    const std::string becomes = nearest_of_ours(type, scene_has_media);
    notes.add_stand_in(integrator, becomes, loss_of(type));
    set_attribute(integrator, "type", becomes);
    if (becomes != "sppm" && becomes != "photonmapper")
      keep_parameters(integrator,
                      becomes == "direct" ? Names{"hide_emitters"} : Names{"max_depth", "rr_depth", "hide_emitters"});
    // Mitsuba's differentiable integrators end their paths where nothing else is asked for.
    if (type.starts_with("prb") && !parameter_of(integrator, "max_depth"))
      add_parameter(integrator, "integer", "max_depth", "6");
  }
  const std::string ours = value_of(integrator, "type");
  if (ours == "sppm") {
    rename_parameter(integrator, "photon_count", "photons");
    rename_parameter(integrator, "initial_radius", "radius");
  }
  if (ours == "direct") rename_parameter(integrator, "luminaire_samples", "emitter_samples");
  if (ours == "sppm" || ours == "photonmapper") drop_photon_parameters(integrator, notes);
  if (const Element* strict = parameter_of(integrator, "strict_normals"); strict) {
    if (value_of(*strict, "value") == "true") notes.add(*strict, "strict_normals is left out");
    take_parameter(integrator, "strict_normals");
  }
}

}  // namespace photonproof::scene_xml
