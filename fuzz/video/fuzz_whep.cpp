// What strangers offer (SDP) and what answers a station that offers for them: whatever the bytes, an offer or a
// message, and what is written of an offer is read as the same one. The first byte says how the answer is cut.
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "link/pictures/answer_reader.hpp"
#include "require.hpp"
#include "video/webrtc/offer.hpp"

using namespace lapwing;
using fuzz::require;

namespace {

void read_offer(std::string_view text) {
  auto const offer = video::read_offer(text);
  if (!offer) {
    require(!offer.error().message.empty());
    return;
  }
  auto const ours = video::text_of(*offer);
  auto const again = video::read_offer(ours);
  require(again && video::text_of(*again) == ours);
  require(ours.find("candidate") == std::string::npos || text.find("candidate") != std::string_view::npos);
  auto const answer = video::answer_to(*offer, "v=0\r\nm=video 9 x\r\n");
  std::size_t sections = 0;
  for (auto at = answer.find("\r\nm="); at != std::string::npos; at = answer.find("\r\nm=", at + 1)) ++sections;
  require(sections == offer->sections.size());
}

void read_answer(std::size_t piece, std::string_view text) {
  link::pictures::AnswerReader whole;
  auto const at_once = whole.take(text);
  link::pictures::AnswerReader cut;
  base::Result<std::optional<link::pictures::HttpAnswer>> read = std::nullopt;
  for (std::size_t at = 0; at < text.size() && read && !*read; at += piece) read = cut.take(text.substr(at, piece));
  require(read.has_value() == at_once.has_value());
  if (!read || !*read) return;
  require((*read)->body == (*at_once)->body && (*read)->status == (*at_once)->status);
  require((*read)->body.size() <= link::pictures::AnswerReader::largest_body);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  if (size == 0) return 0;
  std::string_view const text(reinterpret_cast<char const*>(data) + 1, size - 1);
  read_offer(text);
  read_answer(1U + data[0], text);
  return 0;
}
