#include <utility>  // before Asio: Boost 1.74 uses std::exchange without including it

#include "station/http/internal/web_socket_options.hpp"

#include <netinet/tcp.h>

namespace lapwing::station::internal {

namespace asio = boost::asio;
namespace websocket = boost::beast::websocket;
using boost::system::error_code;

void keep_kernel_backlog_short(asio::ip::tcp::socket& socket) {
  constexpr int most_not_sent = 64 * 1024;
  error_code ignored;  // where the kernel has no such option a slow viewer sees older news
  socket.set_option(asio::detail::socket_option::integer<IPPROTO_TCP, TCP_NOTSENT_LOWAT>(most_not_sent), ignored);
}

websocket::permessage_deflate compression_for(HttpServer::Compression wish, asio::ip::tcp::socket const& socket,
                                              HttpRequest const& request) {
  error_code error;
  auto const peer = socket.remote_endpoint(error);
  bool const is_elsewhere = !request.header("X-Forwarded-For").empty() || (!error && !peer.address().is_loopback());
  websocket::permessage_deflate result;
  result.server_enable =
      wish == HttpServer::Compression::always || (wish == HttpServer::Compression::to_other_machines && is_elsewhere);
  // Feeds are text that repeats itself: a high level saves little more, for several times the processor time.
  result.compLevel = 3;
  result.memLevel = 8;
  return result;
}

}  // namespace lapwing::station::internal
