#include "base/text/printable.hpp"

namespace lapwing::base {

std::string printable(std::string text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    auto const byte = static_cast<unsigned char>(text[i]);
    auto const next = i + 1 < text.size() ? static_cast<unsigned char>(text[i + 1]) : 0U;
    if (byte < 0x20U || byte == 0x7FU) text[i] = '?';
    if (byte == 0xC2U && next >= 0x80U && next <= 0x9FU) text.replace(i, 2, "?");
  }
  return text;
}

}  // namespace lapwing::base
