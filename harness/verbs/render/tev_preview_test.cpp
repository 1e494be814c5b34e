// --preview against a viewer that this test plays. It reads packets by the layout of tev's include/tev/Ipc.h:
// each begins with its length, and an update names the offset and the stride of every channel.

#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <thread>
#include <vector>

#include "harness/cells/test_program.h"
#include "scenes/base/process.h"
#include "scenes/files/test_folder.h"
#include "scenes/images/image.h"
#include "scenes/images/image_file.h"

namespace photonproof::inline harness_verbs_render {
namespace {

/// The packets about one image, as the viewer understood them.
struct Shown {
  std::string name;
  std::int32_t width = 0, height = 0;
  std::vector<std::string> channels;
  std::vector<std::vector<float>> updates;  ///< interleaved, row by row
  bool focus = false;
  bool understood = true;
};

/// Listens at a free port of this machine until the first client leaves, or `packets` came.
class Viewer {
 public:
  explicit Viewer(std::size_t packets = 1'000'000) : listening_(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    auto* generic = reinterpret_cast<sockaddr*>(&address);
    EXPECT_EQ(bind(listening_, generic, size), 0);
    EXPECT_EQ(listen(listening_, 1), 0);
    EXPECT_EQ(getsockname(listening_, generic, &size), 0);
    port_ = ntohs(address.sin_port);
    thread_ = std::thread([this, packets] {
      client_ = accept(listening_, nullptr, nullptr);
      for (std::size_t i = 0; i < packets && read_packet(); ++i) {
      }
      close(client_);
    });
  }
  ~Viewer() {
    shutdown(listening_, SHUT_RDWR);
    if (thread_.joinable()) thread_.join();
    close(listening_);
  }
  Viewer(const Viewer&) = delete;
  Viewer& operator=(const Viewer&) = delete;

  std::string option() const { return "tev:" + std::to_string(port_); }
  const Shown& ended() {
    thread_.join();
    return shown_;
  }

 private:
  bool read(void* to, std::size_t size) const {
    for (std::size_t got = 0; got < size;) {
      const ssize_t part = recv(client_, static_cast<char*>(to) + got, size - got, 0);
      if (part <= 0) return false;
      got += static_cast<std::size_t>(part);
    }
    return true;
  }
  template <class T>
  T take() {
    T value{};
    if (at_ + sizeof value > packet_.size()) return shown_.understood = false, value;
    std::memcpy(&value, packet_.data() + at_, sizeof value);
    at_ += sizeof value;
    return value;
  }
  std::string take_text() {
    const std::string text(packet_.data() + at_);
    at_ += text.size() + 1;
    return text;
  }
  std::vector<std::string> take_channels() {
    std::vector<std::string> names(static_cast<std::size_t>(take<std::int32_t>()));
    for (std::string& name : names) name = take_text();
    return names;
  }

  bool read_packet() {
    std::uint32_t size = 0;
    if (!read(&size, sizeof size)) return false;
    packet_.assign(size - sizeof size, '\0');
    if (!read(packet_.data(), packet_.size())) return false;
    at_ = 0;
    const auto operation = take<std::uint8_t>();
    const bool focus = take<std::uint8_t>() != 0;
    const std::string name = take_text();
    if (operation == 4) {
      shown_.name = name;
      shown_.focus = focus;
      shown_.width = take<std::int32_t>();
      shown_.height = take<std::int32_t>();
      shown_.channels = take_channels();
    } else {
      read_update(operation == 6 && !focus && name == shown_.name);
    }
    shown_.understood &= at_ == packet_.size();
    return true;
  }

  void read_update(bool expected) {
    const std::vector<std::string> channels = take_channels();
    const auto x = take<std::int32_t>(), y = take<std::int32_t>();
    const auto width = take<std::int32_t>(), height = take<std::int32_t>();
    std::vector<std::int64_t> offsets, strides;
    for (std::size_t i = 0; i < channels.size(); ++i) offsets.push_back(take<std::int64_t>());
    for (std::size_t i = 0; i < channels.size(); ++i) strides.push_back(take<std::int64_t>());
    shown_.understood &=
        expected && channels == shown_.channels && x == 0 && y == 0 && width == shown_.width && height == shown_.height;
    const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    std::vector<float> data((packet_.size() - at_) / sizeof(float)), image(3 * pixels);
    for (float& value : data) value = take<float>();
    for (std::size_t pixel = 0; pixel < pixels; ++pixel)
      for (std::size_t c = 0; c < channels.size(); ++c)
        image[3 * pixel + c] =
            data.at(static_cast<std::size_t>(offsets[c] + static_cast<std::int64_t>(pixel) * strides[c]));
    shown_.updates.push_back(std::move(image));
  }

