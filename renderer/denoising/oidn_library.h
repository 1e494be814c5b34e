// Open Image Denoise as a shared library that is loaded when a render asks for it. Nothing is linked: the handful of
// functions that are used is declared here, after the C API of version 2 (openimagedenoise.github.io, "Open Image
// Denoise API").
#pragma once

#include <cstddef>
#include <string>

namespace photonproof::inline renderer_denoising {

/// The functions with the names of the C API, "oidn" left out. Handles are opaque. A function that takes a name ignores
/// one that it does not know and reports it as the device's error.
struct OidnFunctions {
  using Device = struct OidnDeviceHandle*;
  using Filter = struct OidnFilterHandle*;
  using ProgressMonitor = bool (*)(void* user, double fraction);  ///< false cancels

  Device (*NewDevice)(int type) = nullptr;  ///< null where the type is not supported
  void (*CommitDevice)(Device) = nullptr;
  void (*ReleaseDevice)(Device) = nullptr;
  void (*SetDeviceBool)(Device, const char* name, bool value) = nullptr;
  void (*SetDeviceInt)(Device, const char* name, int value) = nullptr;
  int (*GetDeviceInt)(Device, const char* name) = nullptr;
  /// Code and text of the first error since the last call, which clears it. A null device: errors of NewDevice.
  int (*GetDeviceError)(Device, const char** message) = nullptr;
  Filter (*NewFilter)(Device, const char* type) = nullptr;
  void (*CommitFilter)(Filter) = nullptr;
  void (*ExecuteFilter)(Filter) = nullptr;
  void (*ReleaseFilter)(Filter) = nullptr;
  void (*SetFilterBool)(Filter, const char* name, bool value) = nullptr;
  /// Strides are in bytes; 0 stands for pixels without gaps.
  void (*SetSharedFilterImage)(Filter, const char* name, void* pixels, int format, std::size_t width,
                               std::size_t height, std::size_t byte_offset, std::size_t pixel_stride,
                               std::size_t row_stride) = nullptr;
  void (*SetFilterProgressMonitorFunction)(Filter, ProgressMonitor, void* user) = nullptr;

  static constexpr int device_type_cpu = 1;
  static constexpr int format_float3 = 3;
  static constexpr int error_none = 0, error_cancelled = 6;
};

/// Loads `place`, which is the library's file or its folder. Empty: the program's own folder, the folder `lib` beside
/// that, and the system's loader are tried. The library stays loaded until the process ends. Throws InputError at
/// "--denoise", with the way to get the library, the loader's words or the name of a missing function.
OidnFunctions load_oidn(const std::string& place);

/// The place in the environment variable PHOTONPROOF_OIDN; empty without it.
std::string oidn_in_environment();

}  // namespace photonproof::inline renderer_denoising
