#include "mavlink/exchange/mission_transfer.hpp"

#include <utility>

#include "mavlink/exchange/internal/transfer_parts.hpp"

namespace lapwing::mavlink {

using base::ErrorKind;
using base::TimePoint;
using internal::Attention;
using internal::meant_for;
using internal::Outage;
using internal::RetransmitTimer;
using internal::silent;
using internal::TransferTarget;

namespace {

/// Tells the vehicle that the transfer is off, if it ends (or is destroyed) before `settled()`.
class CancelNotice {
 public:
  explicit CancelNotice(TransferTarget transfer) : target_(transfer) {}
  CancelNotice(CancelNotice const&) = delete;
  CancelNotice& operator=(CancelNotice const&) = delete;
  // NOLINTNEXTLINE(bugprone-exception-escape): nothing throws there but for want of memory, which ends the program.
  ~CancelNotice() {
    if (!settled_)
      (void)target_.send(MissionAck{.result = MavMissionResult::operation_cancelled, .type = target_.type});
  }
  void settled() { settled_ = true; }

 private:
  TransferTarget target_;
  bool settled_ = false;
};

/// The vehicle's side of an upload as it appears here.
class Upload {
 public:
  /// Less than all items are written over those that the vehicle holds there.
  Upload(TransferTarget transfer, std::vector<MissionItem> const& items, ItemRange range,
         TransferOptions const& options, TransferProgress const& progress, Attention& attention)
      : target_(transfer),
        items_(items),
        first_(range.first),
        end_(range.end),
        options_(options),
        progress_(progress),
        attention_(attention),
        retransmit_(retransmit_timer(transfer, options)) {}

  base::Task<base::Result<>> run();

 private:
  using Ended = std::optional<base::Result<>>;

  base::Result<> send_opening();
  base::Result<> send_item(std::size_t seq);
  [[nodiscard]] Ended take(Message const& message);
  [[nodiscard]] Ended take_request(std::size_t seq);
  [[nodiscard]] Ended take_ack(MavMissionResult result);
  [[nodiscard]] Ended repeat();
  [[nodiscard]] Ended take_invalid_sequence();
  [[nodiscard]] bool begun() const { return last_sent_.has_value(); }
  [[nodiscard]] bool all_sent() const { return items_.empty() || last_sent_ == end_ - 1; }
  [[nodiscard]] bool is_part() const { return end_ - first_ < items_.size(); }
  [[nodiscard]] base::Error refusal(MavMissionResult result) const;
  [[nodiscard]] std::unexpected<base::Error> unasked() const;

