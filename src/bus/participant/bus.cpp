#include "bus/participant/bus.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastrtps/utils/IPLocator.h>
#include <fmt/format.h>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/domain/DomainParticipantListener.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/Topic.hpp>

#include "base/async/inbox.hpp"
#include "base/async/scope.hpp"
#include "bus/participant/internal/raw_type.hpp"

namespace lapwing::bus {

namespace dds = eprosima::fastdds::dds;
namespace rtps = eprosima::fastrtps::rtps;
using base::ErrorKind;
using Done = eprosima::fastrtps::types::ReturnCode_t;

namespace {

constexpr std::uint32_t most_domain = 101;  ///< its ports go up to those that the system hands out
constexpr int standard_depth = 10;
constexpr int sensor_depth = 5;

int depth_of(Profile profile) {
  switch (profile) {
    case Profile::standard: return standard_depth;
    case Profile::sensor_data: return sensor_depth;
    case Profile::latched: return 1;
  }
  return 1;
}

/// What writers and readers have alike.
template <class Qos>
Qos qos_of(Profile profile) {
  Qos qos;
  qos.reliability().kind =
      profile == Profile::sensor_data ? dds::BEST_EFFORT_RELIABILITY_QOS : dds::RELIABLE_RELIABILITY_QOS;
  qos.durability().kind =
      profile == Profile::latched ? dds::TRANSIENT_LOCAL_DURABILITY_QOS : dds::VOLATILE_DURABILITY_QOS;
  qos.history().kind = dds::KEEP_LAST_HISTORY_QOS;
  qos.history().depth = depth_of(profile);
  qos.endpoint().history_memory_policy = rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
  qos.data_sharing().off();  // it wants types of bounded size
  return qos;
}

/// UDP on 127.0.0.1, as ROS_LOCALHOST_ONLY=1 has it. Where multicast does not work on loopback, participants find each
/// other at the ports that the first ones of a domain have (DDS-RTPS 2.5, 9.6.1.1).
void keep_to_this_machine(dds::DomainParticipantQos& qos, std::uint32_t domain) {
  constexpr std::uint32_t participants = 16;
  constexpr std::uint32_t buffer_bytes = 4U << 20U;
  auto udp = std::make_shared<eprosima::fastdds::rtps::UDPv4TransportDescriptor>();
  udp->interfaceWhiteList.emplace_back("127.0.0.1");
  udp->sendBufferSize = buffer_bytes;
  udp->receiveBufferSize = buffer_bytes;
  qos.transport().use_builtin_transports = false;
  qos.transport().user_transports.push_back(std::move(udp));
  auto const& ports = qos.wire_protocol().port;
  for (std::uint32_t i = 0; i < participants; ++i) {
    rtps::Locator_t peer;
    rtps::IPLocator::setIPv4(peer, "127.0.0.1");
    peer.port = ports.portBase + ports.domainIDGain * domain + ports.offsetd1 + ports.participantIDGain * i;
    qos.wire_protocol().builtin.initialPeersList.push_back(peer);
  }
}

bool is_name(std::string_view topic) {
  auto const may_stand = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '/';
  };
  return topic.size() > 1 && topic.size() < 200 && topic.front() == '/' && topic.back() != '/' &&
         !topic.contains("//") && std::ranges::all_of(topic, may_stand);
}

}  // namespace

base::Result<std::string> dds_topic(std::string_view topic, Lane lane) {
  if (!is_name(topic))
    return base::fail(ErrorKind::invalid_input, fmt::format("\"{}\" is no topic", topic),
                      "a topic is like /robot1/scan: letters, digits, _ and single slashes, one of them first");
  switch (lane) {
    case Lane::topic: return fmt::format("rt{}", topic);
    case Lane::request: return fmt::format("rq{}Request", topic);
    case Lane::reply: return fmt::format("rr{}Reply", topic);
  }
  return fmt::format("rt{}", topic);
}

std::string dds_type(std::string_view type) {
  std::string name;
  auto rest = type;
  for (auto slash = rest.find('/'); slash != std::string_view::npos; slash = rest.find('/')) {
    name += fmt::format("{}::", rest.substr(0, slash));
    rest.remove_prefix(slash + 1);
  }
  return fmt::format("{}dds_::{}_", name, rest);
}

