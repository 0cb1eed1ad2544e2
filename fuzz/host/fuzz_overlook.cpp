// What goes between a program with simulated drones and the one that shows them a car park: what was read is written
// and read again as itself.
#include <cstdint>
#include <string_view>

#include "host/car_park/car_park_look.hpp"
#include "require.hpp"

using namespace lapwing;
using namespace lapwing::host;

namespace {

void read_look(LookFrame const& frame) {
  auto const look = look_in(frame);
  if (!look) return fuzz::require(!look.error().message.empty());
  auto const again = look_in(look_request(*look));
  fuzz::require(again && again->at == look->at && again->lens.width_px == look->lens.width_px &&
                again->pose.yaw_rad == look->pose.yaw_rad && again->place.world == look->place.world);
}

void read_sight(LookFrame const& frame) {
  CarParkLook const asked{.place = {}, .lens = geo::pinhole(96, 72, 1.0), .at = {}, .pose = {}};
  auto const sight = sight_in(frame, asked, 0.0);
  if (!sight) return fuzz::require(!sight.error().message.empty());
  auto const again = sight_in(look_answer(*sight), asked, 0.0);
  fuzz::require(again && again->has_value() == sight->has_value());
  if (!*sight) return;
  fuzz::require((*again)->slots.size() == (*sight)->slots.size() && (*again)->cars.size() == (*sight)->cars.size());
}

void read_truth(LookFrame const& frame) {
  if (auto const question = truth_question_in(frame); !question) fuzz::require(!question.error().message.empty());
  auto const truth = truth_in(frame);
  if (!truth) return fuzz::require(!truth.error().message.empty());
  auto const again = truth_in(truth_answer(*truth));
  fuzz::require(again && again->slots.size() == truth->slots.size() && again->ground_m == truth->ground_m);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  LookFrameReader reader;
  reader.take({reinterpret_cast<char const*>(data), size});
  auto const frame = reader.next();
  if (!frame || !*frame) return 0;
  read_look(**frame);
  read_sight(**frame);
  read_truth(**frame);
  return 0;
}
