#include "scenes/description/output_files.h"

#include "scenes/files/test_folder.h"
#include "scenes/parser/parser.h"

namespace photonproof::inline scenes_description {
namespace {

namespace fs = std::filesystem;

class OutputFiles : public FolderTest {
 protected:
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  std::string refusal(const std::string& output, const std::vector<InputFile>& inputs) const {
    return input_error_of([&] { prepare_outputs({output}, inputs); });
  }
};

TEST_F(OutputFiles, input_is_known_by_any_of_its_names) {
  put("in.json", "x");
  fs::create_symlink("in.json", folder_ / "link.json");
  fs::create_hard_link(folder_ / "in.json", folder_ / "hard.json");
  const std::vector<InputFile> inputs{{path("in.json"), "the record"}};
  for (const std::string name : {"in.json", "./in.json", "link.json", "hard.json"})
    EXPECT_EQ(refusal(path(name), inputs), path(name) + ": error: is the record, which it would replace");
  EXPECT_EQ(refusal(path("out.json"), inputs), "no error");
  EXPECT_EQ(refusal(path(std::string(256, 'n')), inputs),
            path(std::string(256, 'n')) + ": error: cannot be written: File name too long");
}

TEST_F(OutputFiles, folder_that_is_missing_is_made) {
  EXPECT_EQ(refusal(path("new/deep/out.exr"), {}), "no error");
  EXPECT_TRUE(fs::is_directory(folder_ / "new/deep"));
  put("file", "x");
  EXPECT_EQ(refusal(path("file/out.exr"), {}),
            path("file/out.exr") + ": error: folder '" + path("file") + "' cannot be made: Not a directory");
}

TEST_F(OutputFiles, scene_reads_all_that_it_names) {
  put("part.xml", "<scene version='3.0.0'><emitter type='point'/></scene>");
  put("mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  Rendering rendering;
  rendering.mean = Image(1, 1);
  for (const char* name : {"map.exr", "sky.exr"}) write_exr(path(name), rendering);
  put("scene.xml", R"(<scene version='3.0.0'><include filename='part.xml'/>
    <sensor type='perspective'><film type='hdrfilm'><rfilter type='box'/></film></sensor>
    <emitter type='envmap'><string name='filename' value='sky.exr'/></emitter>
    <shape type='obj'><string name='filename' value='mesh.obj'/><bsdf type='diffuse'>
      <texture type='bitmap' name='reflectance'><string name='filename' value='map.exr'/></texture></bsdf></shape>
    </scene>)");
  const std::vector<InputFile> inputs = scene_inputs(parse_scene_file(path("scene.xml")));
  for (const std::string name : {"scene.xml", "part.xml", "mesh.obj", "map.exr", "sky.exr"})
    EXPECT_TRUE(refusal(path(name), inputs).ends_with("which it would replace")) << name;
}

}  // namespace
}  // namespace photonproof::inline scenes_description
