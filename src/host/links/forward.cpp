#include "host/links/forward.hpp"

#include <utility>

#include "host/links/ground.hpp"

namespace lapwing::host {

base::Result<std::vector<Forward>> forward_to(std::vector<std::string> const& texts) {
  std::vector<Forward> programs;
  for (auto const& text : texts) {
    auto link = parse_network_link(text);
    if (!link) return std::unexpected(link.error());
    programs.push_back({.network = std::move(link->network), .endpoint = {.url = std::move(link->url)}});
  }
  return programs;
}

}  // namespace lapwing::host
