// The folder of the files that come with the program: scenes, suites and folders to begin with.
#pragma once

#include <filesystem>

namespace photonproof::inline harness_verbs_start {

/// The first of these that exists: $PHOTONPROOF_DATA, ../share/photonproof beside the program's folder, the source tree
/// of the build. All have the layout of the source tree. Throws InputError if $PHOTONPROOF_DATA is set and lacks
/// scenes/library, or if there is none.
std::filesystem::path data_folder();

}  // namespace photonproof::inline harness_verbs_start
