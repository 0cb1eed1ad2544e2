#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "bus/cdr/cdr.hpp"
#include "bus/messages/diagnostics.hpp"
#include "bus/messages/images.hpp"
#include "bus/messages/mavros.hpp"
#include "bus/messages/mavros_services.hpp"
#include "bus/messages/navigation.hpp"
#include "bus/messages/sensors.hpp"
#include "require.hpp"
#include "robot/ros/ros_picture.hpp"

namespace {

using lapwing::fuzz::require;

/// What is read is written and read again as it was.
template <class M>
void read(std::string_view bytes) {
  auto const message = lapwing::bus::decode<M>(bytes);
  if (!message) return;
  auto const written = lapwing::bus::encode(*message);
  auto const again = lapwing::bus::decode<M>(written);
  require(again.has_value());
  require(lapwing::bus::encode(*again) == written);
}

/// The same, and whatever it says of its size, a picture of it has as many pixels.
template <class M>
void read_picture(std::string_view bytes) {
  read<M>(bytes);
  auto const message = lapwing::bus::decode<M>(bytes);
  if (!message) return;
  auto const picture = lapwing::robot::ros::picture_of(*message);
  if (!picture || picture->width == 0) return;
  require(picture->bytes.size() ==
          std::size_t{3} * static_cast<std::size_t>(picture->width) * static_cast<std::size_t>(picture->height));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  using namespace lapwing::bus;
  if (size == 0) return 0;
  std::string_view const bytes(reinterpret_cast<char const*>(data + 1), size - 1);
  switch (data[0] % 16) {
    case 0: read<LaserScan>(bytes); break;
    case 1: read<Odometry>(bytes); break;
    case 2: read<OccupancyGrid>(bytes); break;
    case 3: read<TFMessage>(bytes); break;
    case 4: read<BatteryState>(bytes); break;
    case 5: read<NavSatFix>(bytes); break;
    case 6: read<DiagnosticStatus>(bytes); break;
    case 7: read<GeoPoseStamped>(bytes); break;
    case 8: read<mavros::State>(bytes); break;
    case 9: read<mavros::HomePosition>(bytes); break;
    case 10: read<mavros::SysStatus>(bytes); break;
    case 11: read<mavros::SetMode::Request>(bytes); break;
    case 12: read<mavros::ParamSetV2::Request>(bytes); break;
    case 13: read_picture<Image>(bytes); break;
    case 14: read_picture<CompressedImage>(bytes); break;
    default: read<Path>(bytes); break;
  }
  return 0;
}
