#include "host/station/web_access.hpp"

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <netinet/in.h>
#include <unistd.h>
#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <memory>

#include <fmt/format.h>

#include "host/files/secret_file.hpp"
#include "station/http/access.hpp"

namespace lapwing::host {

namespace {

constexpr std::size_t shortest_token = 16;  ///< below, it can be guessed over a network
constexpr std::size_t longest_token = 256;

/// These stand in an address and a header as they are.
bool is_token_character(unsigned char c) {
  return std::isalnum(c) || c == '-' || c == '_' || c == '.' || c == '~';
}

bool is_wildcard(std::string const& address) {
  return address == "0.0.0.0" || address == "::";
}

/// IPv4 addresses of this machine that others can reach.
std::vector<std::string> own_addresses() {
  std::vector<std::string> addresses;
  ifaddrs* first = nullptr;
  if (::getifaddrs(&first) != 0) return addresses;
  std::unique_ptr<ifaddrs, decltype(&::freeifaddrs)> const owner(first, &::freeifaddrs);
  for (auto const* each = first; each; each = each->ifa_next) {
    if (!each->ifa_addr || each->ifa_addr->sa_family != AF_INET || (each->ifa_flags & IFF_LOOPBACK)) continue;
    std::array<char, INET_ADDRSTRLEN> text{};
    sockaddr_in address{};
    std::memcpy(&address, each->ifa_addr, sizeof address);
    if (::inet_ntop(AF_INET, &address.sin_addr, text.data(), text.size())) addresses.emplace_back(text.data());
  }
  return addresses;
}

}  // namespace

void add_web_options(CLI::App& verb, WebArguments& arguments) {
  verb.add_option("--bind", arguments.bind,
                  "Address to serve the map on; beyond loopback (0.0.0.0: everywhere) it needs a token");
  verb.add_option("--port", arguments.port, "TCP port of the map, 0: a free one (default 8080)")
      ->check(CLI::Range(0, 65535));
  auto* file = verb.add_option("--token-file", arguments.token_file, "File (mode 0600) with the token browsers need");
  verb.add_flag("--generate-token", arguments.generate_token, "Make up a token and show it once, in the map's address")
      ->excludes(file);
}

void apply(WebArguments const& arguments, WebAccess& access) {
  if (arguments.bind) access.bind = *arguments.bind;
  if (arguments.port) access.port = *arguments.port;
  if (arguments.token_file) {
    access.token_file = *arguments.token_file;
    access.generate_token = false;
  }
  if (arguments.generate_token) {
    access.token_file.clear();
    access.generate_token = true;
  }
}

base::Result<std::string> token_for(WebAccess const& access) {
  if (!access.token_file.empty()) return read_token(access.token_file);
  if (access.generate_token) return new_token();
  if (station::is_loopback_name(access.bind)) return std::string();
  return base::fail(
      base::ErrorKind::invalid_input,
      fmt::format("serving the map on {} lets everybody on that network command the vehicles", access.bind),
      "add --generate-token (shown once, in the map's address) or --token-file FILE");
}

base::Result<std::string> read_token(std::string const& path) {
  auto token = read_secret({path, "token file", fmt::format("make one: (umask 077; openssl rand -hex 24 > {})", path)});
  if (!token) return token;
  if (token->size() < shortest_token || token->size() > longest_token ||
      !std::ranges::all_of(*token, is_token_character)) {
    return base::fail(base::ErrorKind::invalid_input,
                      fmt::format("token file {}: a token is one word of {} to {} letters, digits, - _ . or ~", path,
                                  shortest_token, longest_token),
                      fmt::format("make one: (umask 077; openssl rand -hex 24 > {})", path));
  }
  return token;
}

std::string new_token() {
  std::array<std::uint8_t, 24> bytes{};
  // Asking for less than 256 bytes cannot fail on a running Linux.
  if (::getentropy(bytes.data(), bytes.size()) != 0) std::abort();
  std::string token;
  for (auto const byte : bytes) token += fmt::format("{:02x}", byte);
  return token;
}

std::vector<std::string> map_addresses(std::string const& bind, int port, std::string const& token) {
  auto hosts = is_wildcard(bind) ? own_addresses() : std::vector{bind};
  if (is_wildcard(bind)) hosts.emplace_back("127.0.0.1");
  std::vector<std::string> addresses;
  for (auto const& host : hosts) {
    bool const is_v6 = host.contains(':');
    addresses.push_back(fmt::format("http://{}{}{}:{}/{}{}", is_v6 ? "[" : "", host, is_v6 ? "]" : "", port,
                                    token.empty() ? "" : "#token=", token));
  }
  return addresses;
}

}  // namespace lapwing::host
