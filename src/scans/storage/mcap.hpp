#pragma once

#include <istream>
#include <string_view>

#include "base/error.hpp"
#include "scans/storage/bag_listener.hpp"

namespace lapwing::scans {

[[nodiscard]] bool is_mcap(std::string_view beginning);

/// Reads the data section of an MCAP file (mcap.dev/spec, version 0) from its beginning: the summary and the indexes
/// behind it are not needed, so that a file without them is read as well. What was cut off, or is damaged, is left out,
/// and the remark says so. Errors (invalid_input): it is no MCAP file, or something in it is beyond a limit; those of
/// the listener.
[[nodiscard]] base::Result<BagRemark> read_mcap(std::istream& file, BagListener& listener);

}  // namespace lapwing::scans
