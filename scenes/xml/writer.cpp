// The inverse of the parser.
#include "scenes/xml/writer.h"

#include "scenes/description/description.h"
#include "scenes/xml/material_writer.h"
#include "scenes/xml/plugin_writer.h"
#include "scenes/xml/xml_writer.h"

namespace photonproof::inline scenes_xml {
namespace {

class Writer {
 public:
  explicit Writer(const SceneDescription& scene) : scene_(scene), materials_(scene, xml_) {}

  std::string run() {
    xml_.open("scene", {{"version", "3.0.0"}});
    IntegratorDescription integrator = scene_.integrator;
    std::visit([&](auto& method) { write("integrator", method); }, integrator.method);
    if (!std::holds_alternative<IrradianceMeterDescription>(scene_.sensor.camera)) write(scene_.sensor);
    materials_.write_named();
    for (const ShapeGroupDescription& group : scene_.groups) {
      xml_.open_plugin("shape", "shapegroup", group.id);
      for (const ShapeDescription& shape : group.shapes) write(shape);
      xml_.close();
    }
    for (const ShapeDescription& shape : scene_.shapes) write(shape);
    for (EmitterDescription emitter : scene_.emitters)
      std::visit([&](auto& light) { write("emitter", light, emitter.id); }, emitter.light);
    xml_.close();
    return xml_.take();
  }

 private:
  /// The element of a plugin, which is left open.
  template <class Description>
  void open(const char* tag, Description& description, const std::string& id) {
    PluginWriter writer(materials_, xml_, tag, id);
    describe(writer, description);
  }
  template <class Description>
  void write(const char* tag, Description& description, const std::string& id = "") {
    open(tag, description, id);
    xml_.close();
  }

  void write(const BatchDescription& batch) {
    for (BatchView view : batch.views) {
      std::visit([&](auto& camera) { open("sensor", camera, ""); }, view.camera);
      xml_.transform("to_world", view.to_world);
      xml_.close();
    }
  }

  void write(const DistantDescription& distant) {
    if (const auto* point = std::get_if<Vec3d>(&distant.target)) xml_.point("target", *point);
    const auto* area = std::get_if<TargetArea>(&distant.target);
    if (area == nullptr) return;
    xml_.open_plugin("shape", area->is_disk ? "disk" : "rectangle", "", "target");
    xml_.transform("to_world", area->to_world);
    xml_.close();
  }

  void write(SensorDescription sensor) {
    std::visit([&](auto& camera) { open("sensor", camera, sensor.id); }, sensor.camera);
    const auto* batch = std::get_if<BatchDescription>(&sensor.camera);
    if (batch != nullptr) write(*batch);
    if (const auto* distant = std::get_if<DistantDescription>(&sensor.camera)) write(*distant);
    if (batch == nullptr && !std::holds_alternative<IrradianceMeterDescription>(sensor.camera))
      xml_.transform("to_world", sensor.to_world);
    open("film", sensor.film, "");
    if (sensor.film.filter.kind == ReconstructionFilter::Kind::box)
      xml_.leaf("rfilter", {{"type", "box"}});
    else
      write("rfilter", sensor.film.filter);
    xml_.close();
    SamplerPlugin sampler{.sample_count = sensor.sample_count};
    write("sampler", sampler);
    if (sensor.medium) materials_.use("medium", *sensor.medium);
    xml_.close();
  }

  void write(ShapeDescription shape) {
    std::visit([&](auto& geometry) { open("shape", geometry, shape.id); }, shape.geometry);
    xml_.transform("to_world", shape.to_world);
    if (!std::holds_alternative<InstanceDescription>(shape.geometry)) {
      xml_.boolean("flip_normals", shape.flip_normals);
      materials_.use(shape.bsdf);
    }
    if (shape.interior) materials_.use("interior", *shape.interior);
    if (shape.exterior) materials_.use("exterior", *shape.exterior);
    if (shape.radiance && shape.emits_along_normal) {
      DirectionalAreaEmitter beam{constant(*shape.radiance)};
      write("emitter", beam);
    } else if (shape.radiance) {
      AreaEmitter area_light{*shape.radiance};
      write("emitter", area_light);
    }
    if (shape.measures) write(scene_.sensor);
    xml_.close();
  }

  const SceneDescription& scene_;
  XmlWriter xml_;
  MaterialWriter materials_;
};

}  // namespace

std::string write_scene(const SceneDescription& scene) { return Writer(scene).run(); }

}  // namespace photonproof::inline scenes_xml
