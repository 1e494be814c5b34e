#include <dlfcn.h>

#include <filesystem>

#include "scenes/image_file.h"
#include "scenes/input_error.h"

namespace photonproof {
namespace {

namespace fs = std::filesystem;

const ImageFormats& load() {
  constexpr const char* name = "photonproof_image_formats.so";
  std::error_code ignored;
  const fs::path program = fs::read_symlink("/proc/self/exe", ignored);
  std::string reason;
  for (const fs::path& folder : {program.parent_path() / "../lib", fs::path(PHOTONPROOF_MODULE_FOLDER)}) {
    // Never closed: libraries below it have threads of their own.
    void* const module = dlopen((folder / name).c_str(), RTLD_NOW | RTLD_LOCAL);
    if (const void* table = module ? dlsym(module, image_formats_symbol) : nullptr)
      return *static_cast<const ImageFormats*>(table);
    reason = dlerror();
  }
  throw InputError(name, "images other than EXR cannot be read or written without it: " + reason);
}

}  // namespace

const ImageFormats& image_formats() {
  static const ImageFormats& formats = load();
  return formats;
}

}  // namespace photonproof
