#include "harness/verbs/versions.h"

#include <OpenEXR/OpenEXRConfig.h>
#include <OpenImageIO/oiioversion.h>
#include <oneapi/tbb/version.h>
#if __has_include(<embree4/rtcore_config.h>)
#include <embree4/rtcore_config.h>
#else
#include <embree3/rtcore_config.h>
#endif

#include "renderer/core/version.h"

namespace photonproof::inline harness_verbs {

std::map<std::string, std::string> program_versions() {
  return {{"photonproof", version_line()},     {"compiler", "g++ or clang " __VERSION__},
          {"embree", RTC_VERSION_STRING},      {"oneTBB", TBB_VERSION_STRING},
          {"OpenEXR", OPENEXR_VERSION_STRING}, {"OpenImageIO", OIIO_VERSION_STRING}};
}

}  // namespace photonproof::inline harness_verbs
