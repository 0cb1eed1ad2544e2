#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "base/async/loop.hpp"
#include "base/error.hpp"
#include "link/operator_link/back_off.hpp"
#include "link/operator_link/delivery/peer_session.hpp"
#include "link/operator_link/journal/journal.hpp"

namespace lapwing::link::operator_link {

/// What is spoken on connections.
enum class Mode : std::uint8_t {
  framed,  ///< numbered, acknowledged, resumed
  json,    ///< one JSON object after the other, as old parts speak: what the operating system took counts as taken
};

/// Where messages wait that must not be lost.
struct QueueSettings {
  std::filesystem::path folder{};  ///< with a folder in it for each far end; empty: in memory, lost with the process
  JournalLimits disk{};
  std::size_t memory_bytes = std::size_t{8} * 1024 * 1024;
};

/// What servers and clients share.
struct EndSettings {
  std::string name{};   ///< of this end, by which the other knows it again: letters, digits, '-', '_' and '.'
  std::string token{};  ///< what clients must know; empty: none
  Mode mode = Mode::framed;
  SessionOptions session{};
  QueueSettings queues{};
  base::Duration hello_timeout = std::chrono::seconds(5);
  std::optional<std::uint64_t> seed{};  ///< of everything random, for runs that repeat
};

/// Whether it may be the name of an end, which is also that of a folder. Error (invalid_input): what is wrong.
[[nodiscard]] base::Result<> check_name(std::string_view name);
/// Never zero, which means nobody.
[[nodiscard]] std::uint64_t random_id(std::optional<std::uint64_t> seed);
/// The queue for one far end.
[[nodiscard]] base::Result<std::unique_ptr<DurableQueue>> open_queue(base::Loop& loop, QueueSettings const& settings,
                                                                     std::string const& peer, std::uint64_t stream);

}  // namespace lapwing::link::operator_link
