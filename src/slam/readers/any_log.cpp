#include "slam/readers/any_log.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "slam/readers/carmen.hpp"
#include "slam/readers/four_rangers.hpp"
#include "slam/readers/sonar_ring.hpp"
#include "slam/readers/text_lines.hpp"
#include "slam/readers/tof_swarm.hpp"

namespace lapwing::slam {
namespace {

/// How many words a line has, and how many of them are numbers.
struct Shape {
  std::size_t words = 0;
  std::size_t numbers = 0;
};

Shape shape_of(std::string_view line, char separator) {
  Shape shape;
  Words all(line, separator);
  while (!all.next().empty()) ++shape.words;
  Words words(line, separator);
  for (std::size_t i = 0; i < shape.words; ++i) shape.numbers += words.number() ? 1 : 0;
  return shape;
}

std::string_view first_line(std::string_view text) {
  constexpr std::size_t most_comments = 1000;
  Lines lines(text);
  while (auto const line = lines.next()) {
    if (lines.number() > most_comments) break;
    if (!line->empty() && !line->starts_with('#')) return *line;
  }
  return {};
}

/// What packs files, by how they begin, and what unpacks them.
struct Packer {
  std::string_view begins;
  std::string_view name;
  std::string_view undo;
};

Packer const* packer_of(std::string_view text) {
  using namespace std::string_view_literals;
  static constexpr std::array known{Packer{"\x1F\x8B"sv, "gzip", "gzip -dk"},
                                    Packer{"\xFD\x37zXZ\x00"sv, "xz", "xz -dk"}, Packer{"BZh"sv, "bzip2", "bzip2 -dk"},
                                    Packer{"\x28\xB5\x2F\xFD"sv, "zstd", "zstd -dk"},
                                    Packer{"PK\x03\x04"sv, "zip", "unzip"}};
  auto const* found =
      std::ranges::find_if(known, [&](Packer const& packer) { return text.starts_with(packer.begins); });
  return found == known.end() ? nullptr : found;
}

}  // namespace

base::Result<ScanLog> read_log(std::string_view text) {
  if (auto const* packer = packer_of(text))
    return base::fail(base::ErrorKind::invalid_input, fmt::format("a file packed by {}", packer->name),
                      fmt::format("unpack it first: '{} LOG'", packer->undo));
  auto const line = first_line(text);
  if (line.contains(',')) {
    auto const [words, numbers] = shape_of(line, ',');
    if (words == tof_swarm_columns && numbers == words) return read_tof_swarm(text);
    if (words == sonar_ring_columns && numbers + 1 == words) return read_sonar_ring(text);
  }
  auto const [words, numbers] = shape_of(line, ' ');
  if (words == four_rangers_columns && numbers == words) return read_four_rangers(text);
  return read_carmen(text);
}

}  // namespace lapwing::slam
