#pragma once

#include <optional>

#include "mavlink/frame.hpp"

namespace lapwing::sim {

/// What a vehicle without any file answers to a FILE_TRANSFER_PROTOCOL frame (https://mavlink.io/en/services/ftp.html):
/// there is no such file or folder, no session, and nothing can be made. Nothing for other frames and for answers.
[[nodiscard]] std::optional<mavlink::Frame> file_transfer_answer(mavlink::Frame const& request, mavlink::Address self);

}  // namespace lapwing::sim
