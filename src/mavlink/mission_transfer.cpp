#include "mavlink/mission_transfer.hpp"

#include <utility>

#include "mavlink/internal/transfer_parts.hpp"

namespace lapwing::mavlink {

using base::ErrorKind;
using base::fail;
using base::TimePoint;
using internal::Attention;
using internal::meant_for;
using internal::Outage;
using internal::Party;
using internal::Patience;
using internal::silent;

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

std::unexpected<base::Error> refused(Party const& party, std::string_view what, MavMissionResult result) {
  return fail(ErrorKind::refused, fmt::format("vehicle {} refused the {} of {}: {}", party.target.system, what,
                                              party.plural(), to_string(result)));
}

/// A download that can be taken up again where it stopped.
struct Download {
  Party party;
  TransferOptions const& options;
  TransferProgress const& progress;
  HeldPlan const& known;
  Patience patience;
  Attention attention;
  std::optional<MissionCount> list;
  HeldPlan held;
};

/// Sends `request` until a message comes that `fits`; refusals end it.
base::Task<base::Result<Message>> ask(Download& download, Inbox& inbox, Message request,
                                      std::function<bool(Message const&)> fits) {
  auto const& party = download.party;
  auto& patience = download.patience;
  auto& attention = download.attention;
  bool first = true;
  for (Attempts attempts(party.now(), download.options); attempts.another(party.now()); first = false) {
    if (attention.is_denied()) co_return attention.denial();
    if (!first) patience.repeated();
    if (auto sent = party.send(request); !sent) co_return std::unexpected(sent.error());
    attention.asked();
    auto const sent_at = party.now();
    auto const deadline = sent_at + patience.value();
    for (;;) {
      auto got = co_await inbox.next(deadline);
      if (!got) break;
      attention.answered();
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

/// Lays down what was fetched of a plan that the vehicle has changed since.
base::Task<base::Result<>> fetch_count(Download& download, Inbox& inbox) {
  Message const list = MissionRequestList{.type = download.party.type};
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
  auto const& party = download.party;
  Inbox inbox(party.connection, party.target, meant_for<MissionCount, MissionItem, MissionAck>(party));
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
    Message const request = MissionRequestInt{.seq = seq, .type = party.type};
    std::function<bool(Message const&)> const is_it = [seq](Message const& m) {
      auto const* item = std::get_if<MissionItem>(&m);
      return item && item->seq == seq;
    };
    auto const item = co_await ask(download, inbox, request, is_it);
    if (!item) co_return std::unexpected(item.error());
    items.push_back(std::get<MissionItem>(*item));
    if (download.progress) download.progress(items.size(), total);
  }
  (void)party.send(MissionAck{.type = party.type});  // a courtesy that needs no answer
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
  Party const party{connection, target, type};
  Download download{.party = party,
                    .options = options,
                    .progress = progress,
                    .known = known,
                    .patience = Patience(party, options),
                    .attention = Attention(party),
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
  Party const party{connection, target, type};
  Inbox acks(connection, target, meant_for<MissionAck>(party));
  std::optional<MavMissionResult> answered;
  Attention attention(party);
  for (Attempts attempts(party.now(), options); attempts.another(party.now());) {
    if (attention.is_denied()) co_return attention.denial();
    if (auto sent = party.send(MissionClearAll{.type = type}); !sent) co_return sent;
    attention.asked();
    auto const got = co_await acks.next(party.now() + options.reply_timeout);
    if (!got) continue;
    attention.answered();
    answered = std::get<MissionAck>(*got).result;
    if (*answered == MavMissionResult::accepted) co_return base::Result<>{};
    if (is_final(*answered)) break;
  }
  if (answered) co_return refused(party, "clearing", *answered);
  co_return silent(party, "clearing");
}

}  // namespace lapwing::mavlink
