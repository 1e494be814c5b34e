// Reads the Mitsuba 3 subset into a SceneDescription. Files are untrusted: see Limits.
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "scenes/description/description.h"

namespace photonproof::inline scenes_parser {

struct ParseOptions {
  std::map<std::string, std::string> defines;  ///< -D name=value; every one must be used
  bool allow_outside = false;                  ///< let includes and meshes leave the scene's folder
  int sensor = 0;                              ///< which of the scene's sensors, counted from 0
  bool lenient = false;                        ///< leave out what cannot be read, with a note for each
  bool as_mitsuba = false;  ///< follow Mitsuba where it is wrong (as_mitsuba.h), with a note for each
};

/// Reads a scene, or a model of another format (model_file.h) to which a camera and a light are supplied.
/// Throws InputError on anything outside the format: one error that tells all of it, with file:line:col. With
/// `options.lenient` that is left out and becomes a note of the description. A file that is no scene is refused anyhow.
SceneDescription parse_scene_file(const std::string& path, const ParseOptions& options = {});

/// The scene of a model file (model_file.h). What its reader makes goes into `folder`, which must outlive the names of
/// files in the result. Those of a mesh alone are relative to the model's folder, those of others to `folder`.
SceneDescription parse_model_file(const std::string& path, const std::string& folder, const ParseOptions& options = {});

/// The same as parse_scene_file for text already in memory; `name` stands for the file in messages, includes resolve
/// against its folder.
SceneDescription parse_scene_text(std::string_view text, const std::string& name, const ParseOptions& options = {});

}  // namespace photonproof::inline scenes_parser
