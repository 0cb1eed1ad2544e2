#include "mavlink/mission_transfer.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "mavlink/inbox.hpp"

namespace lapwing::mavlink {

using base::ErrorKind;
using base::fail;
using base::TimePoint;

namespace {

using namespace std::chrono_literals;

/// What a transfer is about, for its messages and its texts.
struct Party {
  Connection& connection;
  Address target;
  MissionType type;

  [[nodiscard]] TimePoint now() const { return connection.loop().now(); }
  [[nodiscard]] base::Result<> send(Message message) const { return connection.send(target, std::move(message)); }
  [[nodiscard]] std::string_view plural() const {
    if (type == MissionType::fence) return "fence items";
    return type == MissionType::rally ? "rally points" : "mission items";
  }
};

/// Messages of this kind of transfer that are meant for this station.
template <class... Ms>
Inbox::Wanted meant_for(Party const& party) {
  return [self = party.connection.self(), type = party.type](Message const& message) {
    auto const concerns = [&](auto const* m) { return m && m->type == type && addresses(m->target, self); };
    return (concerns(std::get_if<Ms>(&message)) || ...);
  };
}

/// How long until a message is repeated: as TCP does it (RFC 6298), with bounds that fit a vehicle's link. An
/// autopilot asks again for what it misses only after a second, so on a lossy link the ground's patience decides how
/// long a transfer takes.
class Patience {
 public:
  explicit Patience(TransferOptions const& options) : first_(options.reply_timeout) {}

  /// The answer to a message that went out once (Karn: an answer to a repeated one tells nothing).
  void measured(base::Duration round_trip) {
    auto const sample = base::to_seconds(round_trip);
    if (!is_measured_) {
      smoothed_s_ = sample;
      deviation_s_ = sample / 2;
      is_measured_ = true;
    } else {
      deviation_s_ = 0.75 * deviation_s_ + 0.25 * std::abs(smoothed_s_ - sample);
      smoothed_s_ = 0.875 * smoothed_s_ + 0.125 * sample;
    }
    repeats_ = 0;
  }
  /// Waits longer the next time, until something is measured again. Not much longer once the round trip is known: one
  /// small message at a time congests nothing, so silence then mostly means that it was lost.
  void repeated() { repeats_ = std::min(repeats_ + 1, is_measured_ ? 2 : 4); }
  /// The other side has moved on after a repetition: what was repeated was lost, or the round trip has become longer.
  void moved_on() { repeats_ = std::max(repeats_ - (is_measured_ ? 1 : 0), 0); }

  [[nodiscard]] base::Duration value() const {
    auto const once = is_measured_ ? base::from_seconds(smoothed_s_ + 4 * deviation_s_) : first_;
    return std::min(std::max<base::Duration>(once, shortest) * (1 << repeats_), longest);
  }

 private:
  static constexpr base::Duration shortest = 50ms;  // a few turns of an autopilot's telemetry loop
  // The protocol's own default. Beyond it too few tries would fit into what a vehicle waits before it gives up.
  static constexpr base::Duration longest = 1500ms;
  base::Duration first_;
  bool is_measured_ = false;
  double smoothed_s_ = 0.0;
  double deviation_s_ = 0.0;
  int repeats_ = 0;
};

/// Tells the vehicle that the transfer is off, if it ends (or is destroyed) before `settled()`.
class CancelNotice {
 public:
  explicit CancelNotice(Party party) : party_(party) {}
  CancelNotice(CancelNotice const&) = delete;
  CancelNotice& operator=(CancelNotice const&) = delete;
  ~CancelNotice() {
    if (!settled_) (void)party_.send(MissionAck{.result = MavMissionResult::operation_cancelled, .type = party_.type});
  }
  void settled() { settled_ = true; }

 private:
  Party party_;
  bool settled_ = false;
};

std::unexpected<base::Error> silent(Party const& party, std::string_view what) {
  return fail(ErrorKind::timed_out,
              fmt::format("vehicle {} fell silent during the {} of {}", party.target.system, what, party.plural()));
}

/// The vehicle's side of an upload as it appears here.
class Upload {
 public:
  Upload(Party party, std::vector<MissionItem> const& items, TransferOptions const& options,
         TransferProgress const& progress)
      : party_(party), items_(items), options_(options), progress_(progress), patience_(options) {}

