#include "mavlink/exchange/param_list.hpp"

#include <algorithm>
#include <bit>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "mavlink/connection/inbox.hpp"
#include "mavlink/exchange/internal/smoothed.hpp"

namespace lapwing::mavlink {

using base::Duration;
using base::ErrorKind;
using base::fail;
using base::TimePoint;
using internal::Smoothed;

namespace {

using namespace std::chrono_literals;

constexpr std::uint16_t outside_the_list = 65535;
constexpr Duration first_list_wait = 1500ms;
constexpr Duration longest_list_wait = 6s;
constexpr Duration longest_look = 100ms;  ///< `may_send` may have come true

/// One list as it fills.
class Download {
 public:
  Download(Connection& connection, Address target, ParamListOptions const& options, ParamProgress const& progress)
      : connection_(connection), target_(target), options_(options), progress_(progress) {}

  base::Task<base::Result<ParamList>> run();

 private:
  struct Request {
    TimePoint sent;
    bool is_repeated = false;
  };

  [[nodiscard]] TimePoint now() const { return connection_.loop().now(); }
  [[nodiscard]] bool complete() const { return !values_.empty() && missing_ == 0; }
  [[nodiscard]] bool streaming() const { return stream_until_ > now(); }
  [[nodiscard]] Duration request_wait() const;
  [[nodiscard]] TimePoint next_look() const;
  [[nodiscard]] bool list_is_due() const;
  base::Result<> ask_for_list();
  base::Result<> ask_for_holes();
  void take(ParamValue const& value);
  void take_numbered(ParamValue const& value);
  void begin_anew(std::size_t count);

