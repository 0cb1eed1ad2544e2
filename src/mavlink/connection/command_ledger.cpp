#include "mavlink/connection/command_ledger.hpp"

#include <bit>

#include "mavlink/exchange/command.hpp"

namespace lapwing::mavlink {

namespace {

/// After that an answer counts as lost: then what comes is believed again.
constexpr base::Duration answer_lasts = std::chrono::seconds(5);

/// FNV-1a over what makes two commands of a kind different.
std::uint64_t fingerprint(Command const& command) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  auto const add = [&hash](std::uint64_t value) { hash = (hash ^ value) * 0x100000001b3U; };
  for (float const parameter : command.params) add(std::bit_cast<std::uint32_t>(parameter));
  if (auto const& place = command.place) {
    for (double const value : {place->lat_rad, place->lon_rad, place->z_m}) add(std::bit_cast<std::uint64_t>(value));
  }
  return hash;
}

}  // namespace

CommandTurn::~CommandTurn() {
  if (!is_ours()) return;
  line_.owner_ = 0;
  line_.freed.notify_all();
}

void CommandLine::forget_old(base::TimePoint now) {
  while (!unanswered_.empty() && now - unanswered_.front().sent > answer_lasts) unanswered_.pop_front();
}

void CommandTurn::note_sent(Command const& command, base::TimePoint now) {
  line_.forget_old(now);
  line_.unanswered_.push_back({fingerprint(command), now});
  line_.last_sent_ = now;
}

bool CommandTurn::note_answer(Command const& command, base::TimePoint now) {
  auto& unanswered = line_.unanswered_;
  line_.forget_old(now);
  if (unanswered.empty()) return true;
  bool const is_meant = unanswered.front().fingerprint == fingerprint(command);
  unanswered.pop_front();
  return is_meant;
}

bool CommandLedger::was_just_passed_on(std::uint8_t system_id, MavCmd command, base::TimePoint now) {
  auto const& last = line(system_id, command).last_passed_on_;
  return last && now - *last <= answer_lasts;
}

}  // namespace lapwing::mavlink