  base::Task<base::Result<>> run();

 private:
  using Ended = std::optional<base::Result<>>;

  base::Result<> send_count();
  base::Result<> send_item(std::size_t seq);
  [[nodiscard]] Ended take_request(std::size_t seq);
  [[nodiscard]] Ended take_ack(MavMissionResult result);
  [[nodiscard]] Ended repeat();
  [[nodiscard]] Ended take_invalid_sequence();
  [[nodiscard]] bool begun() const { return last_sent_.has_value(); }
  [[nodiscard]] bool all_sent() const { return items_.empty() || last_sent_ == items_.size() - 1; }
  [[nodiscard]] base::Error refusal(MavMissionResult result) const;

  Party party_;
  std::vector<MissionItem> const& items_;
  TransferOptions const& options_;
  TransferProgress const& progress_;
  Patience patience_;
  int counts_sent_ = 0;
  std::optional<std::size_t> last_sent_;
  std::size_t sent_ = 0;        ///< how many items have gone out at least once
  bool last_repeated_ = false;  ///< the item sent last was sent before
  TimePoint count_sent_at_{};
  TimePoint advanced_at_{};    ///< when the item before the last one first went out
  TimePoint first_sent_at_{};  ///< when the last one first went out
  std::optional<MavMissionResult> doubtful_;
  std::size_t requested_ = 0;  ///< what the vehicle asked for last
  std::size_t guessed_ = 0;    ///< what it is taken to want now: that, or an item a little further on
};

base::Result<> Upload::send_count() {
  ++counts_sent_;
  count_sent_at_ = party_.now();
  return party_.send(MissionCount{.count = static_cast<std::uint16_t>(items_.size()), .type = party_.type});
}

base::Result<> Upload::send_item(std::size_t seq) {
  last_repeated_ = seq < sent_;
  if (!last_repeated_) {
    advanced_at_ = std::exchange(first_sent_at_, party_.now());
    sent_ = seq + 1;
  }
  last_sent_ = seq;
  MissionItem item = items_[seq];
  item.seq = static_cast<std::uint16_t>(seq);
  item.type = party_.type;
  item.form = ItemForm::integer;
  return party_.send(item);
}

/// ERROR to a repeated item is what a vehicle says that gave the upload up: that, like a cancellation, is worth another
/// round.
base::Error Upload::refusal(MavMissionResult result) const {
  bool const gave_up =
      result == MavMissionResult::operation_cancelled || (result == MavMissionResult::error && last_repeated_);
  auto const kind = gave_up ? ErrorKind::timed_out : ErrorKind::refused;
  if (!last_sent_)
    return {kind, fmt::format("vehicle {} refused {} {}: {}", party_.target.system, items_.size(), party_.plural(),
                              to_string(result))};
  return {kind, fmt::format("vehicle {} refused item {} ({}): {}", party_.target.system, *last_sent_,
                            to_string(items_[*last_sent_].command), to_string(result))};
}

Upload::Ended Upload::take_request(std::size_t seq) {
  if (seq >= items_.size()) return std::nullopt;  // of another transfer
  if (!begun() && counts_sent_ == 1) {
    patience_.measured(party_.now() - count_sent_at_);
  } else if (begun() && seq == *last_sent_ + 1 && !last_repeated_ && guessed_ == requested_) {
    patience_.measured(party_.now() - first_sent_at_);
  } else if (begun() && seq != *last_sent_) {
    patience_.moved_on();
  }
  requested_ = guessed_ = seq;
  if (auto sent = send_item(seq); !sent) return sent;
  if (progress_) progress_(seq, items_.size());
  return std::nullopt;
}

/// Answers that late repetitions provoke must not end a good transfer, nor must the last word of an earlier one.
Upload::Ended Upload::take_ack(MavMissionResult result) {
  switch (result) {
    case MavMissionResult::accepted:
      if (all_sent()) return base::Result<>{};
      return std::nullopt;
    case MavMissionResult::invalid_sequence: return take_invalid_sequence();
    case MavMissionResult::operation_cancelled:
      if (!begun()) return std::nullopt;
      break;
    case MavMissionResult::error: {
      if (!begun() || !all_sent()) {
        doubtful_ = result;  // it counts if nothing follows
        return std::nullopt;
      }
      // ArduPilot says ERROR to a repeated last item when it has finished and its acknowledgement was lost. It cannot
      // have given up instead as long as its own limit, which began no earlier than the item before went out, has not
      // passed.
      bool const may_have_given_up = party_.now() - advanced_at_ >= options_.silence_limit;
      if (last_repeated_ && party_.type == MissionType::mission && !may_have_given_up) return base::Result<>{};
      break;
    }
    default: break;
  }
  return std::unexpected(refusal(result));
}

/// ArduPilot says so to an item that it has already: if that was a repetition, the request for the next one was lost.
/// The next one goes out at once, since the vehicle would repeat its request only after a second. It is a guess (the
/// answer can be to an older repetition), so it never goes far ahead of the requests.
Upload::Ended Upload::take_invalid_sequence() {
  constexpr std::size_t farthest_lead = 3;
  if (!begun() || !last_repeated_) return std::nullopt;
  if (*last_sent_ == guessed_) {
    if (guessed_ + 1 == items_.size() || guessed_ - requested_ == farthest_lead) return std::nullopt;
    ++guessed_;
  }
  if (auto sent = send_item(guessed_); !sent) return sent;
  return std::nullopt;
}

Upload::Ended Upload::repeat() {
  patience_.repeated();
  if (begun()) {
    // After a wrong guess the vehicle still waits for what it asked for: take turns.
    if (auto sent = send_item(*last_sent_ == guessed_ && last_repeated_ ? requested_ : guessed_); !sent) return sent;
    return std::nullopt;
  }
  if (counts_sent_ == options_.tries) {
    if (doubtful_) return std::unexpected(refusal(*doubtful_));
    return silent(party_, "upload");
  }
  if (auto sent = send_count(); !sent) return sent;
  return std::nullopt;
}

base::Task<base::Result<>> Upload::run() {
  Inbox inbox(party_.connection, party_.target.system,
              meant_for<MissionRequest, MissionRequestInt, MissionAck>(party_));
  if (auto sent = send_count(); !sent) co_return sent;
  CancelNotice notice(party_);
  auto heard = party_.now();
  for (;;) {
    auto const got = co_await inbox.next(party_.now() + patience_.value());
    Ended ended;
    if (!got) {
      if (begun() && party_.now() - heard >= options_.silence_limit) {
        if (doubtful_) co_return std::unexpected(refusal(*doubtful_));
        co_return silent(party_, "upload");
      }
      ended = repeat();
    } else {
      // Only its requests show that the vehicle is still at it: one that gave up refuses every item that comes late.
      if (!std::holds_alternative<MissionAck>(*got)) heard = party_.now();
      if (auto const* ack = std::get_if<MissionAck>(&*got))
        ended = take_ack(ack->result);
      else if (auto const* request = std::get_if<MissionRequest>(&*got))
        ended = take_request(request->seq);
      else
        ended = take_request(std::get<MissionRequestInt>(*got).seq);
    }
    if (!ended) continue;
    if (*ended || ended->error().kind == ErrorKind::refused) notice.settled();
    co_return *ended;
  }
}

/// A message that repeats nothing but itself may be repeated for as long as all rounds of an upload may take.
class Attempts {
 public:
  Attempts(TimePoint now, TransferOptions const& options)
      : left_(options.tries * (1 + options.restarts)), until_(now + options.silence_limit * (1 + options.restarts)) {}
  [[nodiscard]] bool another(TimePoint now) { return left_-- > 0 || now < until_; }

