// MAVLink decode rate, beside the C library on the same bytes. The capture is what a vehicle at 10 Hz sends, seeded.

#include <fstream>
#include <random>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "decode_c_library.hpp"
#include "mavlink/codec/codec.hpp"
#include "mavlink/wire/frame.hpp"

namespace lapwing::bench {
namespace {

using mavlink::Message;

std::vector<std::uint8_t> const& capture() {
  static auto const bytes = [] {
    std::mt19937 random(42);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    std::vector<std::uint8_t> all;
    std::uint8_t seq = 0;
    for (int second = 0; second < 200; ++second) {
      for (int i = 0; i < 10; ++i) {
        mavlink::GlobalPosition position;
        position.position = geo::Wgs84::from_degrees(41.178 + unit(random) * 1e-3, -8.598 + unit(random) * 1e-3, 120.0);
        position.relative_alt_m = 0.0;
        position.velocity_m_s = geo::Ned{};
        mavlink::Attitude attitude{.roll_rad = 0.0,
                                   .pitch_rad = 0.0,
                                   .yaw_rad = unit(random) * 3.0,
                                   .roll_rate_rad_s = 0.0,
                                   .pitch_rate_rad_s = 0.0,
                                   .yaw_rate_rad_s = 0.0};
        mavlink::VfrHud const hud{.airspeed_m_s = 0.0,
                                  .ground_speed_m_s = 5.0 + unit(random),
                                  .heading_rad = 0.0,
                                  .throttle = 0.0,
                                  .alt_m = 0.0,
                                  .climb_m_s = 0.0};
        std::vector<Message> messages{position, attitude, hud};
        if (i % 5 == 0) {
          messages.push_back(mavlink::SysStatus{.load = 0.0, .drop_rate_comm = 0.0});
          messages.push_back(mavlink::GpsRaw{.position = geo::Wgs84{}});
        }
        if (i == 0) messages.push_back(mavlink::Heartbeat{});
        for (auto const& message : messages) {
          auto const frame = mavlink::serialize(mavlink::encode(message, {1, 1}, seq++));
          all.insert(all.end(), frame.bytes().begin(), frame.bytes().end());
        }
      }
    }
    return all;
  }();
  return bytes;
}

void set_rate(benchmark::State& state, std::size_t frames) {
  state.SetItemsProcessed(static_cast<std::int64_t>(frames));
  state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations()) * static_cast<std::int64_t>(capture().size()));
}

void c_library(benchmark::State& state, bool decode_fields) {
  std::size_t frames = 0;
  for ([[maybe_unused]] auto _ : state) {
    auto const parsed = parse_with_c_library(capture(), decode_fields);
    frames += parsed.frames;
    benchmark::DoNotOptimize(parsed.checksum);
  }
  set_rate(state, frames);
}

void ours(benchmark::State& state, bool decode_fields) {
  std::size_t frames = 0;
  mavlink::FrameParser parser;
  for ([[maybe_unused]] auto _ : state) {
    parser.feed(capture(), [&](mavlink::Frame const& frame) {
      ++frames;
      if (!decode_fields) return;
      auto const message = mavlink::decode(frame);
      benchmark::DoNotOptimize(message);
    });
  }
  set_rate(state, frames);
}

BENCHMARK_CAPTURE(ours, frames, false);
BENCHMARK_CAPTURE(c_library, frames, false);
BENCHMARK_CAPTURE(ours, frames_and_fields, true);
BENCHMARK_CAPTURE(c_library, frames_and_fields, true);

}  // namespace
}  // namespace lapwing::bench

int main(int argc, char** argv) {
  // --capture=FILE writes the bytes, so that a peer in another language can parse the same.
  for (int i = 1; i < argc; ++i) {
    std::string const argument = argv[i];
    if (argument.rfind("--capture=", 0) != 0) continue;
    auto const& bytes = lapwing::bench::capture();
    std::ofstream(argument.substr(10), std::ios::binary)
        .write(reinterpret_cast<char const*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    return 0;
  }
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
