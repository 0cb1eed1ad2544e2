#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "bus/cdr/cdr.hpp"
#include "bus/participant/bus.hpp"

/// Typed ends of topics.
namespace lapwing::bus {

template <Message M>
class Publisher {
 public:
  [[nodiscard]] static base::Result<Publisher> open(Bus& bus, std::string_view topic, Profile profile) {
    auto writer = bus.write_to(topic, Description<M>::name, profile);
    if (!writer) return std::unexpected(writer.error());
    return Publisher(*std::move(writer));
  }
  void publish(M const& message) { writer_->write(encode(message)); }
  [[nodiscard]] int readers() const { return writer_->readers(); }

 private:
  explicit Publisher(std::unique_ptr<Bus::Writer> writer) : writer_(std::move(writer)) {}
  std::unique_ptr<Bus::Writer> writer_;
};

template <Message M>
class Subscription {
 public:
  /// `heard` is called on the loop; what is no whole message is counted and left out.
  [[nodiscard]] static base::Result<Subscription> open(Bus& bus, std::string_view topic, Profile profile,
                                                       std::function<void(M const&)> heard) {
    auto malformed = std::make_shared<std::uint64_t>(0);
    auto reader = bus.read_from(topic, Description<M>::name, profile,
                                [heard = std::move(heard), malformed](Sample const& sample) {
                                  if (auto const message = decode<M>(sample.bytes))
                                    heard(*message);
                                  else
                                    ++*malformed;
                                });
    if (!reader) return std::unexpected(reader.error());
    return Subscription(*std::move(reader), std::move(malformed));
  }
  [[nodiscard]] int writers() const { return reader_->writers(); }
  [[nodiscard]] std::uint64_t dropped() const { return reader_->dropped(); }
  [[nodiscard]] std::uint64_t malformed() const { return *malformed_; }

 private:
  Subscription(std::unique_ptr<Bus::Reader> reader, std::shared_ptr<std::uint64_t> malformed)
      : reader_(std::move(reader)), malformed_(std::move(malformed)) {}
  std::unique_ptr<Bus::Reader> reader_;
  std::shared_ptr<std::uint64_t> malformed_;
};

}  // namespace lapwing::bus
