// Emitters for Mitsuba. Areas' light goes with their shapes.
#include <memory>
#include <string>
#include <variant>

#include "reference/engines/ies_image.h"
#include "reference/mitsuba/mitsuba_lowering.h"

namespace photonproof::inline reference_mitsuba {
namespace {

struct LoweredLight {
  MitsubaLowering& lowering;
  const EmitterDescription& emitter;

  void operator()(SpotLightDescription& d) const {
    // Only its place and direction count.
    d.to_world = d.to_world * Transform::scale(Vec3d(1 / d.to_world.similarity_scale()));
  }
  void operator()(EnvmapDescription& d) const {
    lowering.explain("envmap of " + lowering.scene().where(emitter.loc) + ": the image as a linear EXR");
    d.filename = lowering.file_of(d.image);
  }
  void operator()(IesLightDescription& d) const {
    lowering.need("ies");
    lowering.explain("ies of " + lowering.scene().where(emitter.loc) +
                     ": our plugin, which reads its distribution from an image");
    d.to_world = d.to_world * Transform::scale(Vec3d(1 / d.to_world.similarity_scale()));
    d.filename = lowering.file_of(std::make_shared<const Image>(ies_image(*d.profile)));
  }
  template <class Other>
  void operator()(const Other&) const {}
};

}  // namespace

void lower_lights(MitsubaLowering& lowering) {
  for (std::size_t i = 0; i < lowering.scene().emitters.size(); ++i)
    std::visit(LoweredLight{lowering, lowering.scene().emitters[i]}, lowering.lowered().emitters[i].light);
}

}  // namespace photonproof::inline reference_mitsuba
