// Checkpoint files: every written file can be read, and no other file can.
#include "renderer/core/checkpoint.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "scenes/files/test_folder.h"

namespace photonproof::inline renderer_core {
namespace {

class Checkpoint : public FolderTest {
 protected:
  void SetUp() override {
    FolderTest::SetUp();
    file_ = folder_ / "a.checkpoint";
  }

  void write() const {
    std::string content;
    fill_checkpoint(content, identity_, [&](StateWriter& out) { out.vector(values_); });
    write_checkpoint(file_, content);
  }
  /// The message that reading it throws; empty when it reads back unchanged.
  std::string problem(const RenderIdentity& identity) const {
    try {
      std::vector<double> read(values_.size());
      read_checkpoint(file_, identity, [&](StateReader& in) { in.vector(read); });
      return read == values_ ? "" : "other values";
    } catch (const InputError& error) {
      const std::string start = file_.string() + ": error: ";
      return error.summary().substr(0, start.size()) == start ? error.summary().substr(start.size()) : error.summary();
    }
  }
  std::string problem() const { return problem(identity_); }

  std::filesystem::path file_;
  RenderIdentity identity_{{"seed", "5"}, {"integrator", "path"}};
  std::vector<double> values_ = std::vector<double>(1000, 0.1);
};

TEST_F(Checkpoint, is_read_as_it_was_written) {
  write();
  EXPECT_EQ(problem(), "");
}

TEST_F(Checkpoint, cut_at_any_length_is_refused) {
  write();
  const std::string whole = read_file(file_);
  for (std::size_t length = 0; length < whole.size(); length += length < 200 ? 1 : 97) {
    write_file_atomically(file_, whole.substr(0, length));
    // The first 25 bytes identify the file type.
    EXPECT_EQ(problem(),
              length < 25 ? "is not a checkpoint of a render" : "is damaged or cut short: its checksum does not fit")
        << length;
  }
}

TEST_F(Checkpoint, with_any_byte_changed_is_refused) {
  write();
  const std::string whole = read_file(file_);
  for (std::size_t at = 0; at < whole.size(); at += at < 200 ? 1 : 97) {
    std::string changed = whole;
    changed[at] = static_cast<char>(changed[at] ^ 4);
    write_file_atomically(file_, changed);
    EXPECT_EQ(problem(),
              at < 25 ? "is not a checkpoint of a render" : "is damaged or cut short: its checksum does not fit")
        << at;
  }
  write_file_atomically(file_, whole + "more");
  EXPECT_EQ(problem(), "is damaged or cut short: its checksum does not fit");
}

TEST_F(Checkpoint, of_another_render_is_refused_by_the_first_difference) {
  write();
  EXPECT_EQ(problem({{"seed", "6"}, {"integrator", "path"}}),
            "the checkpoint is not one of this render: its seed is 5, this render's is 6");
  EXPECT_EQ(problem({{"seed", "5"}, {"integrator", "bdpt"}}),
            "the checkpoint is not one of this render: its integrator is path, this render's is bdpt");
  EXPECT_EQ(problem({{"seed", "5"}}),
            "the checkpoint is not one of this render: it names other things than this program's");
}

TEST_F(Checkpoint, that_is_something_else_is_refused) {
  EXPECT_EQ(problem(), "is not a checkpoint of a render");  // no such file
  write_file_atomically(file_, "");
  EXPECT_EQ(problem(), "is not a checkpoint of a render");
  write_file_atomically(file_, std::string(4096, '\0'));
  EXPECT_EQ(problem(), "is not a checkpoint of a render");
  std::filesystem::remove(file_);
  std::filesystem::create_directory(file_);
  EXPECT_EQ(problem(), "is not a checkpoint of a render");
}

TEST_F(Checkpoint, that_holds_tables_of_another_size_is_refused) {
  write();
  values_.resize(999);
  EXPECT_EQ(problem(), "the checkpoint is not one of this render: its tables have another size");
}

TEST_F(Checkpoint, policy_resumes_from_a_file_if_there_is_one_and_wants_none_to_start) {
  const auto said = [&](bool resume, double seconds) -> std::string {
    try {
      CheckpointPolicy policy{file_, seconds, resume, {}};
      const bool found = policy.finds_what_it_resumes();
      EXPECT_EQ(policy.resume, resume && found);
      return found ? "" : "nothing to resume";
    } catch (const InputError& error) {
      return error.summary();
    }
  };
  EXPECT_EQ(said(false, 60), "");
  EXPECT_EQ(said(true, 60), "nothing to resume");
  write();
  EXPECT_EQ(said(true, 60), "");
  EXPECT_EQ(
      said(false, 60),
      file_.string() + ": error: an unfinished render left this checkpoint: go on from it with --resume, or delete it");
  EXPECT_EQ(said(false, 0), "");  // it will not be touched

  FileClaim claim;
  std::string content;
  fill_checkpoint(content, identity_, [&](StateWriter& out) { out.vector(values_); });
  write_checkpoint(file_, content, &claim);
  const std::string busy = file_.string() +
                           ": error: the render that writes this checkpoint is still at work: wait for it, or choose "
                           "another output";
  EXPECT_EQ(said(false, 60), busy);
  EXPECT_EQ(said(true, 60), busy);
  write();  // by another process
  EXPECT_EQ(said(true, 60), "");
}

TEST(checksum, does_not_depend_on_how_the_bytes_are_cut) {
  std::string bytes;
  for (int i = 0; i < 1000; ++i) bytes += static_cast<char>(i * 7);
  Checksum whole;
  whole.add(bytes.data(), bytes.size());
  for (const std::size_t piece : {1u, 3u, 63u, 64u, 65u, 500u}) {
    Checksum cut;
    for (std::size_t at = 0; at < bytes.size(); at += piece)
      cut.add(bytes.data() + at, std::min<std::size_t>(piece, bytes.size() - at));
    EXPECT_EQ(cut.value(), whole.value()) << piece;
  }
  Checksum longer = whole;
  longer.add("\0", 1);  // zeros that follow count
  EXPECT_NE(longer.value(), whole.value());
}

}  // namespace
}  // namespace photonproof::inline renderer_core
