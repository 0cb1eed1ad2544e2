#include "mavlink/exchange/plan_replacement.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace lapwing::mavlink {

using base::ErrorKind;
using base::fail;
using base::Result;
using base::Task;

namespace {

/// One replacement: what stays the same through its phases.
struct Job {
  Connection& connection;
  Address target;
  MissionType type;
  ReplaceOptions const& options;
  Replacement& record;

  [[nodiscard]] TransferProgress progress(std::string_view phase) const {
    return [&options = options, phase](std::size_t done, std::size_t total) {
      if (options.progress) options.progress(phase, done, total);
    };
  }
};

/// As long as the vehicle has asked for no item it has touched nothing.
TransferProgress noting(Job const& job, std::string_view phase) {
  return [&record = job.record, show = job.progress(phase)](std::size_t done, std::size_t total) {
    record.left = PlanLeft::unknown;
    show(done, total);
  };
}

Task<Result<>> write_all(Job const& job, std::vector<MissionItem> const& items, std::string_view phase) {
  auto copy = items;
  auto progress = noting(job, phase);
  job.record.written = items.size();
  auto const sent = co_await upload_mission(job.connection, job.target, std::move(copy), job.type, job.options.transfer,
                                            std::move(progress));
  if (sent || sent.error().kind != ErrorKind::refused) job.record.left = PlanLeft::unknown;
  co_return sent;
}

/// The items that differ, from the first to before the last; nothing where a part will not do.
std::optional<ItemRange> changed_part(Job const& job, std::vector<MissionItem> const& items) {
  auto const& before = job.record.before;
  bool const can = job.type == MissionType::mission && job.options.autopilot == MavAutopilot::ardupilotmega;
  if (!can || !before || before->items.size() != items.size()) return std::nullopt;
  auto const same = [&](std::size_t i) {
    return compare_item(i, items[i], before->items[i], job.options.autopilot).empty();
  };
  std::size_t first = 1;  // item 0 is home, which is the vehicle's own
  while (first < items.size() && same(first)) ++first;
  auto end = items.size();
  while (end > first && same(end - 1)) --end;
  constexpr std::size_t worth = 2;  // less than half of them
  if (first == end || (end - first) * worth > items.size() || end > 0x7FFF) return std::nullopt;
  return ItemRange{first, end};
}

/// Writes what changes; false where the whole has to be written.
Task<bool> write_part(Job const& job, std::vector<MissionItem> const& items) {
  auto const part = changed_part(job, items);
  if (!part) co_return false;
  auto copy = items;
  auto progress = noting(job, "uploading");
  TransferOptions const once{.reply_timeout = job.options.transfer.reply_timeout, .tries = 3, .restarts = 0};
  auto const sent =
      co_await upload_part(job.connection, job.target, std::move(copy), *part, job.type, once, std::move(progress));
  job.record.written = part->size();
  if (sent) job.record.left = PlanLeft::unknown;
  co_return sent.has_value();
}

/// What the vehicle holds instead of `items`; empty when it holds them.
Task<Result<std::vector<Difference>>> read_back(Job const& job, std::vector<MissionItem> const& items) {
  auto progress = job.progress("reading back");
  HeldPlan none_known;
  auto held = co_await download_mission(job.connection, job.target, job.type, job.options.transfer, std::move(progress),
                                        std::move(none_known));
  if (!held) co_return std::unexpected(std::move(held.error()));
  auto differences = compare_readback(items, held->items, job.options.autopilot);
  if (differences.empty()) job.record.held = *std::move(held);
  co_return differences;
}

base::Error named(std::string_view what, base::Error error) {
  error.message = fmt::format("{}: {}", what, error.message);
  return error;
}

Task<Result<>> write_once(Job const& job, std::vector<MissionItem> const& items, bool may_be_part) {
  auto const begun = job.connection.loop().now();
  bool is_written = false;
  if (may_be_part) is_written = co_await write_part(job, items);
  Result<> sent;
  if (!is_written) sent = co_await write_all(job, items, "uploading");
  job.record.upload_time = job.connection.loop().now() - begun;
  if (!sent) sent = std::unexpected(named("upload", std::move(sent.error())));
  co_return sent;
}

/// What counts is what the vehicle holds: an upload whose last acknowledgement got lost has succeeded, and a copy that
/// came out different is sent again.
Task<Result<>> write_and_verify(Job const& job, std::vector<MissionItem> const& items) {
  Result<> outcome;
  for (int attempt = 0; attempt < job.options.attempts; ++attempt) {
    outcome = co_await write_once(job, items, attempt == 0);
    bool const may_be_there = outcome || outcome.error().kind == ErrorKind::timed_out;
    if (!may_be_there || (outcome && !job.options.verifies)) break;
    auto const compared = co_await read_back(job, items);
    if (compared && compared->empty()) co_return Result<>{};
    // What was not asked for to its end is not there: that it was not is the cause.
    if (compared && !outcome)
      outcome.error().kind = ErrorKind::refused;
    else if (compared)
      outcome = fail(ErrorKind::refused, fmt::format("the vehicle does not hold what was sent: {}", compared->front()));
    else if (outcome)
      outcome = std::unexpected(named("read-back", compared.error()));
    bool const answers = compared || compared.error().kind == ErrorKind::refused;
    if (!answers) break;
  }
  co_return outcome;
}

/// True when the vehicle holds what it should; nothing is written then.
Task<Result<bool>> fetch_old(Job const& job, std::vector<MissionItem> const& items) {
  auto progress = job.progress("reading what it holds");
  auto known = job.options.known;
  auto old = co_await download_mission(job.connection, job.target, job.type, job.options.transfer, std::move(progress),
                                       std::move(known));
  if (!old) co_return std::unexpected(std::move(old.error()));
  bool const is_it = compare_readback(items, old->items, job.options.autopilot).empty();
  job.record.before = *std::move(old);
  co_return is_it;
}

/// True when the old plan is there. The vehicle may still be waiting for the rest of the upload that failed, and tells
/// nothing until that is over: writing begins it anew.
Task<bool> put_back(Job const& job, std::vector<MissionItem> const& old) {
  auto const compared = co_await read_back(job, old);
  if (compared && compared->empty()) co_return true;
  if (!compared && compared.error().kind != ErrorKind::refused) co_return false;
  (void)co_await write_all(job, old, "putting the old plan back");
  auto const again = co_await read_back(job, old);
  co_return again && again->empty();
}

/// COUNT 0 is understood in the middle of an upload; CLEAR_ALL is refused there.
Task<bool> clear(Job const& job) {
  TransferOptions const brief{.tries = 3, .silence_limit = std::chrono::seconds(2), .restarts = 0};
  std::vector<MissionItem> nothing;
  auto progress = job.progress("clearing");
  auto const emptied =
      co_await upload_mission(job.connection, job.target, std::move(nothing), job.type, brief, std::move(progress));
  if (emptied) co_return true;
  if (emptied.error().kind != ErrorKind::refused) co_return false;
  co_return (co_await clear_mission(job.connection, job.target, job.type, brief)).has_value();
}

}  // namespace

