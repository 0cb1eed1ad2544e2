// Requests to look at a picture and their answers, from a stream in pieces: what was read is written and read again as
// itself, and so is what it says.
#include <algorithm>
#include <cstdint>
#include <optional>
#include <string_view>

#include "host/eyes/photograph_look.hpp"
#include "host/eyes/shot_look.hpp"
#include "host/eyes/sign_look.hpp"
#include "require.hpp"

using namespace lapwing;
using namespace lapwing::host;

namespace {

void require_same_frame(LookFrame const& frame) {
  LookFrameReader reader;
  reader.take(to_bytes(frame));
  auto const again = reader.next();
  fuzz::require(again && *again && (*again)->body == frame.body && reader.is_empty());
}

void read_request(LookFrame frame) {
  auto const bytes = frame.body.size();
  auto const picture = take_picture(frame);
  if (!picture) return fuzz::require(!picture.error().message.empty());
  auto const pixels = 3 * static_cast<std::size_t>(picture->width) * static_cast<std::size_t>(picture->height);
  fuzz::require(picture->bytes.size() == bytes && (pixels == 0 || pixels == bytes));
}

void read_photograph(LookFrame const& frame) {
  auto const picture = photograph_in(frame);
  if (!picture) return fuzz::require(!picture.error().message.empty());
  auto const again = photograph_in(photograph_answer(*picture));
  fuzz::require(again && again->jpeg == picture->jpeg && again->thumbnail == picture->thumbnail);
}

void read_shot(LookFrame const& frame) {
  auto const question = shot_question_in(frame);
  fuzz::require(question ? shot_question_in(shot_request(*question)) == *question : !question.error().message.empty());
  auto const picture = shot_in(frame);
  if (!picture) return fuzz::require(!picture.error().message.empty());
  auto const again = shot_in(shot_answer(*picture));
  fuzz::require(again && again->bytes == picture->bytes && again->width == picture->width);
}

void read_answer(LookFrame const& frame) {
  auto const seen = signs_in(frame);
  if (!seen) return fuzz::require(!seen.error().message.empty());
  auto const again = signs_in(sign_answer(*seen));
  fuzz::require(again && again->is_sharp == seen->is_sharp && again->signs.size() == seen->signs.size());
  for (std::size_t i = 0; i < seen->signs.size(); ++i) {
    auto const& one = seen->signs[i];
    auto const& other = again->signs[i];
    fuzz::require(one.sign.text == other.sign.text && one.sign.box == other.sign.box && one.crop == other.crop);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  if (size == 0) return 0;
  std::size_t const piece = 1U + *data;
  std::string_view input(reinterpret_cast<char const*>(data) + 1, size - 1);
  LookFrameReader reader;
  while (!input.empty()) {
    reader.take(input.substr(0, piece));
    input.remove_prefix(std::min(piece, input.size()));
    for (;;) {
      auto const frame = reader.next();
      if (!frame) return 0;
      if (!*frame) break;
      require_same_frame(**frame);
      read_answer(**frame);
      read_photograph(**frame);
      read_shot(**frame);
      read_request(**frame);
    }
  }
  return 0;
}
