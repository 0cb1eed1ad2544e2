#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <utility>

#include "mavlink/codec/messages.hpp"

/// One vehicle on two links, or two vehicles with one system id?
///
/// An autopilot counts its packets for each link anew and writes other bytes to each, so the packets of one vehicle on
/// two links look no more alike than those of two vehicles. What tells:
///
/// - *Copies*: a router on the way hands the very same packets to both links. Two packets that agree in sequence,
///   message, checksum and in a clock of milliseconds inside are one. Three such: one vehicle.
/// - *Clocks*: TIMESYNC asks each far end for its clock, and answers show it to within the round trip. Two autopilots
///   were switched on at different times; clocks that differ by more than the round trips mean two vehicles.
/// - *Hardware numbers* (AUTOPILOT_VERSION): different ones mean two vehicles, at once. Equal ones prove little alone:
///   ArduPilot on Linux and in simulation tells the machine's number, which all its vehicles share.
/// - *Positions* at one time by that clock: further apart than the estimate's noise means two vehicles.
///
/// One vehicle is proven by copies, or by clocks that agree together with equal hardware numbers or one position, three
/// times in a row with nothing against it. Two are proven by different hardware numbers, or by clocks or positions that
/// differ three times in a row. As long as neither is proven they count as two: a false alarm costs a look, a false
/// peace sends one vehicle's mission to another.
///
/// Where it fails: an autopilot that answers neither TIMESYNC nor requests for messages, or a link on which nothing can
/// be asked, cannot prove itself and is refused. Simulated vehicles on one machine that start within the same
/// hundredths of a second at the same place look like one. Vehicles whose clock runs at another rate than ours
/// (sped-up simulation) look like two when the links' round trips differ much.
namespace lapwing::mavlink::internal {

/// What has been heard of a vehicle over one path.
struct Fingerprint {
  struct Clock {
    base::TimePoint boot;    ///< when the vehicle's clock was zero, in our time
    base::Duration error{};  ///< at most
    base::TimePoint heard{};
  };
  struct Place {
    GlobalPosition position;
    base::TimePoint heard{};
  };
  using HardwareNumber = std::pair<std::uint64_t, std::array<std::uint8_t, 18>>;

  std::optional<Clock> clock;
  std::optional<Place> place;
  std::optional<HardwareNumber> hardware;

  /// An answer to our TIMESYNC request.
  void take(Timesync const& answer, base::TimePoint now);
  void take(GlobalPosition const& heard, base::TimePoint now);
  void take(AutopilotVersion const& heard);
};

enum class Verdict { unknown, one, two };

/// What speaks for and against two paths leading to one vehicle.
class SameVehicle {
 public:
  /// Compares what is new in both; call about twice a second.
  void compare(Fingerprint const& a, Fingerprint const& b, base::TimePoint now);
  /// The same packet came over both.
  void note_copy();
  [[nodiscard]] Verdict verdict() const { return verdict_; }
  /// Not proven yet, but something speaks for one and nothing against it.
  [[nodiscard]] bool is_likely_one() const { return for_ > 0; }

 private:
  void count(int& evidence, int& opposite, Verdict proves);

  Verdict verdict_ = Verdict::unknown;
  int for_ = 0;
  int against_ = 0;
  int copies_ = 0;
  bool stand_apart_ = false;  ///< when their positions were compared last
  base::TimePoint compared_ = base::TimePoint::min();
};

}  // namespace lapwing::mavlink::internal
