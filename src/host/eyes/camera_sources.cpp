#include "host/eyes/camera_sources.hpp"

#include <utility>

#include <fmt/format.h>

#include "host/eyes/shot_look.hpp"
#include "robot/ros/ros_camera.hpp"

namespace lapwing::host {

namespace {

using Develop = PictureSource::Develop;
using Taken = base::Result<Develop>;

/// What is wrong with one camera, said when it begins and when it is over.
class Complaint {
 public:
  Complaint(std::string camera, base::Logger log) : camera_(std::move(camera)), log_(std::move(log)) {}
  void note(std::string const& why) {
    if (std::exchange(is_wrong_, !why.empty()) == !why.empty()) return;
    if (why.empty())
      log_.info(fmt::format("the camera {} gives pictures again", camera_));
    else
      log_.warn(fmt::format("the camera {} gives no pictures: {}", camera_, why));
  }

 private:
  std::string camera_;
  base::Logger log_;
  bool is_wrong_ = false;
};

/// Shared by the coroutines that take a picture, which may outlive who asked for one.
struct Shot {
  Shot(base::Loop& loop, LookingChild::Settings const& shooter, ShotQuestion asked, base::Logger const& log)
      : child(loop, shooter, log), question(std::move(asked)), complaint(question.source, log) {}
  LookingChild child;
  ShotQuestion question;
  Complaint complaint;
};

base::Task<Taken> take_shot(std::shared_ptr<Shot> shot) {
  auto asking = shot->child.ask([question = shot->question] { return shot_request(question); });
  auto answer = co_await std::move(asking);
  auto picture = answer ? shot_in(*std::move(answer)) : std::unexpected(answer.error());
  shot->complaint.note(picture ? std::string() : picture.error().message);
  if (!picture) co_return std::unexpected(picture.error());
  co_return Develop([picture = *std::move(picture)]() mutable { return std::move(picture); });
}

struct OnTopic {
  std::unique_ptr<robot::ros::RosCamera> camera;
  Complaint complaint;
};

/// What cannot be read is found by who looks at it: nothing there.
LookPicture developed(robot::ros::RosCamera::Raw const& raw) {
  auto picture = raw.decode(raw.bytes);
  if (!picture) return {};
  return {.bytes = std::move(picture->bytes), .width = picture->width, .height = picture->height};
}

base::Task<Taken> take_of_topic(std::shared_ptr<OnTopic> topic) {
  auto coming = topic->camera->next();
  auto raw = co_await std::move(coming);
  topic->complaint.note(raw ? std::string() : raw.error().message);
  if (!raw) co_return std::unexpected(raw.error());
  co_return Develop([raw = *std::move(raw)] { return developed(raw); });
}

PictureSource shot_source(base::Loop& loop, RobotCamera const& camera, LookingChild::Settings const& shooter,
                          base::Logger const& log) {
  auto const shot = std::make_shared<Shot>(
      loop, shooter,
      ShotQuestion{.source = camera.from, .width_px = camera.mount.width_px, .height_px = camera.mount.height_px}, log);
  return {.mount = camera.mount, .take = [shot] { return take_shot(shot); }};
}

}  // namespace

base::Result<CameraSources> camera_sources(base::Loop& loop, std::vector<RobotCamera> const& cameras,
                                           std::string const& robot, LookingChild::Settings const& shooter,
                                           OpenBus const& open_bus, base::Logger const& log) {
  CameraSources sources;
  std::shared_ptr<bus::Bus> bus;
  for (auto const& camera : cameras) {
    if (camera.robot != robot) continue;
    PictureSource source;
    if (camera.kind != RobotCamera::Kind::topic) {
      source = shot_source(loop, camera, shooter, log);
    } else if (!open_bus) {
      return base::fail(base::ErrorKind::invalid_input,
                        fmt::format("{} is not on ROS 2, and its camera is: {}", robot, camera.from),
                        "give the camera a source or a folder");
    } else {
      if (!bus) {
        auto opened = open_bus();
        if (!opened) return std::unexpected(opened.error());
        bus = *std::move(opened);
      }
      auto opened = robot::ros::RosCamera::open(loop, bus, camera.from);
      if (!opened) return std::unexpected(opened.error());
      auto const topic = std::make_shared<OnTopic>(OnTopic{*std::move(opened), Complaint(camera.from, log)});
      source = {.mount = camera.mount, .take = [topic] { return take_of_topic(topic); }};
    }
    if (camera.photographs) sources.ahead = source;
    sources.for_tags.push_back(std::move(source));
  }
  return sources;
}

}  // namespace lapwing::host
