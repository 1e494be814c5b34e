// The scene in the making, which all of pbrt's directives share, and the state that blocks of attributes save.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "scenes/description/description.h"
#include "scenes/pbrt/files.h"
#include "scenes/pbrt/parameters.h"
#include "scenes/pbrt/spectra.h"

namespace photonproof::inline scenes_pbrt {

/// A directive of a kind that others use later: its type and parameters, and where it stood.
struct PbrtEntity {
  std::string type;
  PbrtParameters parameters;
  Transform ctm;  ///< of that place
};
using PbrtEntityPtr = std::shared_ptr<const PbrtEntity>;

/// The part that AttributeBegin saves.
struct PbrtState {
  Transform ctm;
  bool reverse = false;
  PbrtEntityPtr material;      ///< null where `named` counts, or nothing was said
  std::string named_material;  ///< of NamedMaterial
  PbrtEntityPtr area_light;
  std::string inside, outside;  ///< media
  PbrtColours colours = PbrtColours::srgb;
  std::map<std::string, std::vector<PbrtParameter>> defaults;  ///< of the directive Attribute
};

struct PbrtContext {
  PbrtSources& sources;
  PbrtLog& log;
  PbrtFiles& files;
  PbrtSpectra& spectra;
  SceneDescription& scene;
  /// From pbrt's world to ours. pbrt's is left-handed, so it is mirrored unless the camera mirrors the picture itself.
  Transform to_ours{};
  double exposure = 1;  ///< factor of all light, for the film's sensor
  std::map<std::string, MediumIndex> media{};
};

/// Turns, moves and scales all directions alike; may mirror.
bool is_similarity(const Transform& t);

}  // namespace photonproof::inline scenes_pbrt
