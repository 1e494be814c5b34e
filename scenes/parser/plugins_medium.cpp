// Mitsuba 3's media, their phase functions, and the volumes of their values. Mitsuba 0.6 gives a homogeneous medium's
// absorption and scattering in place of extinction and albedo.
#include "scenes/description/description.h"
#include "scenes/parser/plugin_reader.h"

namespace photonproof::scene_xml {
namespace {

using Model = decltype(MediumDescription::model);
using Volume = std::variant<GridVolumeDescription, ConstantVolumeDescription>;

/// Also completes nothing, where a phase function has nothing nested.
struct CompletePhase {
  Params& params;

  template <class Phase>
  void operator()(Phase&) const {}
  void operator()(BlendPhaseDescription& d) const {
    static const std::vector<Plugin<PhaseLobe>> lobes = described_plugins<PhaseLobe, CompletePhase>();
    const auto& given = params.nested("phase");
    if (given.size() != 2)
      params.sources().fail(params.object().at,
                            params.title() + " has " + std::to_string(given.size()) + " of <phase>, expected two");
    const auto read = [&](const Element* lobe) {
      return build_plugin(params.objects(), params.objects().target(*lobe), lobes);
    };
    d.first = read(given[0]);
    d.second = read(given[1]);
  }
};

/// sigma_t and albedo of Mitsuba 0.6's sigma_a and sigma_s, where those are given.
void read_absorption_and_scattering(Params& params, HomogeneousDescription& d) {
  if (!params.has("sigma_a") && !params.has("sigma_s")) return;
  for (const char* old : {"sigma_a", "sigma_s"}) {
    params.expect_given(old, "one beside " + std::string(old == std::string("sigma_a") ? "sigma_s" : "sigma_a"));
    for (const char* other : {"sigma_t", "albedo"}) expect_alone(params, other, old);
  }
  const RgbD absorption = params.colour("sigma_a", RgbD(0.0), 0, kUnbounded);
  const RgbD scattering = params.colour("sigma_s", RgbD(0.0), 0, kUnbounded);
  d.sigma_t = absorption + scattering;
  const auto share = [](double part, double whole) { return whole > 0 ? part / whole : 0; };
  d.albedo = RgbD(share(scattering.x, d.sigma_t.x), share(scattering.y, d.sigma_t.y), share(scattering.z, d.sigma_t.z));
}

struct CompleteMedium {
  Params& params;

  void operator()(HomogeneousDescription& d) const {
    read_absorption_and_scattering(params, d);
    read_phase(d.phase);
  }
  void operator()(HeterogeneousDescription& d) const { read_phase(d.phase); }

 private:
  void read_phase(PhaseDescription& phase) const {
    static const std::vector<Plugin<PhaseDescription>> phases = described_plugins<PhaseDescription, CompletePhase>();
    if (!params.nested("phase").empty())
      phase = build_plugin(params.objects(), params.objects().target(params.only_nested("phase")), phases);
  }
};

struct CompleteVolume {
  Params& params;

  void operator()(GridVolumeDescription& d) const {
    const auto loaded = params.objects().files().volume(params.value_of("filename"), VolValues::not_negative);
    d.filename = loaded.name;
    d.grid = loaded.content;
    expect_inverse(d.to_world);
  }
  void operator()(ConstantVolumeDescription& d) const { expect_inverse(d.to_world); }

 private:
  void expect_inverse(const Transform& to_world) const {
    params.expect(to_world.inverse().has_value(), "to_world", "is singular: it flattens the volume");
  }
};

}  // namespace

MediumDescription read_medium(SceneObjects& objects, const Element& element) {
  static const std::vector<Plugin<Model>> table = described_plugins<Model, CompleteMedium>();
  return {objects.sources().loc(element.at), id_of(element), build_plugin(objects, element, table)};
}

VolumeColour read_volume(SceneObjects& objects, const Element& element) {
  static const std::vector<Plugin<Volume>> table = described_plugins<Volume, CompleteVolume>();
  return std::visit([](const auto& volume) -> VolumeColour { return volume; }, build_plugin(objects, element, table));
}

}  // namespace photonproof::scene_xml
