// Reads the command line, builds the scene and renders it, and does no more, so that another main can take its place.
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <stdexcept>

#include "image.h"
#include "random.h"
#include "raytracer.h"

static const char* usage =
    "./raytracer -s1|-s2|-s3|-f SCENE_FILE -w WIDTH -h HEIGHT -o PICTURE.bmp|PICTURE.ppm\n"
    "            [--seed NUMBER] [--threads NUMBER] [--only direct|caustic|global] [--dots photons|caustics]\n";

struct Options {
  int scene = 0, width = 600, height = 600;
  unsigned long long seed = 1;
  std::string file, output = "out.bmp", only, dots;
};

static Options read_options(int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; ++i) {
    std::string option = argv[i];
    if (option.size() > 2 && option.substr(0, 2) == "-f") {
      options.file = option.substr(2);
      continue;
    }
    if (option.size() == 3 && option.substr(0, 2) == "-s") {
      options.scene = option[2] - '0';
      continue;
    }
    if (++i == argc) throw std::runtime_error("nothing follows " + option);
    if (option == "-f")
      options.file = argv[i];
    else if (option == "-w")
      options.width = std::atoi(argv[i]);
    else if (option == "-h")
      options.height = std::atoi(argv[i]);
    else if (option == "-o")
      options.output = argv[i];
    else if (option == "--seed")
      options.seed = std::strtoull(argv[i], nullptr, 10);
    else if (option == "--only")
      options.only = argv[i];
    else if (option == "--dots")
      options.dots = argv[i];
    else if (option != "--threads")
      throw std::runtime_error("there is no option " + option);
  }
  if (options.width < 1 || options.height < 1) throw std::runtime_error("the picture has no pixels");
  return options;
}

int main(int argc, char** argv) try {
  Options options = read_options(argc, argv);
  seed_random(options.seed);
  Raytracer raytracer;
  if (options.file.empty())
    raytracer.build_scene(options.scene);
  else
    raytracer.build_scene_file(options.file);
  if (!options.only.empty()) {
    raytracer.parts = {options.only == "direct", options.only == "caustic", options.only == "global", false};
  }
  std::vector<Vec3> picture = options.dots.empty()
                                  ? raytracer.render(options.width, options.height)
                                  : raytracer.render_dots(options.width, options.height, options.dots == "caustics");
  write_image(options.output, options.width, options.height, picture);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n%s", error.what(), usage);
  return 1;
}
