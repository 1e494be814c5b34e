// The inverse of the parser. Numbers are the shortest text that reads back as the same double.
#include "scenes/writer.h"

#include <utility>

#include "scenes/text_numbers.h"

namespace photonproof {
namespace {

using Attributes = std::vector<std::pair<std::string, std::string>>;

/// For a double-quoted attribute: XML's own characters, white space (which a reader would turn into blanks), and the
/// dollar sign, which would start a `$name`.
std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\t':
      case '\n':
      case '\r':
        out += "&#" + std::to_string(int{c}) + ";";
        break;
      case '$':
        out += "\\$";
        break;
      default:
        out += c;
    }
  }
  return out;
}

std::string list(std::initializer_list<double> values) {
  std::string text;
  for (const double v : values) text += (text.empty() ? "" : ", ") + format_number(v);
  return text;
}

const char* name_of(FovAxis axis) {
  switch (axis) {
    case FovAxis::x:
      return "x";
    case FovAxis::y:
      return "y";
    case FovAxis::diagonal:
      return "diagonal";
    case FovAxis::smaller:
      return "smaller";
    case FovAxis::larger:
      break;
  }
  return "larger";
}

class Writer {
 public:
  explicit Writer(const SceneDescription& scene) : scene_(scene) {}

  std::string run() {
    open("scene", {{"version", "3.0.0"}});
    std::visit([&](const auto& method) { write(method); }, scene_.integrator.method);
    write(scene_.sensor);
    for (const BsdfDescription& bsdf : scene_.bsdfs)
      if (!bsdf.id.empty()) write(bsdf);
    for (const ShapeDescription& shape : scene_.shapes) write(shape);
    for (const EmitterDescription& emitter : scene_.emitters)
      std::visit([&](const auto& light) { write(light, emitter.id); }, emitter.light);
    close("scene");
    return std::move(out_);
  }

 private:
  void tag(const std::string& name, const Attributes& attributes, const char* end) {
    out_.append(2 * open_, ' ');
    out_ += "<" + name;
    for (const auto& [key, value] : attributes) out_ += " " + key + "=\"" + escaped(value) + "\"";
    out_ += std::string(end) + "\n";
  }
  void open(const std::string& name, const Attributes& attributes) {
    tag(name, attributes, ">");
    ++open_;
  }
  void close(const std::string& name) {
    --open_;
    out_.append(2 * open_, ' ');
    out_ += "</" + name + ">\n";
  }
  void open_plugin(const std::string& kind, const std::string& type, const std::string& id) {
    open(kind, id.empty() ? Attributes{{"type", type}} : Attributes{{"type", type}, {"id", id}});
  }
  void value(const std::string& kind, const std::string& name, const std::string& text) {
    tag(kind, {{"name", name}, {"value", text}}, "/>");
  }
  void number(const std::string& name, double v) { value("float", name, format_number(v)); }
  void integer(const std::string& name, std::int64_t v) { value("integer", name, std::to_string(v)); }
  void boolean(const std::string& name, bool v) { value("boolean", name, v ? "true" : "false"); }
  void colour(const std::string& name, const Colour& c) { colour(name, constant(c)); }
  void colour(const std::string& name, const RgbD& c) { value("rgb", name, list({c.x, c.y, c.z})); }
  void point(const std::string& name, const Vec3d& p) { value("point", name, list({p.x, p.y, p.z})); }
  void transform(const std::string& name, const Transform& t) {
    if (t == Transform()) return;
    std::string entries;
    for (const double entry : t.m) entries += (entries.empty() ? "" : " ") + format_number(entry);
    open("transform", {{"name", name}});
    tag("matrix", {{"value", entries}}, "/>");
    close("transform");
  }

