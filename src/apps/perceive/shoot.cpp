// `lapwing shoot`: takes pictures of a camera for programs that do without OpenCV, one request after the other, until
// its standard input ends. src/host/eyes/shot_look.hpp says what goes back and forth.
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <opencv2/core/utility.hpp>
#include <opencv2/imgproc.hpp>

#include "apps/verb.hpp"
#include "host/eyes/look_server.hpp"
#include "host/eyes/shot_look.hpp"
#include "video/camera/camera.hpp"

namespace lapwing::apps {

namespace {

namespace fs = std::filesystem;
using base::ErrorKind;
using base::fail;
using host::LookPicture;

/// What lies in a folder for longer does not show what the robot sees now.
constexpr std::chrono::seconds picture_is_old{2};

bool is_picture(fs::path const& file) {
  auto const ending = file.extension();
  return ending == ".jpg" || ending == ".jpeg" || ending == ".png" || ending == ".webp";
}

base::Result<LookPicture> newest_of(fs::path const& folder) {
  std::error_code error;
  std::optional<fs::path> newest;
  fs::file_time_type newest_at;
  for (auto const& entry : fs::directory_iterator(folder, error)) {
    std::error_code gone;  // between the listing and the look
    auto const at = entry.last_write_time(gone);
    if (gone || !is_picture(entry.path()) || (newest && at <= newest_at)) continue;
    newest = entry.path();
    newest_at = at;
  }
  if (error) return fail(ErrorKind::io, fmt::format("{}: {}", folder.string(), error.message()));
  if (!newest) return fail(ErrorKind::not_found, fmt::format("no picture lies in {}", folder.string()));
  auto const age = fs::file_time_type::clock::now() - newest_at;
  if (age > picture_is_old)
    return fail(ErrorKind::timed_out, fmt::format("the newest picture in {} is {} s old", folder.string(),
                                                  std::chrono::duration_cast<std::chrono::seconds>(age).count()));
  auto const size = fs::file_size(*newest, error);
  if (error || size > host::most_body_bytes)
    return fail(ErrorKind::invalid_input, fmt::format("{} is no picture: at most {} MiB are read", newest->string(),
                                                      host::most_body_bytes >> 20U));
  std::ifstream file(*newest, std::ios::binary);
  LookPicture picture{.bytes = {std::istreambuf_iterator<char>(file), {}}};
  if (!file || picture.bytes.empty()) return fail(ErrorKind::io, fmt::format("{} cannot be read", newest->string()));
  return picture;
}

LookPicture picture_of(cv::Mat const& bgr) {
  cv::Mat rgb;
  cv::cvtColor(bgr, rgb, cv::COLOR_BGR2RGB);  // continuous, as it is new
  auto const* const begin = reinterpret_cast<char const*>(rgb.data);
  return {.bytes = {begin, begin + rgb.total() * rgb.elemSize()}, .width = rgb.cols, .height = rgb.rows};
}

/// The camera that was asked for last; one that is gone is opened anew.
class Shooter {
 public:
  base::Result<host::LookFrame> answer(host::LookFrame const& request) {
    auto const question = host::shot_question_in(request);
    if (!question) return std::unexpected(question.error());
    std::error_code ignored;
    auto picture = fs::is_directory(question->source, ignored) ? newest_of(question->source) : shoot(*question);
    if (!picture) return std::unexpected(picture.error());
    return host::shot_answer(*std::move(picture));
  }

 private:
  base::Result<LookPicture> shoot(host::ShotQuestion const& question) {
    if (!camera_ || question != opened_) {
      camera_.reset();
      constexpr double any_view_rad = 1.0;  // the robot knows its lens
      auto camera = video::open_camera({.kind = video::CameraSettings::Kind::video,
                                        .lens = geo::pinhole(question.width_px, question.height_px, any_view_rad),
                                        .source = question.source});
      if (!camera) return std::unexpected(camera.error());
      camera_ = *std::move(camera);
      opened_ = question;
    }
    auto const frame = camera_->take({});
    if (frame) return picture_of(frame->picture);
    if (frame.error().kind == ErrorKind::lost) camera_.reset();
    return std::unexpected(frame.error());
  }

  std::unique_ptr<video::Camera> camera_;
  host::ShotQuestion opened_;
};

int shoot() {
  cv::setNumThreads(1);
  Shooter shooter;
  return host::serve_looks(
      {{host::shot_look, [&shooter](host::LookFrame& request) { return shooter.answer(request); }}});
}

}  // namespace

void add_shoot(CLI::App& program, int& exit_code) {
  auto* const verb = begin_verb(program, "shoot");
  verb->footer("Reads requests, each a line of JSON, and answers each with a picture in the same way.");
  verb->callback([&exit_code] { exit_code = shoot(); });
}

}  // namespace lapwing::apps
