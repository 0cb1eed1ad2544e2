#include "slam/readers/any_log.hpp"

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

}  // namespace

base::Result<ScanLog> read_log(std::string_view text) {
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