  template <class Description>
  void common(const Description& method) {
    integer("max_depth", method.max_depth);
    integer("rr_depth", method.rr_depth);
    boolean("hide_emitters", method.hide_emitters);
  }
  template <class Other, class... Id>
  void write(const Other&, const Id&...) {
    throw InputError("scene", "cannot be written yet");
  }
  void write(const PathDescription& method) {
    open_plugin("integrator", "path", "");
    common(method);
    close("integrator");
  }
  void write(const PhotonMapperDescription& method) {
    open_plugin("integrator", "photonmapper", "");
    common(method);
    integer("global_photons", method.global_photons);
    integer("caustic_photons", method.caustic_photons);
    number("global_radius", method.global_radius);
    number("caustic_radius", method.caustic_radius);
    close("integrator");
  }

  void write(const SensorDescription& sensor) {
    std::visit([&](const auto& camera) { write(camera, sensor.id); }, sensor.camera);
    transform("to_world", sensor.to_world);
    open_plugin("film", "hdrfilm", "");
    integer("width", sensor.film.width);
    integer("height", sensor.film.height);
    value("string", "component_format", "float32");
    tag("rfilter", {{"type", "box"}}, "/>");
    close("film");
    open_plugin("sampler", "independent", "");
    integer("sample_count", sensor.sample_count);
    close("sampler");
    close("sensor");
  }
  void write(const PerspectiveDescription& camera, const std::string& id) {
    open_plugin("sensor", "perspective", id);
    number("fov", camera.fov_degrees);
    value("string", "fov_axis", name_of(camera.fov_axis));
    number("near_clip", camera.near_clip);
    number("far_clip", camera.far_clip);
  }

  void write(const BsdfDescription& bsdf) {
    std::visit([&](const auto& model) { write(model, bsdf.id); }, bsdf.model);
    close("bsdf");
  }
  void write(const DiffuseDescription& diffuse, const std::string& id) {
    open_plugin("bsdf", "diffuse", id);
    colour("reflectance", diffuse.reflectance);
  }
  void write(const ConductorDescription& conductor, const std::string& id) {
    open_plugin("bsdf", "conductor", id);
    if (conductor.ior) {
      colour("eta", conductor.ior->eta);
      colour("k", conductor.ior->k);
    } else {
      value("string", "material", "none");
    }
    colour("specular_reflectance", conductor.specular_reflectance);
  }
  void write(const DielectricDescription& dielectric, const std::string& id) {
    open_plugin("bsdf", "dielectric", id);
    number("int_ior", dielectric.int_ior);
    number("ext_ior", dielectric.ext_ior);
    colour("specular_reflectance", dielectric.specular_reflectance);
    colour("specular_transmittance", dielectric.specular_transmittance);
  }

  void write(const ShapeDescription& shape) {
    std::visit([&](const auto& geometry) { write(geometry, shape.id); }, shape.geometry);
    transform("to_world", shape.to_world);
    boolean("flip_normals", shape.flip_normals);
    const BsdfDescription& bsdf = scene_.bsdfs.at(shape.bsdf.value);
    if (bsdf.id.empty())
      write(bsdf);
    else
      tag("ref", {{"id", bsdf.id}}, "/>");
    if (shape.radiance) {
      open_plugin("emitter", "area", "");
      colour("radiance", *shape.radiance);
      close("emitter");
    }
    close("shape");
  }
  void write(const SphereDescription& sphere, const std::string& id) {
    open_plugin("shape", "sphere", id);
    point("center", sphere.center);
    number("radius", sphere.radius);
  }
  void write(const RectangleDescription&, const std::string& id) { open_plugin("shape", "rectangle", id); }
  void write(const CubeDescription&, const std::string& id) { open_plugin("shape", "cube", id); }
  void write(const MeshDescription& ply, const std::string& id) {
    open_plugin("shape", "ply", id);
    value("string", "filename", ply.filename);
    boolean("face_normals", ply.face_normals);
  }

  void write(const PointLightDescription& light, const std::string& id) {
    open_plugin("emitter", "point", id);
    point("position", light.position);
    colour("intensity", light.intensity);
    close("emitter");
  }

  const SceneDescription& scene_;
  std::string out_;
  std::size_t open_ = 0;
};

}  // namespace

std::string write_scene(const SceneDescription& scene) { return Writer(scene).run(); }

}  // namespace photonproof
