#include "harness/verbs/render/tev_preview.h"

#include <netdb.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <array>
#include <bit>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <memory>
#include <utility>

#include "scenes/base/input_error.h"
#include "scenes/base/utf8.h"

namespace photonproof::inline harness_verbs_render {
namespace {

constexpr const char *default_host = "127.0.0.1", *default_port = "14158";
constexpr time_t patience = 2;  // seconds
constexpr std::array<const char*, 3> channels{"R", "G", "B"};

enum class Operation : std::uint8_t { create_image = 4, update_image = 6 };

static_assert(std::endian::native == std::endian::little, "packets are little-endian");

/// A packet begins with its length in bytes, which counts itself. Text ends with a zero.
class Packet {
 public:
  explicit Packet(Operation operation) : bytes_(sizeof(std::uint32_t), '\0') { put(operation); }
  template <class T>
  Packet& put(const T& value) {
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
    return *this;
  }
  Packet& text(const std::string& text) {
    bytes_.append(text.c_str(), text.size() + 1);
    return *this;
  }
  Packet& channel_names() {
    put(static_cast<std::int32_t>(channels.size()));
    for (const char* channel : channels) text(channel);
    return *this;
  }
  Packet& floats(const std::vector<float>& values) {
    bytes_.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float));
    return *this;
  }
  std::string bytes() && {
    const auto size = static_cast<std::uint32_t>(bytes_.size());
    std::memcpy(bytes_.data(), &size, sizeof size);
    return std::move(bytes_);
  }

 private:
  std::string bytes_;
};

/// The host and the port of "tev", "tev:PORT" or "tev:HOST:PORT".
std::pair<std::string, std::string> address_of(const std::string& where) {
  const std::string viewer = "tev";
  if (where == viewer) return {default_host, default_port};
  const std::size_t port_at = where.rfind(':');
  if (where.rfind(viewer + ":", 0) != 0 || port_at + 1 == where.size())
    throw InputError("--preview", "'" + where + "' is no viewer, expected tev, tev:PORT or tev:HOST:PORT");
  const std::string host =
      port_at == viewer.size() ? default_host : where.substr(viewer.size() + 1, port_at - viewer.size() - 1);
  return {host, where.substr(port_at + 1)};
}

/// A connected socket, or -1 with errno or the resolver's reason in `why`.
int connected(const std::string& host, const std::string& port, std::string& why) {
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  if (const int code = getaddrinfo(host.c_str(), port.c_str(), &hints, &found); code != 0) {
    why = gai_strerror(code);
    return -1;
  }
  const std::unique_ptr<addrinfo, decltype(&freeaddrinfo)> all(found, freeaddrinfo);
  for (const addrinfo* address = found; address != nullptr; address = address->ai_next) {
    const int made = socket(address->ai_family, address->ai_socktype | SOCK_CLOEXEC, address->ai_protocol);
    if (made < 0) continue;
    const timeval limit{patience, 0};  // of connecting and of every send
    setsockopt(made, SOL_SOCKET, SO_SNDTIMEO, &limit, sizeof limit);
    if (connect(made, address->ai_addr, address->ai_addrlen) == 0) return made;
    why = std::strerror(errno);
    close(made);
  }
  return -1;
}

}  // namespace

TevPreview::TevPreview(const std::string& where, std::string name) : name_(std::move(name)) {
  const auto [host, port] = address_of(where);
  std::string why;
  socket_ = connected(host, port, why);
  if (socket_ < 0)
    throw InputError("--preview", "no tev answers at " + host + ":" + port + ": " + why + "; start tev first");
}

TevPreview::~TevPreview() {
  if (socket_ >= 0) close(socket_);
}

void TevPreview::show(const Image& mean) {
  if (socket_ < 0) return;
  const std::int32_t width = mean.width, height = mean.height;
  constexpr std::uint8_t keeps_focus = 0, grabs_focus = 1;
  if (!created_) {
    created_ = true;
    Packet create(Operation::create_image);
    create.put(grabs_focus).text(name_).put(width).put(height).channel_names();
    if (!send(std::move(create).bytes())) return;
  }
  Packet update(Operation::update_image);
  update.put(keeps_focus).text(name_).channel_names();
  update.put(std::int32_t{0}).put(std::int32_t{0}).put(width).put(height);
  for (std::int64_t channel = 0; channel < std::ssize(channels); ++channel)
    update.put(channel);  // the first value of each
  for (std::size_t channel = 0; channel < channels.size(); ++channel) update.put(std::int64_t{std::ssize(channels)});
  send(std::move(update.floats(mean.rgb)).bytes());
}

bool TevPreview::send(const std::string& packet) {
  for (std::size_t sent = 0; sent < packet.size();) {
    const ssize_t part = ::send(socket_, packet.data() + sent, packet.size() - sent, MSG_NOSIGNAL);
    if (part < 0 && errno == EINTR) continue;
    if (part > 0) {
      sent += static_cast<std::size_t>(part);
      continue;
    }
    std::fprintf(stderr, "--preview: warning: tev takes no more of %s, which is rendered without it\n",
                 printable(name_).c_str());
    close(socket_);
    socket_ = -1;
    return false;
  }
  return true;
}

}  // namespace photonproof::inline harness_verbs_render
