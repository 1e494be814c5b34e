// Every file of scenes/malformed is refused with exactly the message that malformed/messages.txt shows for it. The
// messages were checked by eye: right place, what is wrong, what was expected. There {shapes} and {bsdfs} stand for the
// plugins of that kind that docs/formats/scene.md has.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <string>

#include "scenes/base/edit_distance.h"
#include "scenes/files/atomic_file.h"
#include "scenes/parser/parser.h"

namespace photonproof::inline scenes_parser {
namespace {

namespace fs = std::filesystem;

const std::string kFolder = std::string(PHOTONPROOF_SOURCE_DIR) + "/scenes/malformed/";

/// The program's message about a file, without the folder's name; empty when it is accepted.
std::string message_for(const std::string& file) {
  try {
    parse_scene_file(kFolder + file);
    return {};
  } catch (const InputError& error) {
    std::string message = error.what();
    for (auto at = message.find(kFolder); at != std::string::npos; at = message.find(kFolder))
      message.erase(at, kFolder.size());
    return message;
  }
}

/// The plugins in the page's table of that tag, as a sentence lists them.
std::string listed_in_format(const std::string& tag) {
  const std::string page = read_file(PHOTONPROOF_SOURCE_DIR "/docs/formats/scene.md"), heading = "### " + tag + "\n";
  const std::size_t begin = page.find(heading) + heading.size();
  std::vector<std::string> names;
  for (std::size_t at = begin, end = page.find("\n#", begin); (at = page.find("\n| `", at)) < end;) {
    at += 4;
    names.push_back(page.substr(at, page.find('`', at) - at));
  }
  std::sort(names.begin(), names.end());
  return join_or(names);
}

/// Messages are separated by empty lines and stand in the order of the files' names.
std::vector<std::string> expected_messages() {
  std::string text = read_file(kFolder + "messages.txt");
  for (const std::string tag : {"shape", "bsdf"}) {
    const std::string placeholder = "{" + tag + "s}", listed = listed_in_format(tag);
    for (auto at = text.find(placeholder); at != std::string::npos; at = text.find(placeholder, at))
      text.replace(at, placeholder.size(), listed);
  }
  std::vector<std::string> messages;
  for (std::size_t begin = 0; begin < text.size();) {
    const auto end = std::min(text.find("\n\n", begin), text.size() - 1);
    messages.push_back(text.substr(begin, end - begin));
    begin = end + 2;
  }
  return messages;
}

std::vector<std::string> malformed_files() {
  std::vector<std::string> files;
  for (const auto& entry : fs::directory_iterator(kFolder))
    if (entry.path().extension() == ".xml") files.push_back(entry.path().filename().string());
  std::sort(files.begin(), files.end());
  return files;
}

TEST(malformed_scene, is_refused_with_the_whole_expected_message) {
  const auto files = malformed_files();
  const auto messages = expected_messages();
  ASSERT_GE(files.size(), 20u);
  ASSERT_EQ(files.size(), messages.size()) << "one message a file, in the order of the names";
  for (std::size_t i = 0; i < files.size(); ++i) EXPECT_EQ(message_for(files[i]), messages[i]) << files[i];
}

}  // namespace
}  // namespace photonproof::inline scenes_parser
