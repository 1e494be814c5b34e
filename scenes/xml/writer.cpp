// The inverse of the parser.
#include "scenes/xml/writer.h"

#include "scenes/xml/material_writer.h"
#include "scenes/xml/xml_writer.h"

namespace photonproof {
namespace {

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
  explicit Writer(const SceneDescription& scene) : scene_(scene), materials_(scene, xml_) {}

  std::string run() {
    xml_.open("scene", {{"version", "3.0.0"}});
    std::visit([&](const auto& method) { write(method); }, scene_.integrator.method);
    write(scene_.sensor);
    materials_.write_named();
    for (const ShapeGroupDescription& group : scene_.groups) {
      xml_.open_plugin("shape", "shapegroup", group.id);
      for (const ShapeDescription& shape : group.shapes) write(shape);
      xml_.close();
    }
    for (const ShapeDescription& shape : scene_.shapes) write(shape);
    for (const EmitterDescription& emitter : scene_.emitters) {
      std::visit([&](const auto& light) { write(light, emitter.id); }, emitter.light);
      xml_.close();
    }
    xml_.close();
    return xml_.take();
  }

 private:
  void open_limits(const char* type, const PathLimits& limits) {
    xml_.open_plugin("integrator", type, "");
    xml_.integer("max_depth", limits.max_depth);
    xml_.integer("rr_depth", limits.rr_depth);
    xml_.boolean("hide_emitters", limits.hide_emitters);
  }
  void write_limits(const char* type, const PathLimits& limits) {
    open_limits(type, limits);
    xml_.close();
  }
  void write(const PathDescription& method) { write_limits("path", method); }
  void write(const VolPathDescription& method) { write_limits("volpath", method); }
  void write(const BdptDescription& method) { write_limits("bdpt", method); }
  void write(const ParticleTracerDescription& method) { write_limits("ptracer", method); }
  void write(const WhittedDescription& method) { write_limits("whitted", method); }
  void write(const DirectDescription& method) {
    xml_.open_plugin("integrator", "direct", "");
    xml_.integer("emitter_samples", method.emitter_samples);
    xml_.integer("bsdf_samples", method.bsdf_samples);
    xml_.boolean("hide_emitters", method.hide_emitters);
    xml_.close();
  }
  void write(const PhotonMapperDescription& method) {
    open_limits("photonmapper", method);
    xml_.integer("global_photons", method.global_photons);
    xml_.integer("caustic_photons", method.caustic_photons);
    xml_.number("global_radius", method.global_radius);
    xml_.number("caustic_radius", method.caustic_radius);
    xml_.close();
  }

  void write(const SensorDescription& sensor) {
    std::visit([&](const auto& camera) { write(camera, sensor.id); }, sensor.camera);
    xml_.transform("to_world", sensor.to_world);
    write(sensor.film);
    xml_.open_plugin("sampler", "independent", "");
    xml_.integer("sample_count", sensor.sample_count);
    xml_.close();
    if (sensor.medium) materials_.use("medium", *sensor.medium);
    xml_.close();
  }
  void write_lens(const char* type, const PerspectiveDescription& camera, const std::string& id) {
    xml_.open_plugin("sensor", type, id);
    xml_.number("fov", camera.fov_degrees);
    xml_.string("fov_axis", name_of(camera.fov_axis));
    xml_.number("principal_point_offset_x", camera.principal_x);
    xml_.number("principal_point_offset_y", camera.principal_y);
    write_clips(camera);
  }
  template <class Camera>
  void write_clips(const Camera& camera) {
    xml_.number("near_clip", camera.near_clip);
    xml_.number("far_clip", camera.far_clip);
  }
  void write(const PerspectiveDescription& camera, const std::string& id) { write_lens("perspective", camera, id); }
  void write(const ThinLensDescription& camera, const std::string& id) {
    write_lens("thinlens", camera.perspective, id);
    xml_.number("aperture_radius", camera.aperture_radius);
    xml_.number("focus_distance", camera.focus_distance);
  }
  void write(const OrthographicDescription& camera, const std::string& id) {
    xml_.open_plugin("sensor", "orthographic", id);
    write_clips(camera);
  }
  void write(const FisheyeDescription& camera, const std::string& id) {
    xml_.open_plugin("sensor", "fisheye", id);
    xml_.number("fov", camera.fov_degrees);
    write_clips(camera);
  }

  void write(const FilmDescription& film) {
    xml_.open_plugin("film", "hdrfilm", "");
    xml_.integer("width", film.width);
    xml_.integer("height", film.height);
    if (film.crop) {
      xml_.integer("crop_offset_x", film.crop->x);
      xml_.integer("crop_offset_y", film.crop->y);
      xml_.integer("crop_width", film.crop->width);
      xml_.integer("crop_height", film.crop->height);
    }
    xml_.string("component_format", "float32");
    write(film.filter);
    xml_.close();
  }
  void write(const ReconstructionFilter& filter) {
    switch (filter.kind) {
      case ReconstructionFilter::Kind::box:
        xml_.leaf("rfilter", {{"type", "box"}});
        return;
      case ReconstructionFilter::Kind::tent:
        xml_.open_plugin("rfilter", "tent", "");
        xml_.number("radius", filter.radius);
        break;
      case ReconstructionFilter::Kind::gaussian:
        xml_.open_plugin("rfilter", "gaussian", "");
        xml_.number("stddev", filter.stddev);
    }
    xml_.close();
  }

