#include "renderer/denoising/oidn_library.h"

#include <dlfcn.h>

#include <cstdlib>
#include <filesystem>
#include <vector>

#include "scenes/base/input_error.h"

namespace photonproof::inline renderer_denoising {
namespace {

namespace fs = std::filesystem;

constexpr const char* file_name = "libOpenImageDenoise.so.2";

[[noreturn]] void refuse(const std::string& message) { throw InputError("--denoise", message); }

/// Every failure ends with it.
std::string way_to_get_it() {
  return "; `harness/setup/denoiser.sh` installs it and prints the folder for PHOTONPROOF_OIDN, and some systems have "
         "a package libopenimagedenoise";
}

/// The files beside this program that may be the library.
std::vector<fs::path> beside_program() {
  std::error_code error;
  const fs::path folder = fs::read_symlink("/proc/self/exe", error).parent_path();
  if (error) return {};
  return {folder / file_name, folder.parent_path() / "lib" / file_name};
}

/// The name to load, and its words for messages.
std::string file_of(const std::string& place) {
  std::error_code ignored;
  if (place.empty()) {
    for (const fs::path& file : beside_program())
      if (fs::exists(file, ignored)) return file.string();
    return file_name;
  }
  const fs::path file = fs::is_directory(place, ignored) ? fs::path(place) / file_name : fs::path(place);
  if (!fs::is_regular_file(file, ignored))
    refuse("there is no " + (fs::path(place) == file ? "file '" : std::string(file_name) + " in '") + place + "'" +
           way_to_get_it());
  return fs::absolute(file).string();  // a bare name would be looked up in the system's folders
}

std::string loader_words() {
  const char* words = dlerror();
  return words == nullptr ? "no reason is known" : words;
}

template <class Function>
void find(void* library, const std::string& file, const char* name, Function& function) {
  function = reinterpret_cast<Function>(dlsym(library, name));
  if (function == nullptr)
    refuse("'" + file + "' has no function " + name + ": it is not Open Image Denoise of version 2");
}

}  // namespace

OidnFunctions load_oidn(const std::string& place) {
  const std::string file = file_of(place);
  void* library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) {
    const std::string words = loader_words();
    const bool is_named = file != file_name;
    refuse("Open Image Denoise " + std::string(is_named ? "cannot be loaded" : "is not found") + ": " + words +
           (is_named ? "" : way_to_get_it()));
  }
  OidnFunctions f;
  const auto find_as = [&](const char* name, auto& function) { find(library, file, name, function); };
  find_as("oidnNewDevice", f.NewDevice);
  find_as("oidnCommitDevice", f.CommitDevice);
  find_as("oidnReleaseDevice", f.ReleaseDevice);
  find_as("oidnSetDeviceBool", f.SetDeviceBool);
  find_as("oidnSetDeviceInt", f.SetDeviceInt);
  find_as("oidnGetDeviceInt", f.GetDeviceInt);
  find_as("oidnGetDeviceError", f.GetDeviceError);
  find_as("oidnNewFilter", f.NewFilter);
  find_as("oidnCommitFilter", f.CommitFilter);
  find_as("oidnExecuteFilter", f.ExecuteFilter);
  find_as("oidnReleaseFilter", f.ReleaseFilter);
  find_as("oidnSetFilterBool", f.SetFilterBool);
  find_as("oidnSetSharedFilterImage", f.SetSharedFilterImage);
  find_as("oidnSetFilterProgressMonitorFunction", f.SetFilterProgressMonitorFunction);
  return f;
}

std::string oidn_in_environment() {
  const char* place = std::getenv("PHOTONPROOF_OIDN");
  return place == nullptr ? "" : place;
}

}  // namespace photonproof::inline renderer_denoising
