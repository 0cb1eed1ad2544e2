#include "host/eyes/look_picture.hpp"

#include <utility>

#include <fmt/format.h>

namespace lapwing::host {

using base::ErrorKind;
using base::fail;

void put_picture(LookFrame& request, LookPicture picture) {
  request.body = std::move(picture.bytes);
  if (picture.width <= 0) return;
  request.head["width"] = picture.width;
  request.head["height"] = picture.height;
}

base::Result<LookPicture> take_picture(LookFrame& request) {
  LookPicture picture{.bytes = std::move(request.body)};
  if (!request.head.contains("width")) return picture;
  auto const width = count_in(request.head, "width").value_or(0);
  auto const height = count_in(request.head, "height").value_or(0);
  if (width <= 0 || height <= 0 || width > most_look_pixels / height)
    return fail(ErrorKind::invalid_input, "a picture without a size");
  if (std::cmp_not_equal(picture.bytes.size(), 3 * width * height))
    return fail(ErrorKind::invalid_input,
                fmt::format("{} bytes are not {} times {} pixels of three bytes", picture.bytes.size(), width, height));
  picture.width = static_cast<int>(width);
  picture.height = static_cast<int>(height);
  return picture;
}

}  // namespace lapwing::host
