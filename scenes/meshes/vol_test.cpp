// The reader of Mitsuba's volume files. Files are made here by the format's public description.
#include "scenes/meshes/vol.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <limits>

#include "scenes/base/input_error.h"
#include "scenes/files/atomic_file.h"
#include "scenes/meshes/vol_fuzz.h"

namespace photonproof::inline scenes_meshes {
namespace {

template <class T>
void put(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// A grid of 3 x 2 x 2 cells whose values count up from 0.5, in a box from (-1, 0, 2) to (1, 3, 4).
std::string counting_grid(std::int32_t channels) {
  std::string bytes = "VOL\x03";
  for (const std::int32_t word : {1, 3, 2, 2, channels}) put(bytes, word);
  for (const float corner : {-1.f, 0.f, 2.f, 1.f, 3.f, 4.f}) put(bytes, corner);
  for (int i = 0; i < 12 * channels; ++i) put(bytes, 0.5f + static_cast<float>(i));
  return bytes;
}

template <class T>
std::string changed(std::string bytes, std::size_t at, T value) {
  std::string word;
  put(word, value);
  return bytes.replace(at, word.size(), word);
}

std::string message_of(const std::string& bytes) {
  try {
    parse_vol(bytes, "a.vol");
    return "";
  } catch (const InputError& error) {
    return error.summary();
  }
}

TEST(vol, has_cells_channels_a_box_and_values) {
  for (const int channels : {1, 3}) {
    const VolumeGrid grid = parse_vol(counting_grid(channels), "a.vol");
    EXPECT_EQ(grid.width, 3);
    EXPECT_EQ(grid.height, 2);
    EXPECT_EQ(grid.depth, 2);
    EXPECT_EQ(grid.channels, channels);
    EXPECT_EQ(grid.low, Vec3f(-1, 0, 2));
    EXPECT_EQ(grid.high, Vec3f(1, 3, 4));
    ASSERT_EQ(grid.values.size(), std::size_t(12 * channels));
    EXPECT_EQ(grid.values[5], 5.5f);
    EXPECT_EQ(grid.largest, static_cast<float>(12 * channels) - 0.5f);
  }
}

TEST(vol, that_is_damaged_is_refused) {
  const std::string good = counting_grid(1);
  EXPECT_EQ(message_of("VDB"), "a.vol: error: is not a volume of Mitsuba");
  EXPECT_EQ(message_of("VOL\x02"), "a.vol: error: has version 2 of volumes, expected 3");
  EXPECT_EQ(message_of(good.substr(0, 47)), "a.vol: error: the header ends too early");
  EXPECT_EQ(message_of(changed(good, 4, 3)), "a.vol: error: has values of type 3, expected 1 (32-bit floats)");
  EXPECT_EQ(message_of(changed(good, 12, 0)), "a.vol: error: has 0 cells along y, expected 1 to 1048576");
  EXPECT_EQ(message_of(changed(good, 20, 6)), "a.vol: error: has 6 channels, expected 1 or 3");
  EXPECT_EQ(message_of(changed(good, 44, 2.f)), "a.vol: error: has no extent along z");
  EXPECT_EQ(message_of(good.substr(0, good.size() - 1)), "a.vol: error: has 11 values, expected 12");
  EXPECT_EQ(message_of(changed(good, 56, -1.f)), "a.vol: error: byte 56 begins a value that is negative or not finite");
  EXPECT_EQ(message_of(changed(good, 60, std::numeric_limits<float>::quiet_NaN())),
            "a.vol: error: byte 60 begins a value that is negative or not finite");
}

TEST(vol, that_promises_too_much_allocates_nothing) {
  std::string vast = counting_grid(3);
  for (const std::size_t at : {8, 12, 16}) vast = changed(vast, at, std::int32_t{1} << 20);
  EXPECT_EQ(message_of(vast), "a.vol: error: has 36 values, expected 3458764513820540928");
}

TEST(vol, corpus_gives_sound_grids_or_messages) {
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(PHOTONPROOF_CORPORA "/vol_corpus")) {
    EXPECT_EQ(check_vol(read_file(entry.path())), "") << entry.path();
    ++files;
  }
  EXPECT_GE(files, 23);
}

TEST(vol, of_any_bytes_is_a_sound_grid_or_one_message) {
  const std::string good = counting_grid(3);
  for (std::size_t size = 0; size < good.size(); ++size) {
    EXPECT_EQ(check_vol(std::string_view(good).substr(0, size)), "") << size;
    for (int bit = 0; bit < 8; ++bit) {
      std::string bent = good;
      bent[size] = static_cast<char>(bent[size] ^ (1 << bit));
      EXPECT_EQ(check_vol(bent), "") << size << " bit " << bit;
    }
  }
}

}  // namespace
}  // namespace photonproof::inline scenes_meshes
