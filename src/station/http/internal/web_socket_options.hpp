#pragma once

#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/websocket/option.hpp>

#include "station/http/http_server.hpp"

namespace lapwing::station::internal {

/// Little of a session's stream waits in the kernel. By default that is some megabytes, behind which news of vehicles
/// would wait on a slow network; what the outbox holds instead may still be left out, or be replaced by what is newer.
void keep_kernel_backlog_short(boost::asio::ip::tcp::socket& socket);

/// What is offered to who sends that request: a proxy on this machine tells of other ones (`X-Forwarded-For`).
[[nodiscard]] boost::beast::websocket::permessage_deflate compression_for(HttpServer::Compression wish,
                                                                          boost::asio::ip::tcp::socket const& socket,
                                                                          HttpRequest const& request);

}  // namespace lapwing::station::internal