namespace {

/// Who reads what elsewhere. The middleware's threads find it out, and post it.
class ReadersElsewhere final : public dds::DomainParticipantListener {
 public:
  explicit ReadersElsewhere(base::Loop& loop)
      : inbox_(loop, most_waiting, base::Overflow::drop_newest), post_(inbox_.post()), scope_(loop) {
    scope_.spawn(take());
  }
  void on_subscriber_discovery(dds::DomainParticipant* /*participant*/, rtps::ReaderDiscoveryInfo&& found) override {
    (void)post_({.reader = found.info.guid(),
                 .is_gone = found.status == rtps::ReaderDiscoveryInfo::REMOVED_READER,
                 .topic = found.info.topicName().c_str(),
                 .type = found.info.typeName().c_str()});
  }
  [[nodiscard]] bool read(std::string_view topic, std::string_view type) const {
    return std::ranges::any_of(readers_,
                               [&](auto const& it) { return it.second.topic == topic && it.second.type == type; });
  }

 private:
  static constexpr std::size_t most_waiting = 10'000;
  struct Found {
    rtps::GUID_t reader;
    bool is_gone = false;
    std::string topic;
    std::string type;
  };
  base::Task<> take() {
    for (;;) {
      auto const found = co_await inbox_.receive(std::chrono::hours(1));
      if (!found) continue;
      if (found->is_gone)
        readers_.erase(found->reader);
      else
        readers_[found->reader] = *found;
    }
  }

  base::Inbox<Found> inbox_;
  base::Inbox<Found>::Post post_;
  std::map<rtps::GUID_t, Found> readers_;
  base::Scope scope_;
};

}  // namespace

struct Bus::Parts {
  ReadersElsewhere elsewhere;
  dds::DomainParticipant* participant = nullptr;
  dds::Publisher* publisher = nullptr;
  dds::Subscriber* subscriber = nullptr;
  std::map<std::string, dds::Topic*, std::less<>> topics = {};

  explicit Parts(base::Loop& loop) : elsewhere(loop) {}
  Parts(Parts const&) = delete;
  Parts& operator=(Parts const&) = delete;
  ~Parts() {
    if (!participant) return;
    participant->delete_contained_entities();
    dds::DomainParticipantFactory::get_instance()->delete_participant(participant);
  }

  base::Result<dds::Topic*> topic(std::string_view ros_name, std::string_view ros_type, Lane lane) {
    auto const name = dds_topic(ros_name, lane);
    if (!name) return std::unexpected(name.error());
    auto const type = dds_type(ros_type);
    if (auto const known = topics.find(*name); known != topics.end()) {
      if (known->second->get_type_name() == type) return known->second;
      auto const other_type = known->second->get_type_name();
      // Refused while anything here writes or reads it.
      if (participant->delete_topic(known->second) != Done::RETCODE_OK)
        return base::fail(ErrorKind::invalid_input, fmt::format("{} has the type {} already", ros_name, other_type));
      topics.erase(known);
    }
    dds::TypeSupport const support(new internal::RawType(type));  // which owns it
    bool const is_known = !participant->find_type(type).empty();  // by another topic
    if (!is_known && support.register_type(participant) != Done::RETCODE_OK)
      return base::fail(ErrorKind::io, fmt::format("the bus does not take the type {}", ros_type));
    auto* made = participant->create_topic(*name, type, dds::TOPIC_QOS_DEFAULT);
    if (!made) return base::fail(ErrorKind::io, fmt::format("the bus does not take the topic {}", ros_name));
    return topics.emplace(*name, made).first->second;
  }
};

