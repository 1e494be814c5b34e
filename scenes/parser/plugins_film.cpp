// Mitsuba 3's hdrfilm with its filters.
#include "scenes/description/description.h"
#include "scenes/parser/plugin_reader.h"

namespace photonproof::scene_xml {
namespace {

constexpr std::int64_t kMaxPixels = std::int64_t{1} << 28;

using Filter = ReconstructionFilter;

struct CompleteFilm {
  Params& params;

  void operator()(Filter&) const {}
  void operator()(FilmDescription& d) const {
    static const std::vector<Plugin<Filter>> filters = {
        described_plugin<Filter, CompleteFilm>(Filter{Filter::Kind::box}),
        described_plugin<Filter, CompleteFilm>(Filter{Filter::Kind::catmullrom}),
        described_plugin<Filter, CompleteFilm>(Filter{Filter::Kind::gaussian}),
        described_plugin<Filter, CompleteFilm>(Filter{Filter::Kind::lanczos}),
        described_plugin<Filter, CompleteFilm>(Filter{Filter::Kind::mitchell}),
        described_plugin<Filter, CompleteFilm>(Filter{Filter::Kind::sinc}),
        described_plugin<Filter, CompleteFilm>(Filter{Filter::Kind::tent})};
    const std::int64_t pixels = std::int64_t{d.width} * d.height;
    params.expect(pixels <= kMaxPixels, "width",
                  "times height is " + std::to_string(pixels) + " pixels, expected at most 2^28");
    d.filter = {Filter::Kind::gaussian};
    if (!params.nested("rfilter").empty())
      d.filter = build_plugin(params.objects(), params.objects().target(params.only_nested("rfilter")), filters);
  }
};

}  // namespace

FilmDescription read_film(SceneObjects& objects, const Element& element) {
  static const std::vector<Plugin<FilmDescription>> table = {
      described_plugin<FilmDescription, CompleteFilm>(FilmDescription())};
  return build_plugin(objects, element, table);
}

}  // namespace photonproof::scene_xml
