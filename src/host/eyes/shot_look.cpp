#include "host/eyes/shot_look.hpp"

#include <utility>

namespace lapwing::host {

using base::ErrorKind;
using base::fail;

namespace {

constexpr std::int64_t most_px = 8'192;  // each way
constexpr std::size_t longest_source = 4'096;

}  // namespace

LookFrame shot_request(ShotQuestion const& question) {
  return {.head = {{"look", shot_look},
                   {"source", question.source},
                   {"wanted_width", question.width_px},
                   {"wanted_height", question.height_px}},
          .body = {}};
}

base::Result<ShotQuestion> shot_question_in(LookFrame const& request) {
  auto const source = request.head.find("source");
  bool const is_named = source != request.head.end() && source->is_string() &&
                        !source->get_ref<std::string const&>().empty() &&
                        source->get_ref<std::string const&>().size() <= longest_source;
  if (!is_named) return fail(ErrorKind::invalid_input, "it does not say where pictures come from");
  auto const width = count_in(request.head, "wanted_width").value_or(0);
  auto const height = count_in(request.head, "wanted_height").value_or(0);
  if (width <= 0 || height <= 0 || width > most_px || height > most_px)
    return fail(ErrorKind::invalid_input, "a picture without a size");
  return ShotQuestion{
      .source = source->get<std::string>(), .width_px = static_cast<int>(width), .height_px = static_cast<int>(height)};
}

LookFrame shot_answer(LookPicture picture) {
  LookFrame answer;
  put_picture(answer, std::move(picture));
  return answer;
}

base::Result<LookPicture> shot_in(LookFrame answer) {
  if (auto const why = refusal_in(answer)) return fail(ErrorKind::invalid_input, *why);
  if (answer.body.empty()) return fail(ErrorKind::invalid_input, "an answer without a picture");
  return take_picture(answer);
}

}  // namespace lapwing::host
