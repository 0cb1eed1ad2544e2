#pragma once

#include <cstdint>

#include "robot/carrier/carrier_client.hpp"
#include "robot/sensors/sensor_interface.hpp"

namespace lapwing::robot {

/// The error code of what the carrier's line and board say; the worst, if there are several. `heard_frames` are the
/// counters of a while ago, so that damage of long since is no news.
[[nodiscard]] std::uint16_t carrier_code(CarrierClient::Status const& status,
                                         firmware::FrameReader::Counters const& frames_before);

/// The error code of what is wrong with the sensors.
[[nodiscard]] std::uint16_t sensors_code(Sensed::Faults const& faults);

}  // namespace lapwing::robot
