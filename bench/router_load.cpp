// Load and measure for the router's benchmark (router.py): sends MAVLink at a rate to one UDP port, receives on others
// what comes out, and prints as JSON what was lost and how late the rest was.
//
// usage: bench_router_load SEND_PORT SINK_PORT[,SINK_PORT...] RATE SECONDS
//
// Every message is a GLOBAL_POSITION_INT of one of 50 systems with a running number and the time of sending in its
// fields.
#include <arpa/inet.h>
#include <linux/sock_diag.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "mavlink/wire/frame.hpp"

namespace lapwing::bench {
namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

constexpr std::size_t batch = 64;
constexpr std::uint32_t position_id = 33;
constexpr unsigned systems = 50;
constexpr auto warm_up = 500ms;

/// In the payload, little endian as the wire is.
struct Stamp {
  std::uint32_t number;  ///< time_boot_ms
  std::uint32_t low_ns;  ///< lat
  std::uint32_t high_ns;
};

std::uint64_t now_ns() {
  return static_cast<std::uint64_t>(Clock::now().time_since_epoch().count());
}

[[noreturn]] void die(char const* what) {
  std::perror(what);
  std::exit(1);
}

int open_socket(int port, bool listens) {
  int const fd = ::socket(AF_INET, SOCK_DGRAM, 0);
  if (fd < 0) die("socket");
  int const size = 32 * 1024 * 1024;
  if (::setsockopt(fd, SOL_SOCKET, SO_RCVBUFFORCE, &size, sizeof(size)) != 0)
    ::setsockopt(fd, SOL_SOCKET, SO_RCVBUF, &size, sizeof(size));
  timeval const patience{.tv_sec = 0, .tv_usec = 100'000};
  ::setsockopt(fd, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof(patience));
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  auto const* generic = reinterpret_cast<sockaddr const*>(&address);
  if ((listens ? ::bind(fd, generic, sizeof(address)) : ::connect(fd, generic, sizeof(address))) != 0) die("socket");
  return fd;
}

/// Datagrams of one system call, each with room for a packet or several.
struct Batch {
  std::array<std::array<std::uint8_t, 2048>, batch> room;
  std::array<iovec, batch> pieces;
  std::array<mmsghdr, batch> headers{};
  Batch() {
    for (std::size_t i = 0; i < batch; ++i) {
      pieces[i] = {room[i].data(), room[i].size()};
      headers[i].msg_hdr.msg_iov = &pieces[i];
      headers[i].msg_hdr.msg_iovlen = 1;
    }
  }
};

// ---- sending

void put(Batch& out, std::size_t place, std::uint32_t number) {
  mavlink::Frame frame;
  frame.source = {static_cast<std::uint8_t>(1 + number % systems), 1};
  frame.seq = static_cast<std::uint8_t>(number / systems);
  frame.message_id = position_id;
  frame.payload_size = 28;
  auto const time = now_ns();
  Stamp const stamp{number, static_cast<std::uint32_t>(time), static_cast<std::uint32_t>(time >> 32U)};
  std::memcpy(frame.payload.data(), &stamp, sizeof(stamp));
  frame.payload[27] = 1;  // not trimmed: all are of one size
  auto const packet = mavlink::serialize(frame);
  std::ranges::copy(packet.bytes(), out.room[place].begin());
  out.pieces[place].iov_len = packet.bytes().size();
}

/// What is due each time that it wakes, evenly at the rate. Returns how many were sent.
std::uint32_t send_at_rate(int fd, double rate, Clock::duration time) {
  static Batch out;
  auto const begin = Clock::now();
  std::uint32_t sent = 0;
  auto const total = static_cast<std::uint32_t>(rate * std::chrono::duration<double>(time).count());
  while (sent < total) {
    auto const elapsed = std::chrono::duration<double>(Clock::now() - begin).count();
    auto const due = std::min(total, static_cast<std::uint32_t>(elapsed * rate) + 1);
    while (sent < due) {
      auto const count = std::min<std::size_t>(batch, due - sent);
      for (std::size_t i = 0; i < count; ++i) put(out, i, sent + static_cast<std::uint32_t>(i));
      int const done = ::sendmmsg(fd, out.headers.data(), static_cast<unsigned>(count), 0);
      // Refused: whoever routes has not opened its port, which router.py waits for.
      if (done <= 0) die("sendmmsg");
      sent += static_cast<std::uint32_t>(done);
    }
    std::this_thread::sleep_until(begin + std::chrono::duration_cast<Clock::duration>(
                                              std::chrono::duration<double>(static_cast<double>(sent) / rate)));
  }
  return sent;
}

// ---- receiving

struct Sink {
  int fd = -1;
  std::vector<std::uint8_t> seen;  ///< by number, how often
  std::vector<std::uint32_t> late_ns;
  std::uint64_t received = 0;
  std::uint64_t duplicates = 0;
};

void note(Sink& sink, mavlink::FrameView const& frame, std::uint64_t time, std::uint32_t first) {
  if (frame.message_id != position_id || frame.payload.size() < sizeof(Stamp)) return;
  Stamp stamp{};
  std::memcpy(&stamp, frame.payload.data(), sizeof(stamp));
  if (stamp.number < first || stamp.number >= sink.seen.size()) return;
  if (sink.seen[stamp.number]++ > 0) {
    ++sink.duplicates;
    return;
  }
  ++sink.received;
  auto const late = time - (static_cast<std::uint64_t>(stamp.high_ns) << 32U | stamp.low_ns);
  sink.late_ns.push_back(static_cast<std::uint32_t>(std::min<std::uint64_t>(late, 0xFFFFFFFFU)));
}

void receive(Sink& sink, std::uint32_t first, std::atomic<bool> const& is_over) {
  auto const in = std::make_unique<Batch>();
  mavlink::FrameParser parser;
  for (;;) {
    int const count = ::recvmmsg(sink.fd, in->headers.data(), batch, MSG_WAITFORONE, nullptr);
    if (count <= 0 && is_over) return;
    auto const time = now_ns();
    for (std::size_t i = 0; i < static_cast<std::size_t>(std::max(count, 0)); ++i) {
      parser.feed_views({in->room[i].data(), in->headers[i].msg_len},
                        [&](mavlink::FrameView const& frame) { note(sink, frame, time, first); });
    }
  }
}

std::uint64_t overruns(int fd) {
  std::array<std::uint32_t, SK_MEMINFO_VARS> memory{};
  socklen_t size = sizeof(memory);
  return ::getsockopt(fd, SOL_SOCKET, SO_MEMINFO, memory.data(), &size) == 0 ? memory[SK_MEMINFO_DROPS] : 0;
}

double percentile_us(std::vector<std::uint32_t>& sorted, double share) {
  if (sorted.empty()) return 0.0;
  return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))] / 1000.0;
}

