#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "bus/cdr/cdr.hpp"
#include "bus/participant/bus.hpp"

/// Typed ends of services, as ROS 2's Fast DDS middleware has them: a topic of requests and one of replies. Which
/// request a reply answers goes beside it (DDS-RPC's related sample identity), not in it. A request names the reader of
/// its replies there; where it names none, the reply names the request's writer.
///
/// ROS on Cyclone DDS puts the identity into the message instead, so its services and ours do not meet.
namespace lapwing::bus {

template <class S>
concept Service = requires { S::name; } && Message<typename S::Request> && Message<typename S::Response>;

/// A request that waits for its reply.
template <Service S>
struct Call {
  S::Request request;
  base::UtcTime asked{};  ///< by the asker's clock
  /// Once, now or later; after the server has gone nothing happens.
  std::function<void(typename S::Response const&)> reply;
};

template <Service S>
class ServiceServer {
 public:
  /// `called` is called on the loop; what is no whole request is left out. Errors: as of `Bus::write_to`.
  [[nodiscard]] static base::Result<ServiceServer> open(Bus& bus, std::string_view service,
                                                        std::function<void(Call<S>)> called) {
    auto opened = bus.write_to(service, Description<typename S::Response>::name, Profile::standard, Lane::reply);
    if (!opened) return std::unexpected(opened.error());
    std::shared_ptr<Bus::Writer> replies = *std::move(opened);
    auto requests = bus.read_from(
        service, Description<typename S::Request>::name, Profile::standard,
        [called = std::move(called), to = std::weak_ptr(replies)](Sample const& sample) {
          auto request = decode<typename S::Request>(sample.bytes);
          if (!request) return;
          SampleIdentity asker = sample.identity;
          if (sample.related.writer != SampleIdentity().writer) asker.writer = sample.related.writer;
          called({.request = *std::move(request),
                  .asked = sample.written,
                  .reply = [to, asker](S::Response const& response) {
                    if (auto const writer = to.lock()) (void)writer->write_related(encode(response), asker);
                  }});
        },
        Lane::request);
    if (!requests) return std::unexpected(requests.error());
    return ServiceServer(std::move(replies), *std::move(requests));
  }

 private:
  ServiceServer(std::shared_ptr<Bus::Writer> replies, std::unique_ptr<Bus::Reader> requests)
      : replies_(std::move(replies)), requests_(std::move(requests)) {}
  std::shared_ptr<Bus::Writer> replies_;
  std::unique_ptr<Bus::Reader> requests_;
};

template <Service S>
class ServiceClient {
 public:
  /// `answered` is called on the loop with the number that `call` gave. Errors: as of `Bus::write_to`.
  [[nodiscard]] static base::Result<ServiceClient> open(
      Bus& bus, std::string_view service,
      std::function<void(std::int64_t call, typename S::Response const&)> answered) {
    auto requests = bus.write_to(service, Description<typename S::Request>::name, Profile::standard, Lane::request);
    if (!requests) return std::unexpected(requests.error());
    auto const own = std::make_shared<Own>();
    auto replies = bus.read_from(
        service, Description<typename S::Response>::name, Profile::standard,
        [answered = std::move(answered), own](Sample const& sample) {
          if (sample.related.writer != own->reader && sample.related.writer != own->writer) return;
          if (auto const response = decode<typename S::Response>(sample.bytes))
            answered(sample.related.number, *response);
        },
        Lane::reply);
    if (!replies) return std::unexpected(replies.error());
    own->reader = (*replies)->guid();
    return ServiceClient(*std::move(requests), *std::move(replies), own);
  }

  /// Returns the number of the call. A server that is not there yet does not hear it.
  std::int64_t call(S::Request const& request) {
    auto const identity = requests_->write_related(encode(request), {.writer = own_->reader});
    own_->writer = identity.writer;
    return identity.number;
  }
  /// A server hears the requests and its replies come back.
  [[nodiscard]] bool is_ready() const { return requests_->readers() > 0 && replies_->writers() > 0; }

 private:
  struct Own {
    std::array<std::uint8_t, 16> reader = {};  ///< of the replies
    std::array<std::uint8_t, 16> writer = {};  ///< of the requests
  };
  ServiceClient(std::unique_ptr<Bus::Writer> requests, std::unique_ptr<Bus::Reader> replies, std::shared_ptr<Own> own)
      : requests_(std::move(requests)), replies_(std::move(replies)), own_(std::move(own)) {}
  std::unique_ptr<Bus::Writer> requests_;
  std::unique_ptr<Bus::Reader> replies_;
  std::shared_ptr<Own> own_;
};

}  // namespace lapwing::bus
