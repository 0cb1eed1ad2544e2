// The seed's text messages, from a stream in pieces: what was read as a line is written and read again as itself, and
// so is what it says. What it has a robot do is said or refused with a reason.
#include <algorithm>
#include <cstdint>
#include <span>
#include <string>

#include "require.hpp"
#include "robot/old_parts/order.hpp"
#include "robot/seed_text/line.hpp"
#include "robot/seed_text/payload.hpp"

using namespace lapwing;
using namespace lapwing::robot::seed_text;

namespace {

void require_stable(Line const& line) {
  auto const payload = read_payload(line);
  if (!payload) {
    fuzz::require(!payload.error().message.empty());
    return;
  }
  auto const text = write(*payload);
  fuzz::require(text.has_value());
  auto again = line;
  again.message = *text;
  auto const second = read_payload(again);
  fuzz::require(second.has_value() && second->index() == payload->index());
  fuzz::require(write(*second) == *text);
}

void read_line(std::string_view text) {
  auto const heard = robot::heard_in(text);
  fuzz::require(heard || !heard.error().message.empty());
  auto const line = read(text);
  if (!line) {
    fuzz::require(!line.error().message.empty());
    return;
  }
  if (auto const written = write(*line)) {
    fuzz::require(written->size() <= longest_line + 1 && written->find('\n') == written->size() - 1);
    fuzz::require(read(std::string_view(*written).substr(0, written->size() - 1)) == *line);
  }
  require_stable(*line);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  std::span<std::uint8_t const> input(data, size);
  if (input.empty()) return 0;
  std::size_t const piece = 1U + input.front();
  input = input.subspan(1);
  LineReader reader;
  while (!input.empty()) {
    auto const length = std::min(piece, input.size());
    reader.feed(input.first(length), read_line);
    input = input.subspan(length);
  }
  return 0;
}