namespace {

SampleIdentity identity_of(rtps::SampleIdentity const& theirs) {
  SampleIdentity identity;
  auto const& guid = theirs.writer_guid();
  auto const entity = std::ranges::copy(guid.guidPrefix.value, identity.writer.begin()).out;
  std::ranges::copy(guid.entityId.value, entity);
  // A number of DDS has two halves; that of nobody is -1 in the upper one.
  if (theirs.sequence_number() != rtps::SequenceNumber_t::unknown())
    identity.number = static_cast<std::int64_t>(theirs.sequence_number().to64long());
  return identity;
}

rtps::GUID_t guid_of(std::array<std::uint8_t, 16> const& bytes) {
  rtps::GUID_t guid;
  auto const entity = bytes.begin() + rtps::GuidPrefix_t::size;
  std::copy(bytes.begin(), entity, guid.guidPrefix.value);
  std::copy(entity, bytes.end(), guid.entityId.value);
  return guid;
}

rtps::SampleIdentity dds_identity_of(SampleIdentity const& ours) {
  rtps::SampleIdentity identity;
  identity.writer_guid(guid_of(ours.writer));
  if (ours.number > 0) identity.sequence_number(rtps::SequenceNumber_t(static_cast<std::uint64_t>(ours.number)));
  return identity;
}

base::UtcTime utc_of(rtps::Time_t const& time) {
  return base::UtcTime(std::chrono::duration_cast<base::UtcTime::duration>(std::chrono::nanoseconds(time.to_ns())));
}

class TopicWriter final : public Bus::Writer {
 public:
  TopicWriter(dds::Publisher& publisher, dds::DataWriter& writer) : publisher_(publisher), writer_(writer) {}
  TopicWriter(TopicWriter const&) = delete;
  TopicWriter& operator=(TopicWriter const&) = delete;
  /// What was written last is on its way still, on a thread of the middleware.
  ~TopicWriter() override {
    constexpr std::int32_t no_seconds = 0;
    constexpr std::uint32_t most_ns = 200'000'000;
    writer_.wait_for_acknowledgments({no_seconds, most_ns});
    publisher_.delete_datawriter(&writer_);
  }

  void write(std::string bytes) override { writer_.write(&bytes); }
  SampleIdentity write_related(std::string bytes, SampleIdentity const& related) override {
    rtps::WriteParams params;
    params.related_sample_identity(dds_identity_of(related));
    writer_.write(&bytes, params);
    return identity_of(params.sample_identity());
  }
  [[nodiscard]] int readers() const override {
    dds::PublicationMatchedStatus status;
    writer_.get_publication_matched_status(status);
    return status.current_count;
  }

 private:
  dds::Publisher& publisher_;
  dds::DataWriter& writer_;
};

/// Runs on the middleware's threads; what it posts comes on the loop.
class Listener final : public dds::DataReaderListener {
 public:
  explicit Listener(base::Inbox<Sample>::Post post) : post_(std::move(post)) {}
  void on_data_available(dds::DataReader* reader) override {
    std::string bytes;
    dds::SampleInfo about;
    while (reader->take_next_sample(&bytes, &about) == Done::RETCODE_OK) {
      if (about.valid_data)
        (void)post_({.bytes = std::move(bytes),
                     .identity = identity_of(about.sample_identity),
                     .related = identity_of(about.related_sample_identity),
                     .written = utc_of(about.source_timestamp)});
      bytes.clear();
    }
  }

 private:
  base::Inbox<Sample>::Post post_;
};

class TopicReader final : public Bus::Reader {
 public:
  TopicReader(base::Loop& loop, dds::Subscriber& subscriber, Profile profile, Bus::Heard heard)
      : inbox_(loop, static_cast<std::size_t>(depth_of(profile)), base::Overflow::drop_oldest),
        listener_(inbox_.post()),
        subscriber_(subscriber),
        heard_(std::move(heard)),
        scope_(loop) {
    scope_.spawn(tell());
  }
  TopicReader(TopicReader const&) = delete;
  TopicReader& operator=(TopicReader const&) = delete;
  ~TopicReader() override {
    if (reader_) subscriber_.delete_datareader(reader_);  // its threads call the listener no more
  }
  bool open(dds::Topic* topic, dds::DataReaderQos const& qos) {
    reader_ = subscriber_.create_datareader(topic, qos, &listener_);
    return reader_ != nullptr;
  }

