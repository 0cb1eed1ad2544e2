#include "host/eyes/picture_eyes.hpp"

#include <algorithm>
#include <cstddef>
#include <deque>
#include <memory>
#include <string>
#include <utility>

#include "host/eyes/photograph_look.hpp"
#include "host/eyes/sign_look.hpp"
#include "robot/watch/codes.hpp"

namespace lapwing::host {

namespace {

/// Looks take half a second, a few on a small machine; who takes longer is silent, and later ended.
constexpr base::Duration look_hangs_after = std::chrono::seconds(5);

/// Of so many pictures in which something was written, most must have been sharp.
constexpr std::size_t pictures_judged = 20;

/// What is known of the pictures of all cameras of a robot.
struct PictureRecord {
  int silent_cameras = 0;      ///< that gave no picture when they were last asked
  std::deque<bool> was_sharp;  ///< the last ones in which something was written, the newest last

  void note(robot::Look const& look) {
    if (look.found.empty()) return;
    was_sharp.push_back(look.is_sharp);
    if (was_sharp.size() > pictures_judged) was_sharp.pop_front();
  }
  [[nodiscard]] bool are_blurred() const {
    return was_sharp.size() == pictures_judged &&
           std::ranges::count(was_sharp, false) > static_cast<std::ptrdiff_t>(pictures_judged / 2);
  }
};

/// One camera, and what the others of the robot share with it.
struct Camera {
  PictureSource source;
  LookingChild* child;
  std::shared_ptr<PictureRecord> record;
  std::shared_ptr<bool> is_silent = std::make_shared<bool>(false);

  void note(bool has_picture) const {
    if (*is_silent == !has_picture) return;
    *is_silent = !has_picture;
    record->silent_cameras += has_picture ? -1 : 1;
  }
};

base::Task<std::optional<robot::Look>> look_for_tags(Camera camera) {
  if (!camera.child->may_be_asked()) co_return std::nullopt;
  auto taking = camera.source.take();
  auto picture = co_await std::move(taking);
  camera.note(picture.has_value());
  if (!picture) co_return std::nullopt;
  auto asking = camera.child->ask([develop = *std::move(picture)]() mutable { return sign_request(develop()); });
  auto const answer = co_await std::move(asking);
  auto seen = answer ? signs_in(*answer) : base::fail(base::ErrorKind::lost, "");
  if (!seen) co_return std::nullopt;
  robot::Look look{.found = {}, .is_sharp = seen->is_sharp};
  for (auto& [sign, crop] : seen->signs) look.found.push_back({.what = std::move(sign), .crop = std::move(crop)});
  camera.record->note(look);
  co_return look;
}

base::Task<base::Result<robot::Photograph>> take_photograph(Camera camera) {
  auto taking = camera.source.take();
  auto taken = co_await std::move(taking);
  camera.note(taken.has_value());
  if (!taken) co_return std::unexpected(taken.error());
  auto asking = camera.child->ask([develop = *std::move(taken)]() mutable { return photograph_request(develop()); });
  auto const answer = co_await std::move(asking);
  if (!answer) co_return std::unexpected(answer.error());
  auto picture = photograph_in(*answer);
  if (!picture) co_return std::unexpected(picture.error());
  co_return robot::Photograph{.jpeg = std::move(picture->jpeg),
                              .thumbnail = std::move(picture->thumbnail),
                              .width_px = picture->width,
                              .height_px = picture->height};
}

std::optional<std::uint16_t> trouble_of(base::Loop const& loop, LookingChild const& child,
                                        PictureRecord const& record) {
  if (child.asked_since() && loop.now() - *child.asked_since() > look_hangs_after) return std::nullopt;
  if (child.is_missing()) return robot::code::no_reader;
  if (child.is_failing()) return robot::code::eyes_away;
  if (record.silent_cameras > 0) return robot::code::camera_silent;
  return record.are_blurred() ? robot::code::pictures_blurred : robot::code::none;
}

}  // namespace

robot::Eyes eyes_with(base::Loop& loop, std::vector<PictureSource> for_tags, std::optional<PictureSource> ahead,
                      LookingChild& child) {
  auto const record = std::make_shared<PictureRecord>();
  robot::Eyes eyes;
  for (auto& source : for_tags) {
    auto const mount = source.mount;
    Camera const camera{.source = std::move(source), .child = &child, .record = record};
    eyes.for_tags.push_back({.mount = mount, .look = [camera] { return look_for_tags(camera); }});
  }
  if (ahead) {
    auto const mount = ahead->mount;
    Camera const camera{.source = *std::move(ahead), .child = &child, .record = record};
    eyes.photographer = {.mount = mount, .take = [camera] { return take_photograph(camera); }};
  }
  eyes.trouble = [&loop, &child, record] { return trouble_of(loop, child, *record); };
  return eyes;
}

}  // namespace lapwing::host
