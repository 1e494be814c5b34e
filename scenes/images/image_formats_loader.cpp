#include <dlfcn.h>

#include <filesystem>

#include "scenes/base/input_error.h"
#include "scenes/images/image_file.h"

namespace photonproof::inline scenes_images {
namespace {

namespace fs = std::filesystem;

using Open = ImageFile*(const char* path);

Open* load() {
  constexpr const char* name = "photonproof_image_formats.so";
  std::error_code ignored;
  const fs::path program = fs::read_symlink("/proc/self/exe", ignored);
  std::string reason;
  const fs::path beside = program.parent_path() / "../lib";
  for (const fs::path& folder :
       {beside, beside / "photonproof", fs::path(PHOTONPROOF_MODULE_FOLDER), fs::path(PHOTONPROOF_INSTALLED_MODULES)}) {
    // Never closed: libraries below it have threads of their own.
    void* const module = dlopen((folder / name).c_str(), RTLD_NOW | RTLD_LOCAL);
    if (void* open = module ? dlsym(module, "photonproof_open_image") : nullptr) return reinterpret_cast<Open*>(open);
    reason = dlerror();
  }
  throw InputError(name, "images other than EXR and PNG cannot be read without it: " + reason);
}

}  // namespace

std::unique_ptr<ImageFile> open_other_format(const std::string& path) {
  static Open* const open = load();
  return std::unique_ptr<ImageFile>(open(path.c_str()));
}

}  // namespace photonproof::inline scenes_images
