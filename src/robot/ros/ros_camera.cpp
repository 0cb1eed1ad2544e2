#include "robot/ros/ros_camera.hpp"

#include <utility>

#include <fmt/format.h>

#include "bus/cdr/cdr.hpp"

namespace lapwing::robot::ros {

using namespace std::chrono_literals;

namespace {

constexpr base::Duration patience = 1s;

template <bus::Message M>
base::Result<RosPicture> decoded(std::string const& bytes) {
  auto const message = bus::decode<M>(bytes);
  if (!message) return base::fail(base::ErrorKind::invalid_input, "no whole picture");
  return picture_of(*message);
}

}  // namespace

RosCamera::RosCamera(base::Loop& loop, std::shared_ptr<bus::Bus> bus, std::string topic)
    : bus_(std::move(bus)),
      topic_(std::move(topic)),
      decode_(topic_.ends_with("/compressed") ? &decoded<bus::CompressedImage> : &decoded<bus::Image>),
      came_(loop) {}

base::Result<std::unique_ptr<RosCamera>> RosCamera::open(base::Loop& loop, std::shared_ptr<bus::Bus> bus,
                                                         std::string const& topic) {
  auto camera = std::unique_ptr<RosCamera>(new RosCamera(loop, std::move(bus), topic));
  auto const type = topic.ends_with("/compressed") ? bus::Description<bus::CompressedImage>::name
                                                   : bus::Description<bus::Image>::name;
  auto reader =
      camera->bus_->read_from(topic, type, bus::Profile::sensor_data, [raw = camera.get()](bus::Sample const& sample) {
        if (raw->waiting_ == 0) return;
        raw->newest_ = sample.bytes;
        ++raw->heard_;
        raw->came_.notify_all();
      });
  if (!reader) return std::unexpected(reader.error());
  camera->reader_ = *std::move(reader);
  return camera;
}

base::Task<base::Result<RosCamera::Raw>> RosCamera::next() {
  class Waiting {  // also when nobody awaits this any more
   public:
    explicit Waiting(int& count) : count_(count) { ++count_; }
    ~Waiting() { --count_; }
    Waiting(Waiting const&) = delete;
    Waiting& operator=(Waiting const&) = delete;

   private:
    int& count_;
  };
  Waiting const waiting(waiting_);
  auto const before = heard_;
  auto coming = came_.wait_for([this, before] { return heard_ != before; }, patience);
  if (!co_await std::move(coming))
    co_return base::fail(base::ErrorKind::timed_out,
                         fmt::format("no picture has come on {} for {:.0f} s", topic_, base::to_seconds(patience)));
  co_return Raw{.bytes = newest_, .decode = decode_};
}

}  // namespace lapwing::robot::ros
