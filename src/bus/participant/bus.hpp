#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "base/async/loop.hpp"
#include "base/error.hpp"

namespace lapwing::bus {

/// How sure and how new, as ROS 2 has it (rmw's profiles). A reader that wants more than a writer gives hears nothing.
enum class Profile {
  standard,     ///< nothing is lost: reliable, the last ten
  sensor_data,  ///< only what is new counts: best effort, the last five
  latched,      ///< who comes late gets the last one: reliable, transient local (maps, static transforms)
};

/// Which message it is: who wrote it (a DDS GUID), and its number there. Requests of services are told apart by it.
struct SampleIdentity {
  std::array<std::uint8_t, 16> writer = {};  ///< zeros: nobody
  std::int64_t number = 0;
  friend bool operator==(SampleIdentity const&, SampleIdentity const&) = default;
};

/// A message as it came.
struct Sample {
  std::string bytes = {};
  SampleIdentity identity = {};
  SampleIdentity related = {};  ///< what it answers, or where its answer is to go
  base::UtcTime written{};      ///< by the writer's clock
};

/// What DDS topic a name of ROS stands for.
enum class Lane {
  topic,    ///< rt/NAME
  request,  ///< rq/NAMERequest, of a service
  reply,    ///< rr/NAMEReply
};

struct BusOptions {
  std::uint32_t domain = 0;  ///< ROS_DOMAIN_ID, 0 to 101
  /// Programs of this machine alone (ROS_LOCALHOST_ONLY=1); otherwise whoever is in the network.
  bool is_local = true;
  std::string name = "lapwing";  ///< of the participant, for tools
};

/// The topics of ROS 2: a participant of a DDS domain, without ROS. Others see it with `ros2 topic`, RViz and Foxglove
/// whatever middleware they use, since type and topic names are those that ROS 2 makes (rt/scan,
/// sensor_msgs::msg::dds_::LaserScan_).
///
/// Messages come on the loop, however many threads the middleware has. Thread-bound. Writers and readers do not outlive
/// it, nor does it outlive the loop.
class Bus {
 public:
  /// Errors: invalid_input for a domain that there is not; io when the middleware does not start.
  [[nodiscard]] static base::Result<std::unique_ptr<Bus>> open(base::Loop& loop, BusOptions const& options);
  Bus(Bus const&) = delete;
  Bus& operator=(Bus const&) = delete;
  ~Bus();

  /// Bytes out. `Publisher` in topics.hpp has a type. Its end waits, for a fifth of a second at most, until readers
  /// have what was written.
  class Writer {
   public:
    virtual ~Writer() = default;
    virtual void write(std::string bytes) = 0;
    /// Of a service: `related` goes with it. Returns which message it became.
    virtual SampleIdentity write_related(std::string bytes, SampleIdentity const& related) = 0;
    /// How many readers it has found.
    [[nodiscard]] virtual int readers() const = 0;
  };
  /// Bytes in. `Subscription` in topics.hpp has a type.
  class Reader {
   public:
    virtual ~Reader() = default;
    /// How many writers it has found.
    [[nodiscard]] virtual int writers() const = 0;
    /// Messages that came faster than they were taken.
    [[nodiscard]] virtual std::uint64_t dropped() const = 0;
    /// Of this reader, as DDS knows it.
    [[nodiscard]] virtual std::array<std::uint8_t, 16> guid() const = 0;
  };
  using Heard = std::function<void(Sample const& sample)>;

  /// `topic` as ROS names it, "/robot1/scan"; `type` likewise, "sensor_msgs/msg/LaserScan". Errors: invalid_input for a
  /// name that is none, and for a topic that is written or read here by another type; io.
  [[nodiscard]] base::Result<std::unique_ptr<Writer>> write_to(std::string_view topic, std::string_view type,
                                                               Profile profile, Lane lane = Lane::topic);
  /// `heard` must not destroy the reader.
  [[nodiscard]] base::Result<std::unique_ptr<Reader>> read_from(std::string_view topic, std::string_view type,
                                                                Profile profile, Heard heard, Lane lane = Lane::topic);

  /// Another participant reads the topic by that type, as far as is known by now: finding each other takes a moment.
  [[nodiscard]] bool is_read_as(std::string_view topic, std::string_view type) const;

 private:
  struct Parts;
  Bus(base::Loop& loop, std::unique_ptr<Parts> parts);

  base::Loop& loop_;
  std::unique_ptr<Parts> parts_;
};

/// "rt/robot1/scan" of "/robot1/scan", "rq/robot1/dockRequest" of the service "/robot1/dock". Error: invalid_input,
/// with what a name is made of.
[[nodiscard]] base::Result<std::string> dds_topic(std::string_view topic, Lane lane = Lane::topic);
/// "sensor_msgs::msg::dds_::LaserScan_" of "sensor_msgs/msg/LaserScan".
[[nodiscard]] std::string dds_type(std::string_view type);

}  // namespace lapwing::bus