std::string_view to_string(PlanLeft left) {
  switch (left) {
    case PlanLeft::old_one: return "the vehicle still holds its old plan";
    case PlanLeft::new_one: return "the vehicle holds the new plan";
    case PlanLeft::none: return "what the vehicle held was cleared";
    case PlanLeft::unknown: break;
  }
  return "the vehicle may hold a part of the new plan and a part of the old one";
}

Task<> undo_replacement(Connection& connection, Address target, MissionType type, ReplaceOptions options,
                        Replacement& record) {
  if (record.left != PlanLeft::unknown) co_return;
  Job const job{connection, target, type, options, record};
  auto const written = record.written;
  bool is_back = false;
  if (record.before && !record.before->items.empty()) is_back = co_await put_back(job, record.before->items);
  record.written = written;
  record.left = is_back ? PlanLeft::old_one : PlanLeft::unknown;
  if (!is_back && co_await clear(job)) record.left = PlanLeft::none;
}

Task<Result<>> replace_plan(Connection& connection, Address target, std::vector<MissionItem> items, MissionType type,
                            ReplaceOptions options, Replacement& record) {
  Job const job{connection, target, type, options, record};
  if (options.keeps_old) {
    auto const is_there = co_await fetch_old(job, items);
    if (!is_there) co_return std::unexpected(is_there.error());
    if (*is_there) {
      record.held = *record.before;
      record.left = PlanLeft::new_one;
      co_return Result<>{};
    }
  }
  auto outcome = co_await write_and_verify(job, items);
  if (outcome) {
    record.left = PlanLeft::new_one;
    co_return outcome;
  }
  co_await undo_replacement(connection, target, type, options, record);
  outcome.error().message += fmt::format("; {}", to_string(record.left));
  co_return outcome;
}

}  // namespace lapwing::mavlink
