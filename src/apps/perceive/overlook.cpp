// `lapwing overlook`: shows programs with simulated drones a simulated car park and looks at it for them, one request
// after the other, until its standard input ends. src/host/car_park/car_park_look.hpp says what goes back and forth.
#include <memory>
#include <optional>
#include <utility>

#include <opencv2/core/utility.hpp>

#include "apps/perceive/car_network.hpp"
#include "apps/verb.hpp"
#include "base/log.hpp"
#include "host/car_park/car_park_look.hpp"
#include "host/eyes/look_server.hpp"
#include "perceive/lot_eye.hpp"
#include "video/camera/camera.hpp"
#include "video/world/car_park_file.hpp"

namespace lapwing::apps {

namespace {

/// From the frame in which places are told to that of the car park.
geo::Vector3<geo::SiteFrame> shift_to(video::CarPark const& park, host::CarParkPlace const& place) {
  if (!place.anchor) return {};
  auto const shift = geo::to_enu(geo::LocalFrame(park.anchor).ned_from(*place.anchor));
  return {shift.east, shift.north, shift.up};
}

base::Result<host::LookFrame> tell_truth(host::LookFrame const& request) {
  auto const question = host::truth_question_in(request);
  if (!question) return std::unexpected(question.error());
  auto const park = video::load_car_park(question->place.world);
  if (!park) return std::unexpected(park.error());
  auto const shift = shift_to(*park, question->place);
  auto const now = video::occupation_at(*park, question->at);
  host::CarParkTruth truth{.anchor = question->place.anchor.value_or(park->anchor), .ground_m = -shift.z()};
  for (std::size_t i = 0; i < park->slots.size(); ++i) {
    auto outline = park->slots[i].outline;
    for (auto& corner : outline) corner = {corner.x() - shift.x(), corner.y() - shift.y()};
    truth.slots.push_back({.outline = outline, .is_taken = now.taken[i]});
  }
  return host::truth_answer(truth);
}

/// One camera over one car park at a time: drawing its ground anew takes a second.
class Overlook {
 public:
  explicit Overlook(perceive::LotEye eye) : eye_(std::move(eye)) {}

  base::Result<host::LookFrame> answer(host::LookFrame const& request) {
    auto const look = host::look_in(request);
    if (!look) return std::unexpected(look.error());
    if (auto opened = open(*look); !opened) return std::unexpected(opened.error());
    auto const frame = camera_->take({host::view_of(look->lens, look->pose, 0.0).site_from_camera, look->at});
    if (!frame) return std::unexpected(frame.error());
    auto const view = host::view_of(look->lens, look->pose, -shift_.z());
    return host::look_answer(eye_.look(frame->picture, view, look->at));
  }

 private:
  base::Result<> open(host::CarParkLook const& look) {
    video::CameraSettings settings{.lens = look.lens, .world = look.place.world, .anchor = look.place.anchor};
    // What a drone with GPS and a gimbal may be off, as the map takes it to be.
    settings.faults.position_m = explore::PoseDoubt{}.position_m;
    settings.faults.angle_rad = explore::PoseDoubt{}.angle_rad;
    bool const is_open = camera_ && world_ == settings.world && anchor_ == settings.anchor &&
                         camera_->lens().width_px == look.lens.width_px &&
                         camera_->lens().height_px == look.lens.height_px &&
                         camera_->lens().focal_x_px == look.lens.focal_x_px;
    if (is_open) return {};
    auto const park = video::load_car_park(settings.world);
    if (!park) return std::unexpected(park.error());
    auto camera = video::open_camera(settings);
    if (!camera) return std::unexpected(camera.error());
    camera_ = *std::move(camera);
    world_ = settings.world;
    anchor_ = settings.anchor;
    shift_ = shift_to(*park, look.place);
    return {};
  }

  perceive::LotEye eye_;
  std::unique_ptr<video::Camera> camera_;
  std::filesystem::path world_;
  std::optional<geo::Wgs84> anchor_;
  geo::Vector3<geo::SiteFrame> shift_ = {};
};

int overlook() {
  cv::setNumThreads(1);
  base::LogHub hub;
  hub.add_sink(base::standard_error_sink(base::LogLevel::info));
  auto eye = perceive::LotEye::make(car_network(base::Logger(hub, "overlook")), {});
  if (!eye) return host::refuse(eye.error());
  Overlook state(*std::move(eye));
  return host::serve_looks({{host::car_park_look, [&state](host::LookFrame& request) { return state.answer(request); }},
                            {host::car_park_truth, [](host::LookFrame& request) { return tell_truth(request); }}});
}

}  // namespace

void add_overlook(CLI::App& program, int& exit_code) {
  auto* const verb = begin_verb(program, "overlook");
  verb->footer("Reads requests, each a line of JSON, and answers each in the same way.");
  verb->callback([&exit_code] { exit_code = overlook(); });
}

}  // namespace lapwing::apps