 private:
  int left_;
  TimePoint until_;
};

/// A refusal that a download or a clear must take seriously; the others can be late answers to an upload before it.
bool is_final(MavMissionResult result) {
  return result != MavMissionResult::accepted && result != MavMissionResult::invalid_sequence &&
         result != MavMissionResult::error;
}

std::unexpected<base::Error> refused(Party const& party, std::string_view what, MavMissionResult result) {
  return fail(ErrorKind::refused, fmt::format("vehicle {} refused the {} of {}: {}", party.target.system, what,
                                              party.plural(), to_string(result)));
}

/// Sends `request` until a message comes that `fits`; refusals end it.
base::Task<base::Result<Message>> ask(Party const& party, Inbox& inbox, Message request,
                                      std::function<bool(Message const&)> fits, Patience& patience,
                                      TransferOptions const& options) {
  bool first = true;
  for (Attempts attempts(party.now(), options); attempts.another(party.now()); first = false) {
    if (!first) patience.repeated();
    if (auto sent = party.send(request); !sent) co_return std::unexpected(sent.error());
    auto const sent_at = party.now();
    auto const deadline = sent_at + patience.value();
    for (;;) {
      auto got = co_await inbox.next(deadline);
      if (!got) break;
      if (fits(*got)) {
        if (first)
          patience.measured(party.now() - sent_at);
        else
          patience.moved_on();
        co_return std::move(*got);
      }
      auto const* ack = std::get_if<MissionAck>(&*got);
      if (ack && is_final(ack->result)) co_return refused(party, "download", ack->result);
    }
  }
  co_return silent(party, "download");
}

}  // namespace

base::Task<base::Result<>> upload_mission(Connection& connection, Address target, std::vector<MissionItem> items,
                                          MissionType type, TransferOptions options, TransferProgress progress) {
  base::Result<> result;
  for (int round = 0; round <= options.restarts; ++round) {
    Upload upload({connection, target, type}, items, options, progress);
    result = co_await upload.run();
    if (result && progress) progress(items.size(), items.size());
    if (result || result.error().kind != ErrorKind::timed_out) break;
  }
  co_return result;
}

base::Task<base::Result<std::vector<MissionItem>>> download_mission(Connection& connection, Address target,
                                                                    MissionType type, TransferOptions options,
                                                                    TransferProgress progress) {
  Party const party{connection, target, type};
  Patience patience(options);
  Inbox inbox(connection, target.system, meant_for<MissionCount, MissionItem, MissionAck>(party));

  Message const list = MissionRequestList{.type = type};
  std::function<bool(Message const&)> const is_count = [](Message const& m) {
    return std::holds_alternative<MissionCount>(m);
  };
  auto const count = co_await ask(party, inbox, list, is_count, patience, options);
  if (!count) co_return std::unexpected(count.error());

  auto const total = std::get<MissionCount>(*count).count;
  std::vector<MissionItem> items;
  items.reserve(total);
  for (std::uint16_t seq = 0; seq < total; ++seq) {
    Message const request = MissionRequestInt{.seq = seq, .type = type};
    std::function<bool(Message const&)> const is_it = [seq](Message const& m) {
      auto const* item = std::get_if<MissionItem>(&m);
      return item && item->seq == seq;
    };
    auto const item = co_await ask(party, inbox, request, is_it, patience, options);
    if (!item) co_return std::unexpected(item.error());
    items.push_back(std::get<MissionItem>(*item));
    if (progress) progress(items.size(), total);
  }
  (void)party.send(MissionAck{.type = type});  // a courtesy that needs no answer
  co_return items;
}

base::Task<base::Result<>> clear_mission(Connection& connection, Address target, MissionType type,
                                         TransferOptions options) {
  Party const party{connection, target, type};
  Inbox acks(connection, target.system, meant_for<MissionAck>(party));
  std::optional<MavMissionResult> answered;
  for (Attempts attempts(party.now(), options); attempts.another(party.now());) {
    if (auto sent = party.send(MissionClearAll{.type = type}); !sent) co_return sent;
    auto const got = co_await acks.next(party.now() + options.reply_timeout);
    if (!got) continue;
    answered = std::get<MissionAck>(*got).result;
    if (*answered == MavMissionResult::accepted) co_return base::Result<>{};
    if (is_final(*answered)) break;
  }
  if (answered) co_return refused(party, "clearing", *answered);
  co_return silent(party, "clearing");
}

}  // namespace lapwing::mavlink
