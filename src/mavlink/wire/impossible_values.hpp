#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "base/time.hpp"
#include "mavlink/codec/codec.hpp"
#include "mavlink/path/link_report.hpp"

namespace lapwing::mavlink::internal {

/// What vehicles told that cannot be: counted by link, message and field, and put into words for the log, each field of
/// each vehicle at once and then once a minute, however often it comes.
class ImpossibleValues {
 public:
  /// Counts what one message held; the lines for the log, mostly none.
  [[nodiscard]] std::vector<std::string> note(std::size_t link, Frame const& frame,
                                              std::span<ImpossibleField const> fields, base::TimePoint now);
  void report(std::vector<LinkReport>& links) const;

 private:
  struct Told {
    std::uint64_t count = 0;
    base::TimePoint said{};
  };
  using Field = std::tuple<std::uint32_t, std::string_view>;  ///< message and field; names live for ever

  std::map<std::tuple<std::size_t, Field>, std::uint64_t> counts_;
  std::map<std::tuple<Address, Field>, Told> told_;  ///< bounded
};

}  // namespace lapwing::mavlink::internal
