// photonproof view: the page's data, and input that makes no page.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "scenes/base/process.h"
#include "scenes/files/atomic_file.h"
#include "scenes/files/test_folder.h"
#include "scenes/images/image.h"

namespace photonproof::inline harness_verbs {
namespace {

class ViewVerb : public FolderTest {
 protected:
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  void put_image(const std::string& name, int width, int height, float value) const {
    Image image(width, height);
    image.rgb.assign(image.rgb.size(), value);
    write_exr(path(name), {image, {}, {}});
  }
  ProcessOutcome view(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {PHOTONPROOF_BINARY, "view", "--no-open"});
    return run_process(arguments, {.wall_limit_seconds = 60, .working_folder = folder_});
  }
  nlohmann::json viewer_of(const std::string& page) const {
    const std::string text = get(page), before = "<script type=\"application/json\" class=\"viewer-data\">";
    const std::size_t begin = text.find(before) + before.size();
    return nlohmann::json::parse(text.substr(begin, text.find("</script>", begin) - begin));
  }
};

// The relMSE of 0.4 for 0.5 is 0.01 / (0.25 + 0.01), the bias a fifth.
TEST_F(ViewVerb, page_has_the_images_and_their_errors) {
  put_image("half.exr", 6, 4, 0.5f);
  put_image("dim.exr", 6, 4, 0.4f);
  const ProcessOutcome outcome = view({"dim.exr", "--reference", "half.exr", "--exposure", "1"});
  ASSERT_TRUE(outcome.ok()) << outcome.standard_error;
  EXPECT_EQ(outcome.standard_output, "view.html\n");
  const nlohmann::json viewer = viewer_of("view.html");
  EXPECT_EQ(viewer["width"], 6);
  EXPECT_EQ(viewer["height"], 4);
  EXPECT_EQ(viewer["exposure"], 1);
  ASSERT_EQ(viewer["images"].size(), 2u);
  EXPECT_EQ(viewer["images"][0]["title"], "half.exr");
  EXPECT_EQ(viewer["images"][0]["isReference"], true);
  EXPECT_EQ(viewer["images"][1]["title"], "dim.exr");
  EXPECT_EQ(viewer["images"][1]["caption"], "bias -20 %, relMSE 0.0385");
  EXPECT_NE(get("view.html").find("<title>half.exr, dim.exr"), std::string::npos);
}

TEST_F(ViewVerb, output_that_does_not_arrive_is_an_error) {
  put_image("a.exr", 2, 2, 1);
  const ProcessOutcome outcome = run_process({"sh", "-c", "'" PHOTONPROOF_BINARY "' view a.exr --no-open >/dev/full"},
                                             {.wall_limit_seconds = 60, .working_folder = folder_});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.standard_error, "photonproof: standard output cannot be written\n");
}

TEST_F(ViewVerb, files_of_one_name_have_their_paths_as_titles) {
  std::filesystem::create_directory(folder_ / "b");
  put_image("a.exr", 2, 2, 1);
  put_image("b/a.exr", 2, 2, 1);
  ASSERT_TRUE(view({"a.exr", "b/a.exr", "-o", "new/two.html"}).ok());
  EXPECT_EQ(viewer_of("new/two.html")["images"][1]["title"], "b/a.exr");
}

TEST_F(ViewVerb, input_that_cannot_be_shown_is_one_error_and_no_page) {
  put_image("a.exr", 2, 2, 1);
  put_image("b.exr", 3, 2, 1);
  put_image("long.exr", 4097, 1, 1);
  put("text.exr", "no image");
  put("keep.html", "mine");
  const auto message = [&](const std::vector<std::string>& arguments) {
    const ProcessOutcome outcome = view(arguments);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_FALSE(has("view.html"));
    return outcome.standard_error;
  };
  EXPECT_EQ(message({"a.exr", "b.exr"}), "b.exr: error: is 3x2, but a.exr is 2x2: images of one view have one size\n");
  EXPECT_EQ(message({"long.exr"}), "long.exr: error: is 4097x1, expected at most 4096 pixels a side\n");
  EXPECT_NE(message({"a.exr", "--exposure", "nan"}).find("--exposure"), std::string::npos);
  EXPECT_EQ(message({"missing.exr"}).substr(0, 19), "missing.exr: error:");
  EXPECT_EQ(message({"text.exr"}).substr(0, 16), "text.exr: error:");
  EXPECT_EQ(message({"a.exr", "-o", "a.exr"}),
            "--output: error: 'a.exr' is not the name of a page, expected NAME.html\n");
  EXPECT_EQ(message({"a.exr", "b.exr", "-o", "keep.html"}).substr(0, 6), "b.exr:");
  EXPECT_EQ(get("keep.html"), "mine");
}

}  // namespace
}  // namespace photonproof::inline harness_verbs