  [[nodiscard]] int writers() const override {
    dds::SubscriptionMatchedStatus status;
    reader_->get_subscription_matched_status(status);
    return status.current_count;
  }
  [[nodiscard]] std::uint64_t dropped() const override { return inbox_.dropped(); }
  [[nodiscard]] std::array<std::uint8_t, 16> guid() const override {
    rtps::SampleIdentity identity;
    identity.writer_guid(reader_->guid());
    return identity_of(identity).writer;
  }

 private:
  base::Task<> tell() {
    for (;;) {
      auto const sample = co_await inbox_.receive(std::chrono::hours(1));
      if (sample) heard_(*sample);
    }
  }

  base::Inbox<Sample> inbox_;
  Listener listener_;
  dds::Subscriber& subscriber_;
  dds::DataReader* reader_ = nullptr;
  Bus::Heard heard_;
  base::Scope scope_;
};

}  // namespace

Bus::Bus(base::Loop& loop, std::unique_ptr<Parts> parts) : loop_(loop), parts_(std::move(parts)) {}

Bus::~Bus() = default;

base::Result<std::unique_ptr<Bus>> Bus::open(base::Loop& loop, BusOptions const& options) {
  if (options.domain > most_domain)
    return base::fail(ErrorKind::invalid_input, fmt::format("there is no domain {}", options.domain),
                      fmt::format("domains of ROS 2 are 0 to {}", most_domain));
  dds::DomainParticipantQos qos;
  qos.name(options.name);
  if (options.is_local) keep_to_this_machine(qos, options.domain);
  auto parts = std::make_unique<Parts>(loop);
  parts->participant = dds::DomainParticipantFactory::get_instance()->create_participant(
      options.domain, qos, &parts->elsewhere, dds::StatusMask::none());
  if (parts->participant) {
    parts->publisher = parts->participant->create_publisher(dds::PUBLISHER_QOS_DEFAULT);
    parts->subscriber = parts->participant->create_subscriber(dds::SUBSCRIBER_QOS_DEFAULT);
  }
  if (!parts->publisher || !parts->subscriber)
    return base::fail(ErrorKind::io, fmt::format("the bus does not open in domain {}", options.domain),
                      "other programs may have all of its ports; what Fast DDS says stands above");
  return std::unique_ptr<Bus>(new Bus(loop, std::move(parts)));
}

bool Bus::is_read_as(std::string_view topic, std::string_view type) const {
  auto const name = dds_topic(topic);
  return name && parts_->elsewhere.read(*name, dds_type(type));
}

base::Result<std::unique_ptr<Bus::Writer>> Bus::write_to(std::string_view topic, std::string_view type, Profile profile,
                                                         Lane lane) {
  auto const made = parts_->topic(topic, type, lane);
  if (!made) return std::unexpected(made.error());
  auto qos = qos_of<dds::DataWriterQos>(profile);
  // What came to a reader before it had found the writer is told again with the next heartbeat: by default after 3 s.
  constexpr std::uint32_t soon_ns = 200'000'000;
  qos.reliable_writer_qos().times.heartbeatPeriod = eprosima::fastrtps::Duration_t(0, soon_ns);
  // Messages of several packets cannot be written at once, and whoever writes has better things to do.
  qos.publish_mode().kind = dds::ASYNCHRONOUS_PUBLISH_MODE;
  auto* writer = parts_->publisher->create_datawriter(*made, qos);
  if (!writer) return base::fail(ErrorKind::io, fmt::format("{} cannot be written to", topic));
  return std::make_unique<TopicWriter>(*parts_->publisher, *writer);
}

base::Result<std::unique_ptr<Bus::Reader>> Bus::read_from(std::string_view topic, std::string_view type,
                                                          Profile profile, Heard heard, Lane lane) {
  auto const made = parts_->topic(topic, type, lane);
  if (!made) return std::unexpected(made.error());
  auto reader = std::make_unique<TopicReader>(loop_, *parts_->subscriber, profile, std::move(heard));
  if (!reader->open(*made, qos_of<dds::DataReaderQos>(profile)))
    return base::fail(ErrorKind::io, fmt::format("{} cannot be read from", topic));
  return reader;
}

}  // namespace lapwing::bus