  void write(const ShapeDescription& shape) {
    std::visit([&](const auto& geometry) { write(geometry, shape.id); }, shape.geometry);
    xml_.transform("to_world", shape.to_world);
    if (!std::holds_alternative<InstanceDescription>(shape.geometry)) {
      xml_.boolean("flip_normals", shape.flip_normals);
      materials_.use(shape.bsdf);
    }
    if (shape.interior) materials_.use("interior", *shape.interior);
    if (shape.exterior) materials_.use("exterior", *shape.exterior);
    if (shape.radiance) {
      xml_.open_plugin("emitter", "area", "");
      materials_.use("radiance", *shape.radiance);
      xml_.close();
    }
    xml_.close();
  }
  void write(const SphereDescription& sphere, const std::string& id) {
    xml_.open_plugin("shape", "sphere", id);
    xml_.point("center", sphere.center);
    xml_.number("radius", sphere.radius);
  }
  void write(const RectangleDescription&, const std::string& id) { xml_.open_plugin("shape", "rectangle", id); }
  void write(const DiskDescription&, const std::string& id) { xml_.open_plugin("shape", "disk", id); }
  void write(const CubeDescription&, const std::string& id) { xml_.open_plugin("shape", "cube", id); }
  void write(const PlaneDescription&, const std::string& id) { xml_.open_plugin("shape", "plane", id); }
  void write(const CylinderDescription& cylinder, const std::string& id) {
    xml_.open_plugin("shape", "cylinder", id);
    xml_.point("p0", cylinder.p0);
    xml_.point("p1", cylinder.p1);
    xml_.number("radius", cylinder.radius);
  }
  void write(const MeshDescription& mesh, const std::string& id) {
    xml_.open_plugin("shape", mesh.format == MeshDescription::Format::ply ? "ply" : "obj", id);
    xml_.string("filename", mesh.filename);
    xml_.boolean("face_normals", mesh.face_normals);
    xml_.boolean("flip_tex_coords", mesh.flip_tex_coords);
  }
  void write(const HeightfieldDescription& field, const std::string& id) {
    xml_.open_plugin("shape", "heightfield", id);
    xml_.integer("columns", field.columns);
    xml_.integer("rows", field.rows);
    xml_.number("amplitude", field.amplitude);
    xml_.boolean("face_normals", field.face_normals);
    if (const auto* texture = std::get_if<TextureIndex>(&field.height)) {
      materials_.use("height", *texture);
      return;
    }
    const auto& noise = std::get<HeightfieldDescription::Noise>(field.height);
    xml_.number("frequency_x", noise.frequency_x);
    xml_.number("frequency_y", noise.frequency_y);
    xml_.integer("octaves", noise.octaves);
    xml_.integer("seed", noise.seed);
  }
  void write(const InstanceDescription& instance, const std::string& id) {
    xml_.open_plugin("shape", "instance", id);
    xml_.leaf("ref", {{"id", scene_.groups.at(instance.group.value).id}});
  }

  void write(const PointLightDescription& light, const std::string& id) {
    xml_.open_plugin("emitter", "point", id);
    xml_.point("position", light.position);
    xml_.rgb("intensity", light.intensity);
  }
  void write(const SpotLightDescription& light, const std::string& id) {
    xml_.open_plugin("emitter", "spot", id);
    xml_.transform("to_world", light.to_world);
    xml_.rgb("intensity", light.intensity);
    xml_.number("cutoff_angle", light.cutoff_degrees);
    xml_.number("beam_width", light.beam_degrees);
    if (light.texture) materials_.use("texture", *light.texture);
  }
  void write(const DirectionalLightDescription& light, const std::string& id) {
    xml_.open_plugin("emitter", "directional", id);
    xml_.point("direction", light.direction);
    xml_.rgb("irradiance", light.irradiance);
  }
  void write(const ConstantLightDescription& light, const std::string& id) {
    xml_.open_plugin("emitter", "constant", id);
    xml_.rgb("radiance", light.radiance);
  }
  void write(const EnvmapDescription& light, const std::string& id) {
    xml_.open_plugin("emitter", "envmap", id);
    xml_.string("filename", light.filename);
    xml_.number("scale", light.scale);
    xml_.transform("to_world", light.to_world);
  }
  void write(const SunSkyDescription& light, const std::string& id) {
    xml_.open_plugin("emitter", "sunsky", id);
    xml_.number("turbidity", light.turbidity);
    xml_.rgb("albedo", light.albedo);
    xml_.number("sun_scale", light.sun_scale);
    xml_.number("sky_scale", light.sky_scale);
    xml_.number("sun_aperture", light.sun_aperture_degrees);
    xml_.point("sun_direction", light.to_world.vector(light.sun_direction) / light.to_world.similarity_scale());
    xml_.transform("to_world", light.to_world);
  }
  void write(const IesLightDescription& light, const std::string& id) {
    xml_.open_plugin("emitter", "ies", id);
    xml_.string("filename", light.filename);
    xml_.rgb("intensity", light.intensity);
    xml_.transform("to_world", light.to_world);
  }

  const SceneDescription& scene_;
  XmlWriter xml_;
  MaterialWriter materials_;
};

}  // namespace

std::string write_scene(const SceneDescription& scene) { return Writer(scene).run(); }

}  // namespace photonproof
