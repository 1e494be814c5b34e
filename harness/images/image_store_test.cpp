#include "harness/images/image_store.h"

#include "scenes/files/file_checksum.h"
#include "scenes/files/test_folder.h"
#include "scenes/images/image.h"

namespace photonproof::inline harness_images {
namespace {

class Store : public FolderTest {
 protected:
  static KeptResult result(const std::string& detail) {
    KeptResult kept;
    kept.result.cell = {"s", "e", {"spp", 1}, 1};
    kept.result.key = "key";
    kept.result.status = Status::crash;
    kept.result.detail = detail;
    kept.comparison_key = "compared";
    return kept;
  }
  KeptResult with_image(const std::string& folder, const std::string& content) const {
    KeptResult kept = result("with image");
    kept.result.image = folder + "/image.exr";
    put(kept.result.image, content);
    return kept;
  }
  std::string latest_detail() const {
    const auto found = ImageStore(folder_).latest("key");
    return found ? found->kept.result.detail : "none";
  }
};

TEST_F(Store, unknown_key_has_no_result) { EXPECT_EQ(latest_detail(), "none"); }

TEST_F(Store, kept_result_is_found_again) {
  ImageStore store(folder_);
  const std::string name = store.claim("key");
  EXPECT_EQ(name, "cells/key-1");
  EXPECT_EQ(latest_detail(), "none");  // not before its record exists
  store.keep({result("first"), name});
  EXPECT_EQ(latest_detail(), "first");
  EXPECT_EQ(store.latest("key")->folder, "cells/key-1");
}

TEST_F(Store, second_measurement_stands_beside_the_first) {
  ImageStore store(folder_);
  store.keep({result("first"), store.claim("key")});
  const std::string second = store.claim("key");
  EXPECT_EQ(second, "cells/key-2");
  EXPECT_EQ(latest_detail(), "first");
  store.keep({result("second"), second});
  EXPECT_EQ(latest_detail(), "second");
  EXPECT_TRUE(has("cells/key-1/cell.json"));
}

TEST_F(Store, folder_of_an_interrupted_image_is_emptied_and_used_again) {
  const std::string name = ImageStore(folder_).claim("key");
  put(name + "/image.exr", "half");
  EXPECT_EQ(ImageStore(folder_).claim("key"), name);
  EXPECT_FALSE(has(name + "/image.exr"));
}

TEST_F(Store, folder_of_an_interrupted_image_keeps_its_files_where_the_engine_resumes) {
  const std::string name = ImageStore(folder_).claim("key");
  put(name + "/image.exr.checkpoint", "half");
  ImageStore store(folder_);
  EXPECT_EQ(store.claim("key", true), name);
  EXPECT_EQ(get(name + "/image.exr.checkpoint"), "half");
  EXPECT_EQ(store.claim("key", true), "cells/key-2");  // the first is in use
}

TEST_F(Store, removed_images_are_gone_and_others_stay) {
  ImageStore store(folder_);
  store.keep({result("first"), store.claim("key")});
  store.keep({result("second"), store.claim("key")});
  store.keep({result("other"), store.claim("key2")});
  store.remove("key");
  EXPECT_EQ(latest_detail(), "none");
  EXPECT_FALSE(has("cells/key-1"));
  EXPECT_TRUE(has("cells/key2-1/cell.json"));
}

TEST_F(Store, folder_that_is_being_filled_is_no_leftover) {
  ImageStore store(folder_);
  const std::string name = store.claim("key");
  put(name + "/image.exr", "half");
  EXPECT_EQ(store.claim("key"), "cells/key-2");
  EXPECT_EQ(get(name + "/image.exr"), "half");
}

TEST_F(Store, folder_that_another_process_may_be_filling_is_left_alone) {
  const std::string name = ImageStore(folder_).claim("key");
  put(name + "/image.exr", "half");
  EXPECT_EQ(ImageStore(folder_, false).claim("key"), "cells/key-2");
  EXPECT_EQ(get(name + "/image.exr"), "half");
}

TEST_F(Store, reader_decides_which_record_counts) {
  ImageStore store(folder_);
  for (const char* text : {"first", "second", "third"}) put(store.claim("key") + "/cell.json", text);
  const auto read = [&](const std::string& name) -> std::optional<std::string> {
    const std::string text = get(name + "/cell.json");
    if (text == "third") throw InputError(name, "is damaged");
    return text == "second" ? std::nullopt : std::optional(text);
  };
  EXPECT_EQ(store.latest("key", read), "first");
}

TEST_F(Store, damaged_record_does_not_count_and_is_not_touched) {
  ImageStore store(folder_);
  store.keep({result("first"), store.claim("key")});
  store.keep({result("second"), store.claim("key")});
  put("cells/key-2/cell.json", "{\"schema_");
  EXPECT_EQ(latest_detail(), "first");
  EXPECT_EQ(store.claim("key"), "cells/key-3");
  EXPECT_EQ(get("cells/key-2/cell.json"), "{\"schema_");
}

TEST_F(Store, result_whose_image_is_gone_does_not_count) {
  ImageStore store(folder_);
  const std::string name = store.claim("key");
  store.keep({with_image(name, "x"), name});
  EXPECT_EQ(latest_detail(), "with image");
  std::filesystem::remove(folder_ / name / "image.exr");
  EXPECT_EQ(latest_detail(), "none");
}

TEST_F(Store, result_whose_pictures_are_gone_has_to_be_compared_again) {
  ImageStore store(folder_);
  const std::string name = store.claim("key");
  KeptResult kept = result("with picture");
  kept.result.pictures["image"] = name + "/image.png";
  put(name + "/image.png", "x");
  store.keep({kept, name});
  EXPECT_EQ(store.latest("key")->kept.comparison_key, "compared");
  std::filesystem::remove(folder_ / name / "image.png");
  EXPECT_EQ(store.latest("key")->kept.comparison_key, "");
}

TEST_F(Store, image_that_is_another_than_was_measured_does_not_count) {
  ImageStore store(folder_);
  const std::string name = store.claim("key");
  KeptResult kept = with_image(name, "as it was");
  kept.result.image_checksum = file_checksum(folder_ / name / "image.exr");
  store.keep({kept, name});
  EXPECT_EQ(latest_detail(), "with image");
  put(name + "/image.exr", "as it is ");  // has the same size
  EXPECT_EQ(latest_detail(), "none");
}

TEST_F(Store, image_without_checksum_has_to_be_one) {
  ImageStore store(folder_);
  const std::string name = store.claim("key");
  KeptResult kept = result("of an older program");
  kept.result.status = Status::ok;
  kept.result.image = name + "/image.exr";
  Rendering rendering;
  rendering.mean = Image(4, 4);
  write_exr((folder_ / name / "image.exr").string(), rendering);
  store.keep({kept, name});
  EXPECT_EQ(latest_detail(), "of an older program");
  std::filesystem::resize_file(folder_ / name / "image.exr", 300);
  EXPECT_EQ(latest_detail(), "none");
}

TEST_F(Store, folder_that_is_no_folder_holds_nothing) {
  put("cells", "a file");
  EXPECT_EQ(latest_detail(), "none");
  EXPECT_TRUE(input_error_of([&] { ImageStore(folder_).claim("key"); }).find("cannot be made") != std::string::npos);
}

}  // namespace
}  // namespace photonproof::inline harness_images
