#include "scenes/pbrt/views.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "scenes/base/text_numbers.h"

namespace photonproof::inline scenes_pbrt {
namespace {

const Transform kMirror = Transform::scale({-1, 1, 1});

void read_film(PbrtContext& context, const PbrtEntity& film) {
  const PbrtParameters& p = film.parameters;
  FilmDescription& d = context.scene.sensor.film;
  if (film.type != "rgb")
    context.log.note(p.at(), "film " + in_quotes(film.type) + " is rendered as 'rgb': colours alone");
  p.ignore({"filename", "savefp16", "diagonal", "maxcomponentvalue", "coordinatesystem", "nbuckets", "lambdamin",
            "lambdamax"});
  d.width = p.integer("xresolution", 1280, 1, 65536);
  d.height = p.integer("yresolution", 720, 1, 65536);
  const std::string sensor = p.text("sensor", "cie1931");
  if (sensor != "cie1931")
    context.log.note(p.at(),
                     "the sensor " + in_quotes(sensor) + " is rendered as 'cie1931': its colours are linear sRGB");
  if (p.number("whitebalance", 0) != 0) context.log.note(p.at(), "the film's white balance is left out");
  context.exposure *= p.number("iso", 100, 1e-6, 1e9) / 100;
  const std::vector<double> window = p.numbers("cropwindow", {"float"}), box = p.numbers("pixelbounds", {"integer"});
  const auto pixels = [](double share, int size) { return static_cast<int>(std::ceil(share * size)); };
  if (window.size() == 4 && window[0] < window[1] && window[2] < window[3]) {
    const int x = pixels(std::clamp(window[0], 0.0, 1.0), d.width),
              y = pixels(std::clamp(window[2], 0.0, 1.0), d.height);
    d.crop = {x, y, pixels(std::clamp(window[1], 0.0, 1.0), d.width) - x,
              pixels(std::clamp(window[3], 0.0, 1.0), d.height) - y};
  } else if (box.size() == 4) {
    const auto within = [](double v, int size) { return static_cast<int>(std::clamp(v, 0.0, double{1} * size)); };
    const int x = within(box[0], d.width), y = within(box[2], d.height);
    d.crop = {x, y, within(box[1], d.width) - x, within(box[3], d.height) - y};
  } else if (!window.empty() || !box.empty()) {
    p.fail("expected four ascending numbers of a crop");
  }
  if (d.crop && (d.crop->width < 1 || d.crop->height < 1)) {
    d.crop = {};
    p.fail("has a crop without pixels");
  }
  p.finish();
}

/// The radius of a filter with negative lobes: that along x.
double radius_of_both_axes(PbrtContext& context, const PbrtParameters& p, double fallback) {
  const double x = p.number("xradius", fallback, 0.5, 16), y = p.number("yradius", fallback, 0.5, 16);
  if (x != y) context.log.note(p.at(), "the filter's yradius is rendered as its xradius");
  return x;
}

void read_filter(PbrtContext& context, const PbrtEntity* filter) {
  ReconstructionFilter& d = context.scene.sensor.film.filter;
  d = {ReconstructionFilter::Kind::gaussian};
  if (filter == nullptr) return;
  const PbrtParameters& p = filter->parameters;
  const bool has_radius = p.has("xradius");
  if (filter->type == "gaussian") {
    p.ignore({"xradius"});
    d.stddev = p.number("sigma", 0.5, 1e-3, 4);
  } else if (filter->type == "box") {
    const double radius = p.number("xradius", 0.5, 1e-3, 16);
    d.kind = radius <= 0.5 ? ReconstructionFilter::Kind::box : ReconstructionFilter::Kind::tent;
    d.radius = radius;
    if (has_radius && radius != 0.5)
      context.log.note(p.at(), "filter 'box' of another radius than 0.5 is rendered as another");
  } else if (filter->type == "triangle") {
    d.kind = ReconstructionFilter::Kind::tent;
    d.radius = p.number("xradius", 2, 1e-3, 16);
  } else if (filter->type == "mitchell") {
    d.kind = ReconstructionFilter::Kind::mitchell;
    d.b = p.number("B", 1.0 / 3, 0, 1);
    d.c = p.number("C", 1.0 / 3, 0, 1);
    const double radius = radius_of_both_axes(context, p, 2);
    if (radius != 2) d.mitchell_radius = radius;
  } else if (filter->type == "sinc") {
    d.kind = ReconstructionFilter::Kind::sinc;
    d.sinc_radius = radius_of_both_axes(context, p, 4);
    d.tau = p.number("tau", 3, 1, 1000);
  } else {
    p.fail("is not supported, expected box, gaussian, mitchell, sinc or triangle");
  }
  p.ignore({"yradius", "B", "C", "tau"});
  p.finish();
}

void read_sampler(PbrtContext& context, const PbrtEntity* sampler) {
  int& count = context.scene.sensor.sample_count;
  count = 16;
  if (sampler == nullptr) return;
  const PbrtParameters& p = sampler->parameters;
  p.ignore({"seed", "randomization", "jitter"});
  if (sampler->type == "stratified")
    count = p.integer("xsamples", 4, 1, 30000) * p.integer("ysamples", 4, 1, 30000);
  else
    count = p.integer("pixelsamples", 16, 1, 1 << 30);
  p.finish();
}

/// The part of the plane z = 1 that an unscaled camera sees: x from [0] to [1], y from [2] to [3].
std::array<double, 4> screen_of(const PbrtContext& context, const PbrtParameters& p) {
  const FilmDescription& film = context.scene.sensor.film;
  const double aspect = p.number("frameaspectratio", double{1} * film.width / film.height, 1e-3, 1e3);
  std::array<double, 4> screen = {-1, 1, -1, 1};
  if (aspect > 1)
    screen[0] = -aspect, screen[1] = aspect;
  else
    screen[2] = -1 / aspect, screen[3] = 1 / aspect;
  if (const PbrtParameter* window = p.find("screenwindow", {"float"})) {
    const std::vector<double>& n = window->numbers;
    if (n.size() != 4 || !(n[0] < n[1]) || !(n[2] < n[3])) p.fail(*window, "expected xmin, xmax, ymin and ymax");
    std::copy(n.begin(), n.end(), screen.begin());
  }
  const double shape = (screen[1] - screen[0]) / (screen[3] - screen[2]);
  if (std::abs(shape * film.height / film.width - 1) > 1e-3)
    context.log.note(p.at(), "the camera's screen window has another shape than the film: pixels stay square");
  return screen;
}

void read_perspective(PbrtContext& context, const PbrtParameters& p, double scale) {
  const double fov = p.number("fov", 90, 1e-3, 179.9), tangent = std::tan(fov * std::numbers::pi / 360);
  const std::array<double, 4> screen = screen_of(context, p);
  const double width = screen[1] - screen[0], height = screen[3] - screen[2];
  PerspectiveDescription lens;
  lens.fov_axis = FovAxis::x;
  lens.fov_degrees = 2 * std::atan(tangent * width / 2) * 180 / std::numbers::pi;
  // Ours are shares of the film that are added to a pixel's place, rightwards and downwards.
  lens.principal_x = (screen[0] + screen[1]) / 2 / width;
  lens.principal_y = (0 - screen[2] - screen[3]) / 2 / height;
  lens.near_clip = 1e-4;
  lens.far_clip = 1e7;
  const double radius = p.number("lensradius", 0, 0, 1e30) * scale, focus = p.number("focaldistance", 1e6, 1e-30, 1e30);
  if (radius > 0)
    context.scene.sensor.camera = ThinLensDescription{lens, radius, focus * scale};
  else
    context.scene.sensor.camera = lens;
}

void read_orthographic(PbrtContext& context, const PbrtParameters& p, double scale) {
  const std::array<double, 4> screen = screen_of(context, p);
  OrthographicDescription lens;
  lens.near_clip = 1e-4;
  lens.far_clip = 1e7;
  context.scene.sensor.camera = lens;
  if (p.number("lensradius", 0, 0, 1e30) > 0)
    context.log.note(p.at(), "the lens of an orthographic camera is left out: everything is sharp");
  p.ignore({"focaldistance"});
  const double half = (screen[1] - screen[0]) / 2 * scale;
  // Our camera's +x is left in the image.
  context.scene.sensor.to_world =
      context.scene.sensor.to_world *
      Transform::translate({-(screen[0] + screen[1]) / 2 * scale, (screen[2] + screen[3]) / 2 * scale, 0}) *
      Transform::scale({half, half, 1});
}

void read_camera(PbrtContext& context, const PbrtEntity* camera) {
  const Transform ctm = camera == nullptr ? Transform() : camera->ctm;
  const std::optional<Transform> from_camera = ctm.inverse();
  const bool is_mirrored = ctm.determinant() < 0;
  // pbrt's camera has +x on the right of the image, ours on its left.
  context.to_ours = is_mirrored ? Transform() : kMirror;
  SensorDescription& sensor = context.scene.sensor;
  sensor.camera =
      PerspectiveDescription{.fov_degrees = 90, .fov_axis = FovAxis::smaller, .near_clip = 1e-4, .far_clip = 1e7};
  if (camera == nullptr) return;
  const PbrtParameters& p = camera->parameters;
  if (!from_camera || !is_similarity(*from_camera)) p.fail("is scaled unevenly, sheared or flattened by its transform");
  const double scale = std::cbrt(std::abs(from_camera->determinant()));
  sensor.to_world = context.to_ours * *from_camera * kMirror * Transform::scale(Vec3d(1 / scale));
  const double open = p.number("shutteropen", 0), shut = p.number("shutterclose", 1);
  if (shut != open) context.exposure *= std::abs(shut - open);
  if (camera->type == "perspective")
    read_perspective(context, p, scale);
  else if (camera->type == "orthographic")
    read_orthographic(context, p, scale);
  else
    p.fail("is not supported, expected perspective or orthographic");
  p.finish();
}

template <class Limits>
Limits limited(int depth) {
  Limits limits;
  limits.max_depth = depth;
  return limits;
}

}  // namespace

void add_pbrt_views(PbrtContext& context, const PbrtViews& views) {
  FilmDescription& film = context.scene.sensor.film;
  film.width = 1280;
  film.height = 720;
  const auto given = [](const std::optional<PbrtEntity>& e) { return e ? &*e : nullptr; };
  if (views.film) context.log.attempt([&] { read_film(context, *views.film); });
  context.log.attempt([&] { read_filter(context, given(views.filter)); });
  context.log.attempt([&] { read_sampler(context, given(views.sampler)); });
  context.log.attempt([&] { read_camera(context, given(views.camera)); });
}

void choose_pbrt_integrator(PbrtContext& context, const PbrtViews& views) {
  auto& method = context.scene.integrator.method;
  const bool in_media = !context.scene.media.empty();
  const auto paths = [&](int depth) {
    if (in_media)
      method = limited<VolPathDescription>(depth);
    else
      method = limited<PathDescription>(depth);
  };
  // pbrt counts surfaces and points that scatter, ours the edges of a path.
  if (!views.integrator) return paths(6);
  const PbrtParameters& p = views.integrator->parameters;
  const std::string& type = views.integrator->type;
  const int depth = p.integer("maxdepth", 5, 0, 999'999) + 1;
  p.ignore({"lightsampler", "regularize", "samplelights", "samplebsdf", "iterations", "visualizestrategies",
            "visualizeweights", "bootstrapsamples", "chains", "mutationsperpixel", "largestepprobability", "sigma",
            "maxdistance", "cossample", "seed", "rrthreshold"});
  if (p.boolean("regularize", false))
    context.log.note(p.at(), "integrator " + in_quotes(type) + " does not blur glossy materials by 'regularize'");
  if (type == "bdpt") {
    method = limited<BdptDescription>(depth);
  } else if (type == "lightpath") {
    method = limited<ParticleTracerDescription>(depth);
  } else if (type == "sppm") {
    SppmDescription sppm = limited<SppmDescription>(depth);
    sppm.photons = std::max(1, p.integer("photonsperiteration", static_cast<int>(sppm.photons), -1, 1'000'000'000));
    sppm.radius = p.number("radius", 1, 0, 1e30);
    method = sppm;
  } else {
    if (type != "path" && type != "volpath" && type != "simplepath" && type != "simplevolpath" && type != "randomwalk")
      context.log.note(p.at(),
                       "integrator " + in_quotes(type) + " is rendered as " + (in_media ? "'volpath'" : "'path'"));
    paths(depth);
  }
  p.finish();
}

}  // namespace photonproof::inline scenes_pbrt
