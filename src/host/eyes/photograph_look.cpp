#include "host/eyes/photograph_look.hpp"

#include <utility>

namespace lapwing::host {

LookFrame photograph_request(LookPicture picture) {
  LookFrame request{.head = {{"look", photograph_look}}};
  put_picture(request, std::move(picture));
  return request;
}

LookFrame photograph_answer(KeptPicture const& picture) {
  return {.head = {{"width", picture.width}, {"height", picture.height}, {"jpeg_bytes", picture.jpeg.size()}},
          .body = picture.jpeg + picture.thumbnail};
}

base::Result<KeptPicture> photograph_in(LookFrame const& answer) {
  if (auto const why = refusal_in(answer)) return base::fail(base::ErrorKind::invalid_input, *why);
  auto const width = count_in(answer.head, "width");
  auto const height = count_in(answer.head, "height");
  auto const bytes = count_in(answer.head, "jpeg_bytes");
  bool const has_size = width && height && *width > 0 && *height > 0 && *width <= most_look_pixels / *height;
  if (!has_size || !bytes || std::cmp_greater_equal(*bytes, answer.body.size()) || *bytes == 0)
    return base::fail(base::ErrorKind::invalid_input, "no answer to a wish for a photograph");
  auto const whole = static_cast<std::size_t>(*bytes);
  return KeptPicture{.jpeg = answer.body.substr(0, whole),
                     .thumbnail = answer.body.substr(whole),
                     .width = static_cast<int>(*width),
                     .height = static_cast<int>(*height)};
}

}  // namespace lapwing::host
