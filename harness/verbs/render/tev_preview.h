// Shows a render in the image viewer tev while it goes on: the option --preview.
#pragma once

#include <string>

#include "scenes/images/image.h"

namespace photonproof::inline harness_verbs_render {

/// A connection to a tev that runs. The packets are those of its interface for other programs (github.com/Tom94/tev,
/// include/tev/Ipc.h): CreateImage, and UpdateImage in its third version.
class TevPreview {
 public:
  /// `where` is "tev", "tev:PORT" or "tev:HOST:PORT"; tev listens at 127.0.0.1:14158 by default. `name` is the image's
  /// name there. Throws InputError at "--preview" where no viewer answers within two seconds.
  TevPreview(const std::string& where, std::string name);
  ~TevPreview();
  TevPreview(const TevPreview&) = delete;
  TevPreview& operator=(const TevPreview&) = delete;

  /// A viewer that was closed, or that takes nothing for two seconds, is given up with a warning on standard error.
  void show(const Image& mean);

 private:
  bool send(const std::string& packet);

  std::string name_;
  int socket_ = -1;
  bool created_ = false;
};

}  // namespace photonproof::inline harness_verbs_render