  TransferTarget target_;
  std::vector<MissionItem> const& items_;
  std::size_t first_;
  std::size_t end_;
  TransferOptions const& options_;
  TransferProgress const& progress_;
  Attention& attention_;
  RetransmitTimer retransmit_;
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

base::Result<> Upload::send_opening() {
  ++counts_sent_;
  attention_.asked();
  count_sent_at_ = target_.now();
  if (is_part())
    return target_.send(MissionWritePartialList{
        .start = static_cast<std::int16_t>(first_), .end = static_cast<std::int16_t>(end_ - 1), .type = target_.type});
  return target_.send(MissionCount{.count = static_cast<std::uint16_t>(items_.size()), .type = target_.type});
}

base::Result<> Upload::send_item(std::size_t seq) {
  last_repeated_ = seq < sent_;
  if (!last_repeated_) {
    advanced_at_ = std::exchange(first_sent_at_, target_.now());
    sent_ = seq + 1;
  }
  last_sent_ = seq;
  MissionItem item = items_[seq];
  item.seq = static_cast<std::uint16_t>(seq);
  item.type = target_.type;
  item.form = ItemForm::integer;
  return target_.send(item);
}

/// ERROR to a repeated item is what a vehicle says that gave the upload up: that, like a cancellation, is worth another
/// round.
base::Error Upload::refusal(MavMissionResult result) const {
  bool const gave_up =
      result == MavMissionResult::operation_cancelled || (result == MavMissionResult::error && last_repeated_);
  auto const kind = gave_up ? ErrorKind::timed_out : ErrorKind::refused;
  if (!last_sent_)
    return {kind, fmt::format("vehicle {} refused {} {}: {}", target_.target.system, items_.size(), target_.plural(),
                              to_string(result))};
  return {kind, fmt::format("vehicle {} refused item {} ({}): {}", target_.target.system, *last_sent_,
                            to_string(items_[*last_sent_].command), to_string(result))};
}

/// Nothing more comes: the vehicle is not heard any more, or is heard and asks for nothing.
std::unexpected<base::Error> Upload::unasked() const {
  auto const heard = target_.connection.last_heard(target_.target);
  if (!heard || target_.now() - *heard >= internal::beats_missed) return silent(target_, "upload");
  return base::fail(ErrorKind::timed_out,
                    fmt::format("vehicle {} stopped asking for {}: the last that it wanted was item {}, of {}",
                                target_.target.system, target_.plural(), requested_, items_.size()));
}

Upload::Ended Upload::take_request(std::size_t seq) {
  if (seq < first_ || seq >= end_) return std::nullopt;  // of another transfer
  if (!begun() && counts_sent_ == 1) {
    retransmit_.measured(target_.now() - count_sent_at_);
  } else if (begun() && seq == *last_sent_ + 1 && !last_repeated_ && guessed_ == requested_) {
    retransmit_.measured(target_.now() - first_sent_at_);
  } else if (begun() && seq != *last_sent_) {
    retransmit_.moved_on();
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
      if (!begun() && is_part()) break;
      if (!begun() || !all_sent()) {
        doubtful_ = result;  // it counts if nothing follows
        return std::nullopt;
      }
      // ArduPilot says ERROR to a repeated last item when it has finished and its acknowledgement was lost. It cannot
      // have given up instead as long as its own limit, which began no earlier than the item before went out, has not
      // passed.
      bool const may_have_given_up = target_.now() - advanced_at_ >= options_.silence_limit;
      if (last_repeated_ && target_.type == MissionType::mission && !may_have_given_up) return base::Result<>{};
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
    if (guessed_ + 1 == end_ || guessed_ - requested_ == farthest_lead) return std::nullopt;
    ++guessed_;
  }
  if (auto sent = send_item(guessed_); !sent) return sent;
  return std::nullopt;
}

Upload::Ended Upload::repeat() {
  retransmit_.repeated();
  if (begun()) {
    // After a wrong guess the vehicle still waits for what it asked for: take turns.
    if (auto sent = send_item(*last_sent_ == guessed_ && last_repeated_ ? requested_ : guessed_); !sent) return sent;
    return std::nullopt;
  }
  if (attention_.is_denied()) return attention_.denial();
  if (counts_sent_ == options_.tries) {
    if (doubtful_) return std::unexpected(refusal(*doubtful_));
    return silent(target_, "upload");
  }
  if (auto sent = send_opening(); !sent) return sent;
  return std::nullopt;
}

Upload::Ended Upload::take(Message const& message) {
  attention_.answered();
  if (auto const* ack = std::get_if<MissionAck>(&message)) return take_ack(ack->result);
  if (auto const* request = std::get_if<MissionRequest>(&message)) return take_request(request->seq);
  return take_request(std::get<MissionRequestInt>(message).seq);
}

base::Task<base::Result<>> Upload::run() {
  Inbox inbox(target_.connection, target_.target, meant_for<MissionRequest, MissionRequestInt, MissionAck>(target_));
  if (auto sent = send_opening(); !sent) co_return sent;
  CancelNotice notice(target_);
  auto heard = target_.now();
  for (;;) {
    auto const got = co_await inbox.next(target_.now() + retransmit_.value());
    Ended ended;
    if (!got) {
      if (begun() && target_.now() - heard >= options_.silence_limit) {
        if (doubtful_) co_return std::unexpected(refusal(*doubtful_));
        co_return unasked();
      }
      ended = repeat();
    } else {
      // Only its requests show that the vehicle is still at it: one that gave up refuses every item that comes late.
      if (!std::holds_alternative<MissionAck>(*got)) heard = target_.now();
      ended = take(*got);
    }
    if (!ended) continue;
    if (*ended || ended->error().kind == ErrorKind::refused) notice.settled();
    co_return *ended;
  }
}

}  // namespace

base::Task<base::Result<>> upload_mission(Connection& connection, Address target, std::vector<MissionItem> items,
                                          MissionType type, TransferOptions options, TransferProgress progress) {
  base::Result<> result;
  TransferTarget const transfer{connection, target, type};
  Attention attention(transfer);
  Outage outage(connection, target.system, options);
  for (int round = 0; round <= options.restarts; ++round) {
    Upload upload(transfer, items, {0, items.size()}, options, progress, attention);
    result = co_await upload.run();
    if (result && progress) progress(items.size(), items.size());
    if (result) break;
    bool const is_down = result.error().kind == ErrorKind::lost;
    if (!is_down && result.error().kind != ErrorKind::timed_out) break;
    if (co_await outage.is_over(is_down))
      round = -1;
    else if (is_down || attention.is_denied())
      break;
  }
  co_return result;
}

base::Task<base::Result<>> upload_part(Connection& connection, Address target, std::vector<MissionItem> items,
                                       ItemRange range, MissionType type, TransferOptions options,
                                       TransferProgress progress) {
  TransferTarget const transfer{connection, target, type};
  Attention attention(transfer);
  Upload upload(transfer, items, range, options, progress, attention);
  auto const result = co_await upload.run();
  if (result && progress) progress(items.size(), items.size());
  co_return result;
}

}  // namespace lapwing::mavlink
