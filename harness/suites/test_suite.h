// A suite whose engines are one shell script: each engine behaves in one way and is named after it.
#pragma once

#include <limits>
#include <optional>

#include "scenes/files/test_folder.h"
#include "scenes/images/image.h"

namespace photonproof::inline harness_suites {

class FakeSuiteTest : public FolderTest {
 protected:
  static constexpr int width = 32, height = 24;

  void SetUp() override {
    FolderTest::SetUp();
    put("scene.xml", scene_text);
    put("expect.toml", "purpose = 'to be measured'\nexposure = 0.5\n");
    put("engine.sh", script);
    write_grey("grey.exr", width, height, 0.5f);
    write_grey("brighter.exr", width, height, 0.6f);
    write_grey("small.exr", 4, 4, 0.5f);
    write_grey("nan.exr", width, height, std::numeric_limits<float>::quiet_NaN());
  }

  void write_grey(const std::string& name, int w, int h, float value) const {
    Rendering rendering;
    rendering.mean = Image(w, h);
    for (float& channel : rendering.mean.rgb) channel = value;
    write_exr((folder_ / name).string(), rendering);
  }

  /// One scene with a reference by `reference`, and one cell for each of `engines`.
  std::string suite_text(const std::string& reference, const std::vector<std::string>& engines,
                         const std::string& limits = "seconds = 20") const {
    std::string text = "name = 'fake'\ntitle = 'Fake'\n[limits]\nthreads = 1\n" + limits +
                       "\n[[scene]]\nname = 'scene'\npath = 'scene.xml'\nwidth = " + std::to_string(width) +
                       "\nheight = " + std::to_string(height) + "\nreference = {engine = '" + reference +
                       "', budget = 'spp=1000', seed = 0}\n";
    for (const char* engine : {"grey", "brighter", "hangs", "segfaults", "fails", "refuses", "silent", "half", "small",
                               "nan", "garbage", "hog", "bad_stats", "sleeps"})
      text += "[[engine]]\nname = '" + std::string(engine) +
              "'\ntitle = 'fake'\ncommand = ['sh', '{suite}/engine.sh', '" + engine +
              "', '{suite}', '{output}', '{stats}', '{scene}', '{seed}']\nversions = [['cat', " +
              "'{suite}/version']]\nbudgets = ['spp']\ntrust = 'external'\n";
    put("version", "fake 1\n");
    for (const std::string& engine : engines)
      text += "[[run]]\nengine = '" + engine + "'\nbudgets = ['spp=1']\nseeds = [1]\n";
    return text;
  }

  /// The scene with a crop of a quarter of its pixels.
  void put_cropped_scene() const {
    std::string text = scene_text;
    const std::string before = "<rfilter type=\"box\"/>";
    text.insert(text.find(before),
                "<integer name='width' value='32'/><integer name='height' value='24'/>"
                "<integer name='crop_offset_x' value='8'/><integer name='crop_offset_y' value='6'/>"
                "<integer name='crop_width' value='16'/><integer name='crop_height' value='12'/>");
    put("scene.xml", text);
  }
  /// The pixels of that crop, with its place as in our renderer's files.
  static Rendering crop_of_scene(const Image& whole) {
    Rendering part;
    part.mean = Image(16, 12);
    for (int y = 0; y < 12; ++y)
      for (int x = 0; x < 16; ++x)
        for (int c = 0; c < 3; ++c) part.mean.pixel(x, y)[c] = whole.pixel(8 + x, 6 + y)[c];
    part.place = ImagePlace{8, 6, width, height};
    return part;
  }
  /// The mean over pixels and channels of (test - reference)^2 / (reference^2 + epsilon); mse where epsilon is empty.
  static double error_by_hand(const Image& reference, const Image& test, std::optional<double> epsilon) {
    double sum = 0;
    for (std::size_t i = 0; i < reference.rgb.size(); ++i) {
      const double r = double{reference.rgb[i]}, d = double{test.rgb[i]} - r;
      sum += epsilon ? d * d / (r * r + *epsilon) : d * d;
    }
    return sum / static_cast<double>(reference.rgb.size());
  }

  /// Names of the engines that the script ran as, in order.
  std::string started() const { return has("log") ? get("log") : ""; }

  static constexpr const char* script = R"script(
echo "$1" >> "$2/log"
stats='{"schema_version": 1, "phases": {"copy": 0.25}, "losses": ["it only copies"]}'
case $1 in
  grey|brighter|small|nan) cp "$2/$1.exr" "$3"; echo "$stats" > "$4" ;;
  hangs) sleep 60 ;;
  segfaults) kill -SEGV $$ ;;
  fails) echo 'first words' >&2; echo 'out of ideas' >&2; exit 5 ;;
  escapes) printf '\033]0;owned\007\033[2Jred\302\23331m\n' >&2; exit 5 ;;
  leaves_temporary) echo half > "$2/.image.partial-$$.exr"; sleep 60 ;;
  refuses) echo 'no mirrors here' >&2; exit 3 ;;
  silent) exit 0 ;;
  half) head -c 300 "$2/grey.exr" > "$3" ;;
  garbage) echo 'this is no image' > "$3" ;;
  hog) tail -n 1 /dev/zero ;;
  denoises) cp "$2/grey.exr" "$3"
    echo '{"schema_version": 1, "denoised": {"library": "Denoiser", "version": "2.5"}}' > "$4" ;;
  bad_stats) cp "$2/grey.exr" "$3"; echo '{"schema' > "$4" ;;
  sleeps) echo $$ > "$2/pid"; sleep 0.5; cp "$2/grey.exr" "$3" ;;
esac
)script";
  static constexpr const char* scene_text = R"xml(<scene version="3.0.0">
  <sensor type="perspective"><film type="hdrfilm"><rfilter type="box"/></film></sensor>
  <shape type="sphere"><emitter type="area"><rgb name="radiance" value="1"/></emitter></shape>
</scene>
)xml";
};

}  // namespace photonproof::inline harness_suites
