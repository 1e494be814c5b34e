// The film's parameters through the whole program. A scene's parameter and the same on the command line give one
// picture, and the EXR says which part of the film it holds.

#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <csignal>
#include <cstring>
#include <memory>

#include "harness/cells/test_program.h"
#include "scenes/base/process.h"
#include "scenes/files/test_folder.h"
#include "scenes/images/exr_file.h"
#include "scenes/images/image.h"

namespace photonproof::inline harness_verbs_render {
namespace {

const std::string crop_24x16 =
    "<integer name='crop_offset_x' value='12'/><integer name='crop_offset_y' value='8'/>"
    "<integer name='crop_width' value='24'/><integer name='crop_height' value='16'/>";
const std::string gaussian = "<rfilter type='gaussian'/>", box = "<rfilter type='box'/>";

class FilmParameters : public FolderTest {
 protected:
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  /// A diffuse ball and a glass one above a floor, a light over them; the film has 48 x 32 pixels.
  void put_room(const std::string& name, const std::string& film, const std::string& camera = "perspective",
                const std::string& parameters = "") {
    put(name, "<scene version='3.0.0'><integrator type='path'/><sensor type='" + camera + "'>" + parameters +
                  "<transform name='to_world'><lookat origin='0,1,5' target='0.3,0.8,0' up='0,1,0'/></transform>"
                  "<film type='hdrfilm'><integer name='width' value='48'/><integer name='height' value='32'/>" +
                  film +
                  "</film></sensor>"
                  "<shape type='rectangle'><transform name='to_world'><scale value='4'/><rotate x='1' angle='-90'/>"
                  "</transform></shape>"
                  "<shape type='sphere'><point name='center' x='-0.8' y='0.8' z='0'/><float name='radius' value='0.8'/>"
                  "</shape><shape type='sphere'><point name='center' x='1.1' y='0.7' z='0.6'/>"
                  "<float name='radius' value='0.6'/><bsdf type='dielectric'/></shape>"
                  "<shape type='rectangle'><transform name='to_world'><rotate x='1' angle='90'/>"
                  "<translate y='3'/></transform><bsdf type='diffuse'/><emitter type='area'/></shape></scene>");
  }
  Rendering render(const std::string& scene, std::vector<std::string> options) {
    options.insert(options.begin(), {PHOTONPROOF_BINARY, "render", path(scene), "-o", path("out.exr"), "--quiet"});
    const ProcessOutcome outcome = run_process(options, {.wall_limit_seconds = 300});
    EXPECT_TRUE(outcome.ok()) << outcome.standard_error;
    return outcome.ok() ? read_rendering(path("out.exr"), "", ImageWindow::stored) : Rendering();
  }
  /// The channel A of the render before, row by row; empty where there is none.
  std::vector<float> alpha() const {
    const std::unique_ptr<ImageFile> file = open_exr(path("out.exr"));
    const std::vector<std::string>& channels = file->header().channels;
    const auto found = std::ranges::find(channels, "A");
    if (found == channels.end()) return {};
    std::vector<float> values(std::size_t(file->header().width) * std::size_t(file->header().height));
    file->read(0, file->header().height, static_cast<int>(found - channels.begin()), 1, values.data());
    return values;
  }
  /// Four numbers of a window in the bytes of the file: attribute name, type, size, box.
  std::array<std::int32_t, 4> window(const std::string& name) const {
    const std::string bytes = get("out.exr"), start = name + '\0' + std::string("box2i") + '\0';
    std::array<std::int32_t, 4> corners{};
    const std::size_t at = bytes.find(start);
    if (at != std::string::npos) std::memcpy(corners.data(), bytes.data() + at + start.size() + 4, sizeof corners);
    return corners;
  }

