// photonproof-read-model MODEL FOLDER: writes a model file as a scene into a folder, and its remarks to standard
// output. The program photonproof runs it for files that are no XML. Exit codes: 0, and 2 for a file that cannot be
// read, with one line on standard error.
#include <cstdio>
#include <exception>

#include "scenes/base/input_error.h"
#include "scenes/models/model_scene.h"

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: photonproof-read-model MODEL FOLDER\n");
    return 2;
  }
  try {
    for (const std::string& remark : photonproof::write_model_scene(argv[1], argv[2]))
      std::printf("%s\n", remark.c_str());
    return 0;
  } catch (const photonproof::InputError& error) {
    std::fprintf(stderr, "%s\n", error.summary().c_str());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: error: cannot be read as a model: %s\n", argv[1], error.what());
  }
  return 2;
}
