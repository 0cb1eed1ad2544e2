#include "mavlink/exchange/mission_transfer.hpp"

#include <utility>

#include "mavlink/exchange/internal/transfer_parts.hpp"

namespace lapwing::mavlink {

using base::ErrorKind;
using base::fail;
using base::TimePoint;
using internal::Attention;
using internal::meant_for;
using internal::Outage;
using internal::RetransmitTimer;
using internal::silent;
using internal::TransferTarget;

namespace {

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

std::unexpected<base::Error> refused(TransferTarget const& transfer, std::string_view what, MavMissionResult result) {
  return fail(ErrorKind::refused, fmt::format("vehicle {} refused the {} of {}: {}", transfer.target.system, what,
                                              transfer.plural(), to_string(result)));
}

/// A download that can be taken up again where it stopped.
struct Download {
  TransferTarget transfer;
  TransferOptions const& options;
  TransferProgress const& progress;
  HeldPlan const& known;
  RetransmitTimer retransmit;
  Attention attention;
  std::optional<MissionCount> list;
  HeldPlan held;
};

/// Sends `request` until a message comes that `fits`; refusals end it.
base::Task<base::Result<Message>> ask(Download& download, Inbox& inbox, Message request,
                                      std::function<bool(Message const&)> fits) {
  auto const& transfer = download.transfer;
  auto& retransmit = download.retransmit;
  auto& attention = download.attention;
  bool first = true;
  for (Attempts attempts(transfer.now(), download.options); attempts.another(transfer.now()); first = false) {
    if (attention.is_denied()) co_return attention.denial();
    if (!first) retransmit.repeated();
    if (auto sent = transfer.send(request); !sent) co_return std::unexpected(sent.error());
    attention.asked();
    auto const sent_at = transfer.now();
    auto const deadline = sent_at + retransmit.value();
    for (;;) {
      auto got = co_await inbox.next(deadline);
      if (!got) break;
      attention.answered();
      if (fits(*got)) {
        if (first)
          retransmit.measured(transfer.now() - sent_at);
        else
          retransmit.moved_on();
        co_return std::move(*got);
      }
      auto const* ack = std::get_if<MissionAck>(&*got);
      if (ack && is_final(ack->result)) co_return refused(transfer, "download", ack->result);
    }
  }
  co_return silent(transfer, "download");
}

/// Lays down what was fetched of a plan that the vehicle has changed since.
base::Task<base::Result<>> fetch_count(Download& download, Inbox& inbox) {
  Message const list = MissionRequestList{.type = download.transfer.type};
  std::function<bool(Message const&)> const is_count = [](Message const& m) {
    return std::holds_alternative<MissionCount>(m);
  };
  auto const got = co_await ask(download, inbox, list, is_count);
  if (!got) co_return std::unexpected(got.error());
  auto const& count = std::get<MissionCount>(*got);
  auto const& before = download.list;
  if (before && (before->count != count.count || before->opaque_id != count.opaque_id)) download.held.items.clear();
  download.list = count;
  download.held.opaque_id = count.opaque_id;
  co_return base::Result<>{};
}

/// Continues at the first item that is missing.
base::Task<base::Result<>> fetch(Download& download) {
  auto const& transfer = download.transfer;
  Inbox inbox(transfer.connection, transfer.target, meant_for<MissionCount, MissionItem, MissionAck>(transfer));
  if (auto counted = co_await fetch_count(download, inbox); !counted) co_return counted;
  auto& items = download.held.items;
  auto const total = download.list->count;
  auto const& known = download.known;
  if (known.opaque_id != 0 && known.opaque_id == download.list->opaque_id && known.items.size() == total) {
    items = known.items;
    co_return base::Result<>{};
  }
  while (items.size() < total) {
    auto const seq = static_cast<std::uint16_t>(items.size());
    Message const request = MissionRequestInt{.seq = seq, .type = transfer.type};
    std::function<bool(Message const&)> const is_it = [seq](Message const& m) {
      auto const* item = std::get_if<MissionItem>(&m);
      return item && item->seq == seq;
    };
    auto const item = co_await ask(download, inbox, request, is_it);
    if (!item) co_return std::unexpected(item.error());
    items.push_back(std::get<MissionItem>(*item));
    if (download.progress) download.progress(items.size(), total);
  }
  (void)transfer.send(MissionAck{.type = transfer.type});  // a courtesy that needs no answer
  co_return base::Result<>{};
}

/// Whether the link was lost and is back, so that it is worth going on.
base::Task<bool> is_worth_another(base::Error const& error, Outage& outage) {
  if (error.kind != ErrorKind::timed_out && error.kind != ErrorKind::lost) co_return false;
  co_return co_await outage.is_over(error.kind == ErrorKind::lost);
}

}  // namespace

base::Task<base::Result<HeldPlan>> download_mission(Connection& connection, Address target, MissionType type,
                                                    TransferOptions options, TransferProgress progress,
                                                    HeldPlan known) {
  TransferTarget const transfer{connection, target, type};
  Download download{.transfer = transfer,
                    .options = options,
                    .progress = progress,
                    .known = known,
                    .retransmit = retransmit_timer(transfer, options),
                    .attention = Attention(transfer),
                    .list = {},
                    .held = {}};
  Outage outage(connection, target.system, options);
  for (;;) {
    auto const fetched = co_await fetch(download);
    if (fetched) co_return std::move(download.held);
    if (!co_await is_worth_another(fetched.error(), outage)) co_return std::unexpected(fetched.error());
  }
}

base::Task<base::Result<>> clear_mission(Connection& connection, Address target, MissionType type,
                                         TransferOptions options) {
  TransferTarget const transfer{connection, target, type};
  Inbox acks(connection, target, meant_for<MissionAck>(transfer));
  std::optional<MavMissionResult> answered;
  Attention attention(transfer);
  for (Attempts attempts(transfer.now(), options); attempts.another(transfer.now());) {
    if (attention.is_denied()) co_return attention.denial();
    if (auto sent = transfer.send(MissionClearAll{.type = type}); !sent) co_return sent;
    attention.asked();
    auto const got = co_await acks.next(transfer.now() + options.reply_timeout);
    if (!got) continue;
    attention.answered();
    answered = std::get<MissionAck>(*got).result;
    if (*answered == MavMissionResult::accepted) co_return base::Result<>{};
    if (is_final(*answered)) break;
  }
  if (answered) co_return refused(transfer, "clearing", *answered);
  co_return silent(transfer, "clearing");
}

}  // namespace lapwing::mavlink
