#include "fleet/state/status_text.hpp"

namespace lapwing::fleet {

namespace {

constexpr std::size_t chunk_length = 50;  // STATUSTEXT.text; a shorter chunk is the last one
constexpr base::Duration patience = std::chrono::seconds(2);

}  // namespace

bool StatusTexts::Partial::whole() const {
  std::uint8_t expected = 0;
  for (auto const& [number, text] : chunks)
    if (number != expected++) return false;
  return !chunks.empty() && chunks.rbegin()->second.size() < chunk_length;
}

vehicle::StatusText StatusTexts::Partial::joined() const {
  std::string text;
  int expected = 0;
  for (auto const& [number, chunk] : chunks) {
    if (number != expected) text += "...";
    text += chunk;
    expected = number + 1;
  }
  if (!chunks.empty() && chunks.rbegin()->second.size() == chunk_length) text += "...";
  return {severity, text, last, component};
}

std::vector<vehicle::StatusText> StatusTexts::add(TextChunk const& chunk, base::TimePoint now) {
  if (chunk.id == 0) return {{chunk.severity, chunk.text, now, chunk.component}};
  auto& partial = partial_[{chunk.component, chunk.id}];
  if (partial.is_given_out && now - partial.last < patience) return {};
  if (partial.is_given_out) partial = {};
  partial.severity = chunk.severity;
  partial.component = chunk.component;
  partial.last = now;
  partial.chunks[chunk.number] = chunk.text;
  if (!partial.whole()) return {};
  partial.is_given_out = true;
  return {partial.joined()};
}

std::vector<vehicle::StatusText> StatusTexts::overdue(base::TimePoint now) {
  std::vector<vehicle::StatusText> texts;
  std::erase_if(partial_, [&](auto const& entry) {
    if (now - entry.second.last < patience) return false;
    if (!entry.second.is_given_out) texts.push_back(entry.second.joined());
    return true;
  });
  return texts;
}

}  // namespace lapwing::fleet
