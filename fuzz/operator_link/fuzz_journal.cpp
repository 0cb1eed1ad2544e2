// A journal's folder in which anything may stand: recovery reads what is whole, cuts off what is not, and goes on; what
// it then takes is there when it is opened again. An input is files: a byte with the number of records (zero: raw bytes
// follow), and each of them after a byte with its length.
#include <cstdint>
#include <string>

#include <fmt/format.h>

#include "link/operator_link/journal/journal.hpp"
#include "link/operator_link/testing/memory_disk.hpp"
#include "link/operator_link/wire/byte_order.hpp"
#include "require.hpp"

using namespace lapwing;
using namespace lapwing::link::operator_link;

namespace {

std::unique_ptr<Journal> open(base::Loop& loop, testing::Platter& platter) {
  auto journal =
      Journal::open(std::make_unique<testing::MemoryDisk>(loop, platter), {.bytes = 100'000, .segment_bytes = 200}, 7);
  fuzz::require(journal.has_value());
  return *std::move(journal);
}

link::Bytes take(link::Bytes& input) {
  if (input.empty()) return {};
  auto const size = std::min<std::size_t>(input[0], input.size() - 1);
  auto const piece = input.subspan(1, size);
  input = input.subspan(1 + size);
  return piece;
}

std::vector<std::uint8_t> raw(link::Bytes& input) {
  auto const bytes = take(input);
  return {bytes.begin(), bytes.end()};
}

/// With the CRCs that belong to them.
std::vector<std::uint8_t> of_records(link::Bytes& input, std::size_t count) {
  std::vector<std::uint8_t> file;
  ByteWriter writer(file);
  writer.bytes("LWjrnl1\n");
  for (std::size_t i = 0; i < count; ++i) {
    auto const body = take(input);
    writer.number(static_cast<std::uint32_t>(body.size()));
    writer.number(crc32(body));
    file.insert(file.end(), body.begin(), body.end());
  }
  return file;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  base::Loop loop({.unpaced = true});
  testing::Platter platter;
  link::Bytes input(data, size);
  for (int file = 1; input.size() > 1; ++file) {
    auto const records = std::size_t{input[0]} % 16;
    input = input.subspan(1);
    platter.files[fmt::format("{:016x}.segment", file)] = records == 0 ? raw(input) : of_records(input, records);
  }
  auto journal = open(loop, platter);
  std::uint64_t read = 0;
  for (auto next = journal->first();;) {
    auto const entry = journal->read(next);
    if (!entry || !*entry || ++read > 10'000) break;
    fuzz::require((*entry)->number >= next);
    if ((*entry)->number == UINT64_MAX) return 0;
    next = (*entry)->number + 1;
  }
  auto const number = journal->append("key", "text");
  if (!number) return 0;
  journal = open(loop, platter);
  auto const again = journal->read(*number);
  fuzz::require(again && *again && (*again)->text == "text");
  return 0;
}
