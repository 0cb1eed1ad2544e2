// Any bytes as what an editor sends: the reader of messages, and the server behind it.

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "lsp/message_reader.hpp"
#include "lsp/server.hpp"
#include "scripts.hpp"

namespace {

using namespace lapwing;

/// A session with an open script, so that questions of the input reach the language services.
constexpr std::string_view openings[] = {
    R"({"id":0,"method":"initialize","params":{}})",
    R"({"method":"textDocument/didOpen","params":{"textDocument":{"uri":"u","version":1,"text":"v = pick { }\nm = mission { move 1, 2 }\nexecute v: m / { battery(v) < 0.3 }\n"}}})"};

/// As if hours passed between two messages, so that every text is checked, too.
void work(lsp::Server& server, base::TimePoint& now) {
  now += std::chrono::hours(1);
  while (server.has_work(now) && !server.exit_code()) (void)server.work(now);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  lsp::Server server(fuzz::vocabulary(), "fuzz");
  for (auto const opening : openings) server.receive(opening);
  base::TimePoint now{};
  work(server, now);
  lsp::MessageReader reader(1 << 16);
  auto const half = size / 2;
  for (auto const part : {std::string_view(reinterpret_cast<char const*>(data), half),
                          std::string_view(reinterpret_cast<char const*>(data) + half, size - half)}) {
    reader.feed(part);
    while (auto const message = reader.next()) {
      if (message->mistake.empty()) {
        server.receive(message->body);
      } else {
        server.receive_mistake(message->mistake);
      }
    }
    work(server, now);
  }
  return 0;
}
