#pragma once

#include <optional>

#include <boost/beast/http/message.hpp>
#include <boost/beast/http/string_body.hpp>
#include <boost/system/error_code.hpp>

#include "station/http/http.hpp"

/// Beast's requests and responses, from and to those that routes know.
namespace lapwing::station::internal {

/// The plain request without its body; nothing when its target is badly encoded.
[[nodiscard]] std::optional<HttpRequest> plain(
    boost::beast::http::request<boost::beast::http::string_body> const& request);

/// With the headers that every answer of this server carries.
[[nodiscard]] boost::beast::http::response<boost::beast::http::string_body> wire(HttpResponse response, bool is_head,
                                                                                 bool keep_alive);

/// The status that tells a client what it did wrong.
[[nodiscard]] int status_of(boost::system::error_code error);
/// Whether the client broke the protocol, rather than the connection.
[[nodiscard]] bool is_malformed(boost::system::error_code error);

}  // namespace lapwing::station::internal
