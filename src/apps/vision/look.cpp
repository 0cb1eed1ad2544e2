// `lapwing look`: looks at pictures for programs that do without OpenCV, one request after the other, until its
// standard input ends. src/host/eyes/look_frame.hpp says what goes back and forth.
#include <algorithm>
#include <string>
#include <utility>

#include <opencv2/imgproc.hpp>

#include "apps/verb.hpp"
#include "apps/vision/sign_readers.hpp"
#include "host/eyes/look_server.hpp"
#include "host/eyes/photograph_look.hpp"
#include "host/eyes/sign_look.hpp"
#include "vision/image/image.hpp"
#include "vision/image/rectify.hpp"
#include "vision/image/sharpness.hpp"
#include "vision/signs/sign_finder.hpp"

namespace lapwing::apps {

namespace {

using host::LookFrame;

/// As people see it, BGR.
base::Result<cv::Mat> pixels_of(host::LookPicture& picture) {
  if (picture.width == 0) {
    auto const image = vision::decode_image(std::as_bytes(std::span(picture.bytes)));
    if (!image) return std::unexpected(image.error());
    return image->upright();
  }
  cv::Mat const rgb(picture.height, picture.width, CV_8UC3, picture.bytes.data());
  cv::Mat bgr;
  cv::cvtColor(rgb, bgr, cv::COLOR_RGB2BGR);
  return bgr;
}

/// From the front, with some of the plate round the letters.
std::string crop_of(cv::Mat const& pixels, vision::Detection const& sign) {
  constexpr double more = 1.3;
  constexpr int longest = 480;
  auto const& corners = *sign.corners;
  vision::Point middle;
  for (auto const& corner : corners) middle = {middle.x + corner.x / 4.0, middle.y + corner.y / 4.0};
  vision::Quadrilateral wider;
  std::ranges::transform(corners, wider.begin(), [&](vision::Point const& corner) {
    return cv::Point2f(static_cast<float>(middle.x + more * (corner.x - middle.x)),
                       static_cast<float>(middle.y + more * (corner.y - middle.y)));
  });
  return vision::encode_jpeg(vision::rectified(pixels, wider, longest));
}

bool is_sharp_at(cv::Mat const& pixels, vision::Box const& box) {
  cv::Rect const part(cv::Rect2d(box.x, box.y, box.width, box.height));
  return is_sharp(vision::sharpness(pixels(part & cv::Rect(0, 0, pixels.cols, pixels.rows))));
}

LookFrame photograph(cv::Mat const& pixels) {
  constexpr double longest = 320.0;  // of the small copy
  double const scale = std::min(1.0, longest / std::max(pixels.cols, pixels.rows));
  cv::Mat small;
  cv::resize(pixels, small, {}, scale, scale, cv::INTER_AREA);
  return host::photograph_answer({.jpeg = vision::encode_jpeg(pixels),
                                  .thumbnail = vision::encode_jpeg(small),
                                  .width = pixels.cols,
                                  .height = pixels.rows});
}

LookFrame look_for_signs(vision::SignFinder& signs, cv::Mat const& pixels) {
  host::SignsSeen seen;
  for (auto& sign : signs.find(pixels)) {
    seen.is_sharp = seen.is_sharp && is_sharp_at(pixels, sign.box);
    auto crop = crop_of(pixels, sign);
    seen.signs.push_back({.sign = std::move(sign), .crop = std::move(crop)});
  }
  return host::sign_answer(std::move(seen));
}

/// Of a request: its picture.
base::Result<cv::Mat> picture_in(LookFrame& request) {
  auto picture = host::take_picture(request);
  if (!picture) return std::unexpected(picture.error());
  return pixels_of(*picture);
}

int look() {
  auto readers = detect::sign_readers();
  if (!readers) return host::refuse(readers.error());
  vision::SignFinder signs(*std::move(readers));
  return host::serve_looks({{host::sign_look,
                             [&signs](LookFrame& request) -> base::Result<LookFrame> {
                               auto const pixels = picture_in(request);
                               if (!pixels) return std::unexpected(pixels.error());
                               return look_for_signs(signs, *pixels);
                             }},
                            {host::photograph_look, [](LookFrame& request) -> base::Result<LookFrame> {
                               auto const pixels = picture_in(request);
                               if (!pixels) return std::unexpected(pixels.error());
                               return photograph(*pixels);
                             }}});
}

}  // namespace

void add_look(CLI::App& program, int& exit_code) {
  auto* const verb = begin_verb(program, "look");
  verb->footer("Reads requests, each a line of JSON and the picture's bytes, and answers each in the same way.");
  verb->callback([&exit_code] { exit_code = look(); });
}

}  // namespace lapwing::apps
