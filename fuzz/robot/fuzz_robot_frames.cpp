// Both ends of a robot's serial line: whatever bytes come, in whatever pieces. What was read as a record is written and
// read again as itself; a board whose program hears the bytes goes on, never beyond its voltages, and obeys a kill
// after them.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>

#include "firmware/frames/codec.hpp"
#include "firmware/program.hpp"
#include "require.hpp"

using namespace lapwing;
using namespace lapwing::firmware;

namespace {

template <class Record, class Read>
void require_stable(std::optional<Record> const& record, Read const& read) {
  if (!record) return;
  FrameReader reader;
  bool is_whole = false;
  auto const frame = write(*record, 9);
  for (auto const byte : frame.view()) is_whole = reader.push(byte);
  fuzz::require(is_whole);
  auto const again = read(reader.packet());
  fuzz::require(again.has_value());
  // Quantities may round once, on the way to floating point; then they stay.
  auto const second = write(*again, 9);
  fuzz::require(second.size == frame.size);
}

class Deaf final : public Board {
 public:
  std::span<std::uint8_t const> input;
  float left = 0;
  float right = 0;

  Pulses pulses() override { return {.left = count_ += 3, .right = count_}; }
  std::optional<ImuSample> imu() override { return ImuSample{}; }
  std::span<std::uint16_t const> echoes_us() override { return {}; }
  std::optional<LaserScan> laser() override { return std::nullopt; }
  Battery battery() override { return {}; }
  void drive_wheels(float on_left, float on_right) override {
    left = on_left;
    right = on_right;
  }
  std::size_t receive(std::span<std::uint8_t> into) override {
    auto const count = std::min(into.size(), input.size());
    std::copy_n(input.begin(), count, into.begin());
    input = input.subspan(count);
    return count;
  }
  bool send(std::span<std::uint8_t const>) override { return true; }

 private:
  std::int32_t count_ = 0;
};

void run_program(std::span<std::uint8_t const> input) {
  Description body{.wheel_base_m = 0.24F,
                   .pulses_per_m = 5'000,
                   .top_speed_m_s = 0.3F,
                   .braking_m_s2 = 0.5F,
                   .hull = {},
                   .sonar_count = 0,
                   .sonars = {},
                   .laser = {}};
  Deaf board;
  Program program(board, body);
  board.input = input;
  Time now{};
  do {
    now += std::chrono::milliseconds(10);
    program.step(now);
    fuzz::require(std::abs(board.left) <= 1 && std::abs(board.right) <= 1);
  } while (!board.input.empty());
  // A zero first: the input may have ended in the middle of a frame.
  std::uint8_t const end[] = {0};
  board.input = end;
  program.step(now += std::chrono::milliseconds(10));
  auto const kill = write(FromHost(Kill{}), 0);
  board.input = kill.view();
  program.step(now += std::chrono::milliseconds(10));
  fuzz::require(board.left == 0 && board.right == 0);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  std::span<std::uint8_t const> const input(data, size);
  FrameReader reader;
  for (auto const byte : input) {
    if (!reader.push(byte)) continue;
    require_stable(read_from_board(reader.packet()), read_from_board);
    require_stable(read_from_host(reader.packet()), read_from_host);
  }
  // As if it had been framed: the CRC keeps a fuzzer from what lies behind it.
  if (!input.empty() && input.size() <= longest_payload) {
    Packet const packet{.type = input[0], .sequence = 0, .payload = input.subspan(1)};
    require_stable(read_from_board(packet), read_from_board);
    require_stable(read_from_host(packet), read_from_host);
    auto const frame = write_frame(packet);
    run_program(frame.view());
  }
  run_program(input);
  return 0;
}
