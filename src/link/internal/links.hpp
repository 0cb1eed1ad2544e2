#pragma once

#include <memory>

#include "link/byte_link.hpp"

/// The transports behind `link::open`, one a file.
namespace lapwing::link::internal {

[[nodiscard]] base::Result<std::unique_ptr<ByteLink>> open_udp(base::Loop& loop, Url const& url);
[[nodiscard]] base::Result<std::unique_ptr<ByteLink>> open_tcp_in(base::Loop& loop, Url const& url);
[[nodiscard]] std::unique_ptr<ByteLink> open_tcp_out(base::Loop& loop, Url const& url);
[[nodiscard]] base::Result<std::unique_ptr<ByteLink>> open_serial(base::Loop& loop, Url const& url);

/// Why a local address could not be used and what to do about it.
[[nodiscard]] std::unexpected<base::Error> cannot_bind(Url const& url, int system_error);

}  // namespace lapwing::link::internal