  Connection& connection_;
  Address target_;
  ParamListOptions const& options_;
  ParamProgress const& progress_;
  std::vector<std::optional<Parameter>> values_;
  std::size_t missing_ = 0;
  std::optional<std::uint32_t> hash_;
  std::map<std::size_t, Request> in_flight_;
  Smoothed round_trip_;
  Smoothed interval_;     ///< of the stream
  TimePoint advanced_{};  ///< when something new came last, or could not
  TimePoint last_value_{};
  TimePoint stream_until_{};
  TimePoint list_asked_{};
  Duration list_wait_ = first_list_wait;
  int lists_ = 0;            ///< asked for
  TimePoint holes_since_{};  ///< since then holes have been asked for one by one
  std::size_t answers_ = 0;  ///< that have come since then
};

Duration Download::request_wait() const {
  constexpr Duration turn = 20ms;  // of an autopilot's loop: on top of a round trip that never varied
  constexpr Duration longest = 3s;
  constexpr Duration unmeasured = 500ms;
  if (!round_trip_.is_measured()) return unmeasured;
  return std::min<Duration>(round_trip_.bound() + turn, longest);
}

/// A vehicle that has not begun is asked again. One that has, too, when so much got lost that another go would be
/// quicker: ArduPilot sends 1500 a second of its own accord and answers 50 requests.
bool Download::list_is_due() const {
  constexpr int most_lists = 10;
  constexpr std::size_t enough_to_judge = 10;
  constexpr double start_s = 0.3;
  if (values_.empty()) return lists_ == 0 || now() >= list_asked_ + list_wait_;
  if (streaming() || answers_ < enough_to_judge || lists_ == most_lists) return false;
  auto const each_s = base::to_seconds(now() - holes_since_) / static_cast<double>(answers_);
  auto const list_s = interval_.mean_s() * static_cast<double>(values_.size());
  return each_s * static_cast<double>(missing_) > list_s + start_s;
}

base::Result<> Download::ask_for_list() {
  if (values_.empty() && lists_ > 0) list_wait_ = std::min<Duration>(2 * list_wait_, longest_list_wait);
  ++lists_;
  list_asked_ = now();
  last_value_ = {};
  answers_ = 0;
  in_flight_.clear();
  stream_until_ = now() + (values_.empty() ? list_wait_ : 2 * request_wait());
  return connection_.send(target_, ParamRequestList{});
}

void Download::begin_anew(std::size_t count) {
  values_.assign(count, std::nullopt);
  missing_ = count;
  in_flight_.clear();
}

/// The vehicle numbers its parameters anew when one switches others on: then the list begins again.
void Download::take(ParamValue const& value) {
  if (value.name == hash_param) {
    hash_ = std::bit_cast<std::uint32_t>(value.value);
    return;
  }
  if (value.index != outside_the_list && value.count > 0) {
    if (value.count != values_.size()) begin_anew(value.count);
    if (value.index < values_.size()) take_numbered(value);
    return;
  }
  // Changed by itself or by somebody else: what the list said before is old.
  auto const old = std::ranges::find_if(values_, [&](auto const& known) { return known && known->name == value.name; });
  if (old != values_.end()) **old = decode_param(value, options_.encoding);
}

void Download::take_numbered(ParamValue const& value) {
  std::size_t const index = value.index;
  if (auto const request = in_flight_.find(index); request != in_flight_.end()) {
    if (!request->second.is_repeated) round_trip_.add(now() - request->second.sent);
    in_flight_.erase(request);
    ++answers_;
  } else if (streaming()) {
    if (last_value_ != TimePoint{}) interval_.add(now() - last_value_);
    last_value_ = now();
    bool const is_last = index + 1 == values_.size();
    auto const gap = std::clamp<Duration>(100ms + 8 * interval_.bound(), 150ms, 2s);
    stream_until_ = is_last ? now() : now() + gap;
  }
  auto& known = values_[index];
  if (!known) {
    --missing_;
    advanced_ = now();
  }
  known = decode_param(value, options_.encoding);
  if (progress_) progress_(values_.size() - missing_, values_.size());
}

/// Not while the list streams: ArduPilot answers before it goes on with the list, which would hardly come any more.
base::Result<> Download::ask_for_holes() {
  if (streaming()) return {};
  if (in_flight_.empty() && answers_ == 0) holes_since_ = now();
  auto const wait = request_wait();
  auto const send = [&](std::size_t index) {
    return connection_.send(target_, ParamRequestRead{.index = static_cast<std::int16_t>(index)});
  };
  for (auto& [index, request] : in_flight_) {
    if (now() < request.sent + wait) continue;
    request = {now(), true};
    if (auto sent = send(index); !sent) return sent;
  }
  for (std::size_t index = 0; index < values_.size() && in_flight_.size() < options_.in_flight; ++index) {
    if (values_[index] || in_flight_.contains(index)) continue;
    in_flight_[index] = {now()};
    if (auto sent = send(index); !sent) return sent;
  }
  return {};
}

TimePoint Download::next_look() const {
  auto next = now() + longest_look;
  for (auto const& [index, request] : in_flight_) next = std::min(next, request.sent + request_wait());
  if (streaming()) next = std::min(next, stream_until_);
  return std::max(next, now() + 1ms);
}

base::Task<base::Result<ParamList>> Download::run() {
  Inbox inbox(connection_, target_, wanting<ParamValue>([](ParamValue const&) { return true; }));
  advanced_ = now();
  while (!complete()) {
    bool const may_send = !options_.may_send || options_.may_send();
    if (may_send) {
      auto const sent = list_is_due() ? ask_for_list() : ask_for_holes();
      if (!sent) co_return std::unexpected(sent.error());
    } else {
      advanced_ = now();
    }
    if (now() - advanced_ >= options_.silence_limit)
      co_return fail(ErrorKind::timed_out,
                     values_.empty() ? fmt::format("vehicle {} did not send its parameters", target_.system)
                                     : fmt::format("vehicle {} fell silent after {} of {} parameters", target_.system,
                                                   values_.size() - missing_, values_.size()),
                     "check the link");
    auto const got = co_await inbox.next(may_send ? next_look() : now() + longest_look);
    if (got) take(std::get<ParamValue>(*got));
  }
  ParamList list{.parameters = {}, .hash = hash_};
  list.parameters.reserve(values_.size());
  for (auto& value : values_) list.parameters.push_back(std::move(*value));
  co_return list;
}

}  // namespace

base::Task<base::Result<ParamList>> download_params(Connection& connection, Address target, ParamListOptions options,
                                                    ParamProgress progress) {
  Download download(connection, target, options, progress);
  co_return co_await download.run();
}

}  // namespace lapwing::mavlink