  void expect_part(const Image& whole, const Rendering& part, const std::string& what) {
    ASSERT_EQ(part.mean.width, 24) << what;
    ASSERT_EQ(part.mean.height, 16) << what;
    EXPECT_EQ(part.place, (ImagePlace{12, 8, 48, 32})) << what;
    for (int y = 0; y < 16; ++y)
      for (int x = 0; x < 24; ++x)
        for (int c = 0; c < 3; ++c)
          ASSERT_EQ(part.mean.pixel(x, y)[c], whole.pixel(x + 12, y + 8)[c]) << what << " " << x << " " << y;
  }
};

TEST_F(FilmParameters, crop_in_the_scene_is_that_part_of_the_whole_image_to_the_bit) {
  put_room("whole.xml", gaussian);
  put_room("part.xml", crop_24x16 + gaussian);
  for (const std::vector<std::string>& method : {std::vector<std::string>{"path"},
                                                 {"direct"},
                                                 {"volpath"},
                                                 {"whitted"},
                                                 {"sppm"},
                                                 {"photonmapper", "--view", "photons"}}) {
    std::vector<std::string> options{"--spp", "2", "--integrator"};
    options.insert(options.end(), method.begin(), method.end());
    const Image whole = render("whole.xml", options).mean;
    expect_part(whole, render("part.xml", options), method[0]);
  }
  EXPECT_EQ(window("dataWindow"), (std::array<std::int32_t, 4>{12, 8, 35, 23}));
  EXPECT_EQ(window("displayWindow"), (std::array<std::int32_t, 4>{0, 0, 47, 31}));
}

TEST_F(FilmParameters, crop_is_that_part_for_every_camera_and_at_a_sampled_border) {
  const std::string principal =
      "<float name='fov' value='40'/><string name='fov_axis' value='smaller'/>"
      "<float name='principal_point_offset_x' value='0.2'/><float name='principal_point_offset_y' value='-0.1'/>";
  const std::vector<std::array<std::string, 2>> cameras{
      {"perspective", principal},
      {"thinlens", principal + "<float name='aperture_radius' value='0.1'/><float name='focus_distance' value='5'/>"},
      {"orthographic", ""},
      {"fisheye", ""}};
  for (const auto& [camera, parameters] : cameras)
    for (const std::string border : {"", "<boolean name='sample_border' value='true'/>"}) {
      put_room("whole.xml", border + gaussian, camera, parameters);
      put_room("part.xml", border + crop_24x16 + gaussian, camera, parameters);
      const Image whole = render("whole.xml", {"--spp", "2"}).mean;
      expect_part(whole, render("part.xml", {"--spp", "2"}), camera + border);
    }
}

TEST_F(FilmParameters, crop_in_the_scene_is_the_one_of_the_command_line) {
  // Light paths and the radii of photon maps depend on how many pixels are rendered, and so not on who says which.
  put_room("whole.xml", box);
  put_room("part.xml", crop_24x16 + box);
  for (const char* method : {"bdpt", "ptracer", "photonmapper"}) {
    const std::vector<std::string> options{"--spp", "4", "--integrator", method};
    std::vector<std::string> cropped = options;
    cropped.insert(cropped.end(), {"--crop", "12", "8", "24", "16"});
    const Rendering by_scene = render("part.xml", options), by_option = render("whole.xml", cropped);
    EXPECT_EQ(by_scene.mean.rgb, by_option.mean.rgb) << method;
    EXPECT_EQ(by_scene.variance->rgb, by_option.variance->rgb) << method;
    EXPECT_EQ(by_scene.place, by_option.place) << method;
  }
}

TEST_F(FilmParameters, crop_in_the_scene_is_resumed_to_the_bytes_of_a_render_never_stopped) {
  put_room("part.xml", crop_24x16 + gaussian + "<string name='pixel_format' value='rgba'/>");
  std::vector<std::string> words{
      PHOTONPROOF_BINARY, "render", path("part.xml"), "-o",           path("out.exr"), "--spp",     "4000",
      "--checkpoint",     "0.03",   "--quiet",        "--integrator", "volpath",       "--threads", "1"};
  const pid_t pid = start_program(words, path("stderr"));
  const int status = signal_after(pid, SIGKILL, 2, 0.01, [&] {
    std::error_code none_yet;
    return std::filesystem::last_write_time(path("out.exr.checkpoint"), none_yet);
  });
  ASSERT_TRUE(WIFSIGNALED(status)) << get("stderr");
  words.emplace_back("--resume");
  ASSERT_TRUE(run_process(words, {.wall_limit_seconds = 300}).ok());
  const std::string resumed = get("out.exr");
  words.pop_back();
  ASSERT_TRUE(run_process(words, {.wall_limit_seconds = 300}).ok());
  EXPECT_EQ(get("out.exr"), resumed);
}

TEST_F(FilmParameters, size_is_that_of_the_film_and_the_crop_keeps_its_share) {
  put_room("whole.xml", box);
  put_room("part.xml", crop_24x16 + box);
  // 12/48 and 36/48 of 84 pixels are 21 and 63; 8/32 and 24/32 of 50 are 12.5 and 37.5, away from zero 13 and 38.
  const Rendering part = render("part.xml", {"--spp", "2", "--size", "84x50"});
  const Rendering same = render("whole.xml", {"--spp", "2", "--size", "84x50", "--crop", "21", "13", "42", "25"});
  EXPECT_EQ(part.place, (ImagePlace{21, 13, 84, 50}));
  EXPECT_EQ(part.mean.rgb, same.mean.rgb);

  std::string smaller = get("whole.xml");
  smaller.replace(smaller.find("'48'"), 4, "'30'");
  smaller.replace(smaller.find("'32'"), 4, "'20'");
  smaller.insert(smaller.find("</sensor>"),
                 "<sampler type='independent'><integer name='sample_count' value='3'/></sampler>");
  put("smaller.xml", smaller);
  EXPECT_EQ(render("smaller.xml", {}).mean.rgb, render("whole.xml", {"--spp", "3", "--size", "30x20"}).mean.rgb);
}

// Six columns of a third of a unit, seen along +z by parallel rays. Light comes from every column after the first, and
// from beyond the right, upper and lower borders.
const std::string lit_from_column_one =
    "<transform name='to_world'><scale x='1.8333333333' y='5'/><translate x='-1.1666666667'/></transform>"
    "<boolean name='flip_normals' value='true'/>";

std::string parallel_view(const std::string& film, const std::string& shape, const std::string& integrator = "path") {
  return "<scene version='3.0.0'><integrator type='" + integrator +
         "'/><sensor type='orthographic'><transform name='to_world'><translate z='-5'/></transform>"
         "<film type='hdrfilm'><integer name='width' value='6'/><integer name='height' value='4'/>" +
         film + "</film></sensor>" + shape + "</scene>";
}

double integral(double from, double to, double (*f)(double)) {
  constexpr int steps = 20'000;
  double sum = 0;
  for (int i = 0; i < steps; ++i) sum += f(from + (to - from) * (i + 0.5) / steps) * (to - from) / steps;
  return sum;
}

TEST_F(FilmParameters, border_is_sampled_where_the_film_asks_for_it_alone) {
  // A pixel is the filter's integral over what is lit, over its integral within the film or, where the border is
  // sampled, over all of it. Of the tent in the first column that is (1/8) / (7/8) = 1/7, or 1/8.
  struct Case {
    std::string filter;
    double (*f)(double);
    double radius;
  };
  const std::vector<Case> cases{{"<rfilter type='tent'/>", [](double d) { return 1 - std::abs(d); }, 1},
                                {gaussian, [](double d) { return std::exp(-2 * d * d) - std::exp(-8.0); }, 2}};
  const std::string light = "<shape type='rectangle'>" + lit_from_column_one +
                            "<bsdf type='diffuse'><rgb name='reflectance' value='0'/></bsdf>"
                            "<emitter type='area'/></shape>";
  for (const Case& c : cases)
    for (const bool border : {false, true}) {
      put("scene.xml",
          parallel_view(c.filter + "<boolean name='sample_border' value='" + (border ? "true" : "false") + "'/>",
                        light));
      for (const char* method : {"path", "direct", "volpath", "whitted", "bdpt", "ptracer"}) {
        const Image image = render("scene.xml", {"--spp", "4096", "--integrator", method}).mean;
        for (int x = 0; x < 6; ++x) {
          const double left = border ? -c.radius : std::max(-c.radius, -(x + 0.5));
          const double right = border ? c.radius : std::min(c.radius, 5.5 - x);
          const double expected = integral(std::max(left, 0.5 - x), right, c.f) / integral(left, right, c.f);
          double mean = 0;
          for (int y = 0; y < 4; ++y) mean += double{image.pixel(x, y)[0]} / 4;
          EXPECT_NEAR(mean, expected, 0.006) << method << " " << c.filter << " border " << border << " column " << x;
        }
      }
    }
}

TEST_F(FilmParameters, channel_a_is_the_share_of_samples_on_a_shape) {
  const std::string rgba = box + "<string name='pixel_format' value='rgba'/>", sky = "<emitter type='constant'/>";
  const auto shape = [&](const std::string& inside) {
    return sky + "<shape type='rectangle'>" + lit_from_column_one + inside + "</shape>";
  };
  put("scene.xml", parallel_view(box, shape("")));
  render("scene.xml", {"--spp", "1"});
  EXPECT_TRUE(alpha().empty());
  put("scene.xml", parallel_view(rgba, shape("")));
  render("scene.xml", {"--spp", "1024"});
  const std::vector<float> diffuse = alpha();
  put("scene.xml", parallel_view(rgba, shape("<bsdf type='null'/>")));
  render("scene.xml", {"--spp", "16", "--integrator", "volpath"});
  const std::vector<float> none = alpha();
  put("scene.xml", parallel_view(rgba, shape("<bsdf type='mask'><float name='opacity' value='0.25'/>"
                                             "<bsdf type='diffuse'/></bsdf>")));
  render("scene.xml", {"--spp", "1024", "--crop", "1", "1", "5", "2"});
  const std::vector<float> mask = alpha();
  ASSERT_EQ(diffuse.size(), 24u);
  ASSERT_EQ(none.size(), 24u);
  ASSERT_EQ(mask.size(), 10u);
  for (std::size_t i = 0; i < 24; ++i) {
    EXPECT_EQ(diffuse[i], i % 6 == 0 ? 0 : 1) << i;
    EXPECT_EQ(none[i], 0) << i;
  }
  // The deviation of 1024 samples is sqrt(.25 .75 / 1024) = .0135.
  for (const float share : mask) EXPECT_NEAR(share, 0.25, 5 * 0.0135);
  // The filter reaches from the lit columns into the first: 1/7 of a tent, as above.
  put("scene.xml", parallel_view("<rfilter type='tent'/><string name='pixel_format' value='rgba'/>", shape("")));
  render("scene.xml", {"--spp", "1024"});
  EXPECT_NEAR(alpha().at(6), 1 / 7.0, 5 * std::sqrt(1 / 7.0 * 6 / 7.0 / 1024));
}

TEST_F(FilmParameters, channel_a_leaves_out_lights_that_are_hidden) {
  const std::string rgba = box + "<string name='pixel_format' value='rgba'/>";
  const std::string light = "<shape type='rectangle'>" + lit_from_column_one + "<emitter type='area'/></shape>";
  for (const bool hidden : {false, true}) {
    std::string scene = parallel_view(rgba, light);
    const std::string plain = "<integrator type='path'/>";
    scene.replace(scene.find(plain), plain.size(),
                  "<integrator type='path'><boolean name='hide_emitters' value='" +
                      std::string(hidden ? "true" : "false") + "'/></integrator>");
    put("scene.xml", scene);
    render("scene.xml", {"--spp", "4"});
    EXPECT_EQ(alpha().at(1), hidden ? 0 : 1);
    EXPECT_EQ(alpha().at(0), 0);
  }
}

}  // namespace
}  // namespace photonproof::inline harness_verbs_render