void print(std::vector<Sink>& sinks, std::uint64_t sent) {
  std::uint64_t received = 0;
  std::uint64_t duplicates = 0;
  std::uint64_t overrun = 0;
  std::vector<std::uint32_t> late;
  for (auto const& sink : sinks) {
    received += sink.received;
    duplicates += sink.duplicates;
    overrun += overruns(sink.fd);
    late.insert(late.end(), sink.late_ns.begin(), sink.late_ns.end());
  }
  std::ranges::sort(late);
  std::printf(
      "{\"sent\": %llu, \"expected\": %llu, \"received\": %llu, \"duplicates\": %llu, \"sink_overruns\": %llu, "
      "\"p50_us\": %.1f, \"p90_us\": %.1f, \"p99_us\": %.1f, \"p999_us\": %.1f, \"max_us\": %.1f}\n",
      static_cast<unsigned long long>(sent), static_cast<unsigned long long>(sent) * sinks.size(),
      static_cast<unsigned long long>(received), static_cast<unsigned long long>(duplicates),
      static_cast<unsigned long long>(overrun), percentile_us(late, 0.5), percentile_us(late, 0.9),
      percentile_us(late, 0.99), percentile_us(late, 0.999), percentile_us(late, 1.0));
}

int measure(int send_port, std::vector<int> const& sink_ports, double rate, double seconds) {
  auto const time = warm_up + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
  auto const total = static_cast<std::size_t>(rate * std::chrono::duration<double>(time).count());
  auto const first = static_cast<std::uint32_t>(rate * std::chrono::duration<double>(warm_up).count());
  std::vector<Sink> sinks(sink_ports.size());
  std::vector<std::thread> threads;
  std::atomic<bool> is_over = false;
  for (std::size_t i = 0; i < sinks.size(); ++i) {
    sinks[i].fd = open_socket(sink_ports[i], true);
    sinks[i].seen.resize(total);
    sinks[i].late_ns.reserve(total);
    threads.emplace_back([&, i] { receive(sinks[i], first, is_over); });
  }
  auto const sent = send_at_rate(open_socket(send_port, false), rate, time);
  std::this_thread::sleep_for(300ms);  // what is on its way
  is_over = true;
  for (auto& thread : threads) thread.join();
  print(sinks, sent - first);
  return 0;
}

}  // namespace
}  // namespace lapwing::bench

int main(int argc, char** argv) {
  if (argc != 5) {
    std::fprintf(stderr, "usage: bench_router_load SEND_PORT SINK_PORT[,SINK_PORT...] RATE SECONDS\n");
    return 2;
  }
  std::vector<int> sinks;
  std::istringstream ports(argv[2]);
  for (std::string port; std::getline(ports, port, ',');) sinks.push_back(std::atoi(port.c_str()));
  return lapwing::bench::measure(std::atoi(argv[1]), sinks, std::atof(argv[3]), std::atof(argv[4]));
}
