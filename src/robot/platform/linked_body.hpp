#pragma once

#include <memory>
#include <optional>

#include "base/log.hpp"
#include "robot/carrier/carrier_client.hpp"
#include "robot/platform/body.hpp"
#include "robot/ranges/board_odometry.hpp"

namespace lapwing::robot {

/// A body at the far end of a byte link: a microcontroller on a serial line, or a simulated one
/// (docs/reference/robot-serial.md).
class LinkedBody final : public Body {
 public:
  /// The loop outlives it.
  LinkedBody(base::Loop& loop, std::unique_ptr<link::ByteLink> link, base::Logger log);

  void listen(Listener listener) override { listener_ = std::move(listener); }
  [[nodiscard]] slam::Sensor const* sensor() const override { return sensor_ ? &*sensor_ : nullptr; }
  [[nodiscard]] Limits limits() const override { return limits_; }
  [[nodiscard]] std::string link() const override { return link_->name(); }
  [[nodiscard]] std::optional<std::uint16_t> take_carrier_code() override;
  void drive(Motion motion) override;
  void kill() override { client_.kill(); }
  void release() override { client_.release(); }

 private:
  void meet(firmware::Hello const& hello);
  void take(firmware::Readings const& readings);
  void take(LaserRanges const& scan);
  void tell(firmware::Log const& log);

  base::Loop& loop_;
  base::Logger log_;
  std::unique_ptr<link::ByteLink> link_;
  Listener listener_;
  std::optional<firmware::Description> description_;
  std::optional<BoardOdometry> odometry_;
  Limits limits_;
  std::optional<slam::Sensor> sensor_;
  std::optional<LaserRanges> scan_;  ///< that odometry has not caught up with
  bool is_told_to_stand_ = false;
  base::TimePoint told_of_{};  ///< when that was heard which the carrier's code was told of last
  firmware::FrameReader::Counters frames_then_;
  base::TimePoint frames_since_{};
  CarrierClient client_;
};

}  // namespace lapwing::robot
