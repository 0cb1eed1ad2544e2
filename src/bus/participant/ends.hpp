#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "bus/participant/services.hpp"
#include "bus/participant/topics.hpp"

namespace lapwing::bus {

/// Subscriptions of whatever types, for who only wants to hear.
using Subscriptions = std::vector<std::shared_ptr<void>>;

/// Opens many ends of topics and services, and remembers the first error. After one nothing more is opened.
class Ends {
 public:
  explicit Ends(Bus& bus) : bus_(bus) {}

  template <Message M>
  void hear(Subscriptions& kept, std::string_view topic, Profile profile, std::function<void(M const&)> heard) {
    std::optional<Subscription<M>> opened;
    take(opened, [&] { return Subscription<M>::open(bus_, topic, profile, std::move(heard)); });
    if (opened) kept.push_back(std::make_shared<Subscription<M>>(*std::move(opened)));
  }
  template <Message M>
  void say(std::optional<Publisher<M>>& into, std::string_view topic, Profile profile) {
    take(into, [&] { return Publisher<M>::open(bus_, topic, profile); });
  }
  template <Service S>
  void serve(std::optional<ServiceServer<S>>& into, std::string_view name, std::function<void(Call<S>)> called) {
    take(into, [&] { return ServiceServer<S>::open(bus_, name, std::move(called)); });
  }
  template <Service S>
  void ask(std::optional<ServiceClient<S>>& into, std::string_view name,
           std::function<void(std::int64_t, typename S::Response const&)> answered) {
    take(into, [&] { return ServiceClient<S>::open(bus_, name, std::move(answered)); });
  }
  [[nodiscard]] base::Result<> result() const { return result_; }

 private:
  template <class T, class Open>
  void take(std::optional<T>& into, Open const& open) {
    if (!result_) return;
    auto opened = open();
    if (opened)
      into.emplace(*std::move(opened));
    else
      result_ = std::unexpected(opened.error());
  }

  Bus& bus_;
  base::Result<> result_ = {};
};

}  // namespace lapwing::bus