  int listening_, client_ = -1;
  unsigned port_ = 0;
  std::string packet_;
  std::size_t at_ = 0;
  Shown shown_;
  std::thread thread_;
};

class Preview : public FolderTest {
 protected:
  ProcessOutcome render(const std::string& preview, const std::vector<std::string>& more) const {
    std::vector<std::string> argv{PHOTONPROOF_BINARY,
                                  "render",
                                  PHOTONPROOF_SOURCE_DIR "/scenes/library/cornell/scene.xml",
                                  "-o",
                                  (folder_ / "image.exr").string(),
                                  "--preview",
                                  preview,
                                  "--quiet"};
    argv.insert(argv.end(), more.begin(), more.end());
    return run_process(argv, {.wall_limit_seconds = 120});
  }
  double phase_seconds() const {
    const std::string stats = get("image.stats.json"), name = "\"preview\": ";
    const std::size_t at = stats.find(name);
    return at == std::string::npos ? 0 : std::stod(stats.substr(at + name.size()));
  }
};

// A second and a half of rendering makes a preview. The last one is the image that is stored, to the bit.
TEST_F(Preview, shows_the_image_while_it_is_made_and_at_last_as_it_is_stored) {
  for (const char* integrator : {"path", "bdpt"}) {
    Viewer viewer;
    const ProcessOutcome outcome =
        render(viewer.option(), {"--integrator", integrator, "--size", "24x40", "--seconds", "1.5", "--threads", "1"});
    ASSERT_TRUE(outcome.ok()) << outcome.standard_error;
    const Shown& shown = viewer.ended();
    EXPECT_TRUE(shown.understood) << integrator;
    EXPECT_TRUE(shown.focus);
    EXPECT_EQ(shown.name, (folder_ / "image.exr").string());
    EXPECT_EQ(shown.channels, (std::vector<std::string>{"R", "G", "B"}));
    const Image image = read_image((folder_ / "image.exr").string());
    ASSERT_GE(shown.updates.size(), 2u) << integrator;
    EXPECT_EQ(shown.width, image.width);
    EXPECT_EQ(shown.height, image.height);
    EXPECT_EQ(shown.updates.back(), image.rgb) << integrator;
    EXPECT_NE(shown.updates.front(), image.rgb) << integrator;
    EXPECT_GT(phase_seconds(), 0) << integrator;
  }
}

// Renders of the same seed have the same bits with and without a viewer.
TEST_F(Preview, does_not_change_the_image) {
  Viewer viewer;
  ASSERT_TRUE(render(viewer.option(), {"--size", "64x64", "--spp", "512"}).ok());
  viewer.ended();
  const Image with = read_image((folder_ / "image.exr").string());
  const ProcessOutcome without =
      run_process({PHOTONPROOF_BINARY, "render", PHOTONPROOF_SOURCE_DIR "/scenes/library/cornell/scene.xml", "-o",
                   (folder_ / "alone.exr").string(), "--size", "64x64", "--spp", "512", "--quiet"});
  ASSERT_TRUE(without.ok());
  EXPECT_EQ(with.rgb, read_image((folder_ / "alone.exr").string()).rgb);
}

TEST_F(Preview, of_a_viewer_that_is_closed_is_given_up_with_a_warning) {
  Viewer viewer(2);  // it leaves after the first update
  const ProcessOutcome outcome = render(viewer.option(), {"--size", "64x64", "--seconds", "2.5", "--threads", "1"});
  EXPECT_TRUE(outcome.ok());
  EXPECT_TRUE(has("image.exr"));
  EXPECT_NE(outcome.standard_error.find("--preview: warning: tev takes no more of "), std::string::npos)
      << outcome.standard_error;
}

TEST_F(Preview, without_a_viewer_is_an_error_and_no_image) {
  const std::vector<std::array<std::string, 2>> wrong = {
      {"tev:1", "--preview: error: no tev answers at 127.0.0.1:1: Connection refused; start tev first\n"},
      {"tev:no.such.host.invalid:14158", "--preview: error: no tev answers at no.such.host.invalid:14158: "},
      {"tev:", "--preview: error: 'tev:' is no viewer, expected tev, tev:PORT or tev:HOST:PORT\n"},
      {"mtsgui", "--preview: error: 'mtsgui' is no viewer, expected tev, tev:PORT or tev:HOST:PORT\n"}};
  for (const auto& [where, message] : wrong) {
    const ProcessOutcome outcome = render(where, {"--spp", "1", "--size", "8x8"});
    EXPECT_EQ(outcome.exit_code, 2) << where;
    EXPECT_EQ(outcome.standard_error.substr(0, message.size()), message) << where;
    EXPECT_FALSE(has("image.exr"));
  }
}

}  // namespace
}  // namespace photonproof::inline harness_verbs_render
