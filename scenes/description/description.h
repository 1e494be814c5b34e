// A scene file's content as plain values: the exchange type between parser, writer, renderer and POV-Ray export.
// Meaning, orientation and defaults are Mitsuba 3's. Lengths in scene units, radiance W m^-2 sr^-1, intensity W sr^-1.
// Below each struct of a plugin stands its `describe(p, description)`: the plugin's name and its parameters, in writing
// order. `p` is PluginWriter, PluginRows (the list of names and meanings), PluginName or PluginReader. The reader
// receives the defaults, which are those of the structs, and leaves the file's values.
#pragma once

#include <string>
#include <vector>

#include "scenes/base/input_error.h"
#include "scenes/description/bsdf_description.h"
#include "scenes/description/integrator_description.h"
#include "scenes/description/light_description.h"
#include "scenes/description/medium_description.h"
#include "scenes/description/scene_note.h"
#include "scenes/description/shape_description.h"
#include "scenes/description/texture_description.h"
#include "scenes/description/view_description.h"

namespace photonproof::inline scenes_description {

struct SceneDescription {
  std::vector<std::string> files;    ///< files read, the scene itself first
  std::vector<std::string> defines;  ///< values given to its $names, "name=value", and the sensor other than the first
  std::vector<TextureDescription> textures;
  std::vector<BsdfDescription> bsdfs;
  std::vector<MediumDescription> media;
  std::vector<ShapeGroupDescription> groups;
  std::vector<ShapeDescription> shapes;
  std::vector<EmitterDescription> emitters;
  SensorDescription sensor;
  IntegratorDescription integrator;
  bool as_mitsuba = false;       ///< ParseOptions::as_mitsuba
  std::vector<SceneNote> notes;  ///< differences from the file: stand-ins, and what ParseOptions::lenient left out

  /// "file:line:col" of an entity, for messages of later stages.
  std::string where(const SourceLoc& loc) const;
};

}  // namespace photonproof::inline scenes_description
