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
  const fs::path prefix = program.parent_path() / "..";  // an installation can be moved
  for (const fs::path& folder : {prefix / PHOTONPROOF_LIBRARY_FOLDER / "photonproof", prefix / "lib/photonproof",
                                 prefix / "lib", fs::path(PHOTONPROOF_MODULE_FOLDER),
                                 // For programs that link the library: where it was installed, and Debian's package.
                                 fs::path(PHOTONPROOF_INSTALLED_MODULES), fs::path("/usr/lib/photonproof")}) {
    // Never closed: libraries below it have threads of their own.
    void* const module = dlopen((folder / name).c_str(), RTLD_NOW | RTLD_LOCAL);
    if (void* open = module ? dlsym(module, "photonproof_open_image") : nullptr) return reinterpret_cast<Open*>(open);
    reason = dlerror();
  }
  throw InputError(
      name, "images other than EXR, PNG and PFM cannot be read without it (Debian: photonproof-formats): " + reason);
}

}  // namespace

std::unique_ptr<ImageFile> open_other_format(const std::string& path) {
  static Open* const open = load();
  return std::unique_ptr<ImageFile>(open(path.c_str()));
}

}  // namespace photonproof::inline scenes_images
