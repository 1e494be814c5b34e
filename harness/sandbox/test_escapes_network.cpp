// Sockets: the grader listens for anything that leaves the sandbox.
#include <arpa/inet.h>
#include <linux/netlink.h>
#include <linux/rtnetlink.h>
#include <net/if.h>
#include <netdb.h>
#include <netinet/in.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "harness/sandbox/test_escapes.h"

namespace photonproof::escapes {
namespace {

template <class Address>
bool reaches(int family, int type, const Address& address, std::size_t length = sizeof(Address)) {
  const int descriptor = socket(family, type, 0);
  if (descriptor < 0) return false;
  const bool sent =
      connect(descriptor, reinterpret_cast<const sockaddr*>(&address), static_cast<socklen_t>(length)) == 0 &&
      send(descriptor, token, std::strlen(token), MSG_NOSIGNAL) > 0;
  close(descriptor);
  return sent;
}

sockaddr_in ipv4(int port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  return address;
}

void ask_name_server(const Target&) {
  addrinfo* found = nullptr;
  escaped_if(getaddrinfo("deb.debian.org", "80", nullptr, &found) == 0, "a name was resolved");
  // Without a route nothing leaves. With one, connecting a datagram socket already shows it, without sending.
  sockaddr_in server{};
  server.sin_family = AF_INET;
  server.sin_port = htons(53);
  inet_pton(AF_INET, "192.0.2.1", &server.sin_addr);
  const int descriptor = socket(AF_INET, SOCK_DGRAM, 0);
  escaped_if(connect(descriptor, reinterpret_cast<const sockaddr*>(&server), sizeof server) == 0, "there is a route");
}

void list_interfaces(const Target&) {
  for (int index = 1; index < 64; ++index) {
    char name[IF_NAMESIZE] = {};
    if (if_indextoname(static_cast<unsigned>(index), name) != nullptr && std::string(name) != "lo")
      escaped("sees the interface " + std::string(name));
  }
}

void talk_to_abstract_socket(const Target& t) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::memcpy(address.sun_path + 1, t.abstract.data(), t.abstract.size());
  escaped_if(reaches(AF_UNIX, SOCK_STREAM, address, offsetof(sockaddr_un, sun_path) + 1 + t.abstract.size()),
             "talks to an abstract socket");
}

void talk_to_socket_file(const Target& t) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::strncpy(address.sun_path, (t.folder + "/socket").c_str(), sizeof address.sun_path - 1);
  escaped_if(reaches(AF_UNIX, SOCK_STREAM, address), "talks to a socket file");
}

void talk_by_ipv6(const Target& t) {
  sockaddr_in6 address{};
  address.sin6_family = AF_INET6;
  address.sin6_port = htons(static_cast<std::uint16_t>(t.port));
  address.sin6_addr = in6addr_loopback;
  escaped_if(reaches(AF_INET6, SOCK_STREAM, address), "talks by TCP over IPv6");
}

constexpr Attempt rows[] = {
    {"talk_by_tcp", [](const Target& t) { escaped_if(reaches(AF_INET, SOCK_STREAM, ipv4(t.port)), "talks by TCP"); }},
    {"talk_by_ipv6", talk_by_ipv6},
    {"talk_to_an_abstract_socket", talk_to_abstract_socket},
    {"talk_to_a_socket_file", talk_to_socket_file},
    {"ask_a_name_server", ask_name_server},
    {"list_network_interfaces", list_interfaces},
    {"open_sockets_of_other_families",
     [](const Target&) {
       // AF_VSOCK reaches this guest's host and ignores network namespaces; AF_ALG, AF_PACKET
       for (const int family : {40, 38, 17})
         escaped_if(socket(family, SOCK_STREAM, 0) >= 0 || socket(family, SOCK_SEQPACKET, 0) >= 0 ||
                        socket(family, SOCK_RAW, 0) >= 0,
                    "socket of family " + std::to_string(family));
     }},
    {"open_a_raw_socket",
     [](const Target&) { escaped_if(socket(AF_INET, SOCK_RAW, IPPROTO_ICMP) >= 0, "has a raw socket"); }},
};

}  // namespace

std::span<const Attempt> network_attempts() { return rows; }

}  // namespace photonproof::escapes
