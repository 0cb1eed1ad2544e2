#include "link/operator_link/settings.hpp"

#include <algorithm>
#include <random>

#include <fmt/format.h>

#include "base/text/printable.hpp"
#include "link/operator_link/journal/memory_queue.hpp"

namespace lapwing::link::operator_link {

base::Result<> check_name(std::string_view name) {
  auto const may_stand = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_' ||
           c == '.';
  };
  if (!name.empty() && name.size() <= longest_name && name.front() != '.' && std::ranges::all_of(name, may_stand))
    return {};
  return base::fail(
      base::ErrorKind::invalid_input,
      fmt::format("'{}' is no name", base::printable(std::string(name.substr(0, longest_name)))),
      fmt::format("A name has 1 to {} letters, digits, '-', '_' and '.', and no '.' at its beginning.", longest_name));
}

std::uint64_t random_id(std::optional<std::uint64_t> seed) {
  std::uint64_t id = 0;
  std::mt19937_64 repeated(seed.value_or(0));
  std::random_device device;
  while (id == 0) id = seed ? repeated() : (std::uint64_t{device()} << 32U) | device();
  return id;
}

base::Result<std::unique_ptr<DurableQueue>> open_queue(base::Loop& loop, QueueSettings const& settings,
                                                       std::string const& peer, std::uint64_t stream) {
  if (settings.folder.empty()) return std::make_unique<MemoryQueue>(stream, settings.memory_bytes);
  auto disk = open_folder(loop, settings.folder / peer);
  if (!disk) return std::unexpected(disk.error());
  return Journal::open(*std::move(disk), settings.disk, stream);
}

}  // namespace lapwing::link::operator_link
