#include "station/http/http_server.hpp"

#include <array>

#include <gtest/gtest.h>

#include "base/async/notifier.hpp"
#include "station/testing/http_client.hpp"

namespace lapwing::station {
namespace {

using testing::Answer;
using testing::Ask;
using testing::ask;
using testing::ask_raw;
using testing::RawConnection;
using testing::run_until;
using testing::WebSocketClient;

std::array<HttpServer::Message, 1> text(std::string bytes) {
  return {HttpServer::Message{std::make_shared<std::string const>(std::move(bytes))}};
}

struct HttpServerTest : ::testing::Test {
  void serve(HttpServer::Options options) {
    options.port = 0;
    auto opened = HttpServer::open(loop, std::move(options), base::Logger());
    ASSERT_TRUE(opened) << opened.error().message;
    server = std::move(*opened);
    Router router;
    router.add("GET", "/api/v1/hello",
               [](auto const& request) { return HttpResponse{.body = "hello " + request.query}; });
    router.add("POST", "/api/v1/echo", [](auto const& request) { return HttpResponse{.body = request.body}; });
    router.add(
        "POST", "/api/v1/pictures/{name}",
        [](HttpRequest const& request, PathArguments const&) { return HttpResponse{.body = request.body}; }, 1000);
    router.add("GET", "/api/v1/slow", [this](auto const&) { return answer_later(); });
    router.add("GET", "/api/v1/quick", [this](auto const&) { return answer_at_once(); });
    server->set_router(std::move(router));
    server->set_websocket({
        .opened =
            [this](SessionId session, HttpRequest const& request) {
              sessions.push_back(session);
              query = request.query;
            },
        .received =
            [this](SessionId session, std::string_view message) {
              (void)server->send(session, text("echo " + std::string(message)));
            },
        .drained = [this](SessionId) { ++drained; },
        .closed = [this](SessionId) { ++closed; },
    });
  }
  Answer get(std::string target) { return ask(loop, server->port(), {.target = std::move(target)}); }

  base::Task<HttpResponse> answer_later() {
    ++waiting;
    co_await answers.wait();
    --waiting;
    co_return HttpResponse{.body = "at last"};
  }
  base::Task<HttpResponse> answer_at_once() { co_return HttpResponse{.body = "at once"}; }

  base::Loop loop;
  base::Notifier answers{loop};
  int waiting = 0;
  std::vector<SessionId> sessions;
  int closed = 0;
  int drained = 0;
  std::string query;
  std::unique_ptr<HttpServer> server;
};

TEST_F(HttpServerTest, WaitsForWorkThatAnAnswerTakes) {
  serve({});
  server->every(std::chrono::milliseconds(20), [this] { answers.notify_all(); });
  EXPECT_EQ(get("/api/v1/slow").body, "at last");
  EXPECT_EQ(get("/api/v1/quick").body, "at once");
  EXPECT_EQ(waiting, 0);
}

TEST_F(HttpServerTest, EndsWhileWorkIsUnderWay) {
  serve({});
  server->every(std::chrono::milliseconds(20), [this] {
    if (waiting > 0) loop.post([this] { server.reset(); });
  });
  EXPECT_EQ(get("/api/v1/slow").status, 0);
  answers.notify_all();
  loop.run_until_done([](base::Loop& on) -> base::Task<> { co_await on.turn(); }(loop));
  EXPECT_EQ(waiting, 1) << "the work was destroyed where it waited";
}

TEST_F(HttpServerTest, AnswersRoutes) {
  serve({});
  auto const answer = get("/api/v1/hello?a=b");
  EXPECT_EQ(answer.status, 200);
  EXPECT_EQ(answer.body, "hello a=b");
  EXPECT_EQ(answer.header("Content-Type"), "application/json");
  EXPECT_EQ(get("/api/v1/none").status, 404);
  EXPECT_EQ(get("/%zz").status, 400);
}

TEST_F(HttpServerTest, SendsSecurityHeaders) {
  serve({});
  auto const answer = get("/");
  EXPECT_EQ(answer.header("X-Content-Type-Options"), "nosniff");
  EXPECT_NE(answer.header("Content-Security-Policy").find("script-src 'self';"), std::string::npos);
  EXPECT_NE(answer.header("Content-Security-Policy").find("frame-ancestors 'none'"), std::string::npos);
  EXPECT_NE(answer.header("Permissions-Policy").find("camera=()"), std::string::npos);
}

TEST_F(HttpServerTest, AnswersHeadWithoutABody) {
  serve({});
  auto const answer = ask(loop, server->port(), {.method = "HEAD", .target = "/api/v1/hello"});
  EXPECT_EQ(answer.status, 200);
  EXPECT_EQ(answer.body, "");
  EXPECT_EQ(answer.header("Content-Length"), "6");
}

TEST_F(HttpServerTest, RefusesMethodsOnFiles) {
  serve({});
  auto const answer =
      ask(loop, server->port(),
          {.method = "POST", .target = "/index.html", .headers = {{"Content-Type", "application/json"}}});
  EXPECT_EQ(answer.status, 405);
  EXPECT_EQ(answer.header("Allow"), "GET, HEAD");
}

TEST_F(HttpServerTest, HoldsItsLimits) {
  serve({.max_header_bytes = 1024, .max_body_bytes = 100});
  HttpHeader const json{"Content-Type", "application/json"};
  EXPECT_EQ(ask(loop, server->port(),
                {.method = "POST", .target = "/api/v1/echo", .headers = {json}, .body = std::string(100, 'x')})
                .status,
            200);
  EXPECT_EQ(ask(loop, server->port(),
                {.method = "POST", .target = "/api/v1/echo", .headers = {json}, .body = std::string(101, 'x')})
                .status,
            413);
  EXPECT_EQ(ask(loop, server->port(), {.target = "/api/v1/hello", .headers = {{"X", std::string(2000, 'x')}}}).status,
            431);
}

TEST_F(HttpServerTest, TakesLongerBodiesWhereARouteSaysSo) {
  serve({.max_body_bytes = 100});
  HttpHeader const type{"Content-Type", "image/png"};
  auto const post = [&](std::string target, std::size_t size) {
    return ask(loop, server->port(),
               {.method = "POST", .target = std::move(target), .headers = {type}, .body = std::string(size, 'x')});
  };
  EXPECT_EQ(post("/api/v1/pictures/a", 1000).body.size(), 1000U);
  EXPECT_EQ(post("/api/v1/pictures/a", 1001).status, 413);
  EXPECT_EQ(post("/api/v1/echo", 101).status, 413) << "elsewhere the server's own limit holds";
  std::string const chunked =
      "POST /api/v1/echo HTTP/1.1\r\nHost: localhost\r\nContent-Type: image/png\r\n"
      "Transfer-Encoding: chunked\r\nConnection: close\r\n\r\nc8\r\n";
  EXPECT_TRUE(
      ask_raw(loop, server->port(), chunked + std::string(200, 'x') + "\r\n0\r\n\r\n").starts_with("HTTP/1.1 413"));
}

TEST_F(HttpServerTest, AnswersRubbishWithAnError) {
  serve({});
  EXPECT_TRUE(ask_raw(loop, server->port(), "rubbish\r\n\r\n").starts_with("HTTP/1.1 400"));
  EXPECT_EQ(get("/api/v1/hello").status, 200) << "others are still served";
}

TEST_F(HttpServerTest, EndsConnectionsThatSendNoWholeRequest) {
  serve({.first_request_timeout = std::chrono::milliseconds(30)});
  EXPECT_EQ(ask_raw(loop, server->port(), "GET / HTTP/1.1\r\nHost: local"), "");
}

TEST_F(HttpServerTest, LetsInWhoHasARequestThoughOthersSitOnEveryPlace) {
  serve({.max_connections = 8, .max_strangers_per_address = 8});
  std::vector<std::unique_ptr<RawConnection>> idle;
  for (int i = 0; i < 40; ++i) {
    idle.push_back(RawConnection::open(loop, server->port()));
    ASSERT_TRUE(idle.back());
    idle.back()->send("GET / HTTP/1.1\r\nHost: 127");
    if (i % 10 == 9) {
      EXPECT_EQ(get("/api/v1/hello").status, 200) << i;
    }
  }
  EXPECT_TRUE(run_until(loop, [&] { return idle.front()->is_over(); })) << "the first came first and gave way";
  EXPECT_FALSE(idle.back()->is_over());
}

TEST_F(HttpServerTest, KeepsThePlaceOfWhoHasNotSpokenYetThoughCrowdsPassBy) {
  serve({.token = "secret", .max_connections = 8, .max_strangers_per_address = 8});
  auto const slow = RawConnection::open(loop, server->port());
  ASSERT_TRUE(slow);
  std::vector<std::unique_ptr<RawConnection>> crowd;
  for (int i = 0; i < 40; ++i) {
    crowd.push_back(RawConnection::open(loop, server->port()));
    ASSERT_TRUE(crowd.back());
    if (i % 2 == 0) {
      crowd.back()->send("GET / HTTP/1.1\r\nHost: 127");
    } else {
      crowd.back()->send("GET /api/v1/hello HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n");
      EXPECT_NE(crowd.back()->receive("\r\n\r\n").find(" 401 "), std::string::npos);
    }
  }
  EXPECT_TRUE(run_until(loop, [&] { return crowd.front()->is_over(); }));
  EXPECT_FALSE(slow->is_over());
  slow->send("GET /api/v1/hello?late HTTP/1.1\r\nHost: 127.0.0.1\r\nAuthorization: Bearer secret\r\n\r\n");
  EXPECT_NE(slow->receive("hello late").find("hello late"), std::string::npos);
}

TEST_F(HttpServerTest, LetsInWhoHasARequestThoughEveryPlaceIsKeptAlive) {
  serve({.max_connections = 4});
  std::vector<std::unique_ptr<RawConnection>> resting;
  for (int i = 0; i < 12; ++i) {
    resting.push_back(RawConnection::open(loop, server->port()));
    resting.back()->send("GET /api/v1/hello HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n");
    EXPECT_NE(resting.back()->receive("hello ").find("hello "), std::string::npos) << i;
  }
}

TEST_F(HttpServerTest, KeepsThePlaceOfWhoHoldsTheToken) {
  serve({.token = "secret", .max_connections = 4, .max_strangers_per_address = 2});
  auto const request = "GET /api/v1/hello?x HTTP/1.1\r\nHost: 127.0.0.1\r\nAuthorization: Bearer secret\r\n\r\n";
  auto const known = RawConnection::open(loop, server->port());
  known->send(request);
  ASSERT_NE(known->receive("hello x").find("hello x"), std::string::npos);
  std::vector<std::unique_ptr<RawConnection>> strangers;
  for (int i = 0; i < 30; ++i) {
    strangers.push_back(RawConnection::open(loop, server->port()));
    strangers.back()->send("GET /api/v1/hello HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n");  // 401, kept alive
  }
  EXPECT_TRUE(run_until(loop, [&] { return strangers.front()->is_over(); }));
  EXPECT_FALSE(known->is_over());
  known->send("GET /api/v1/hello?again HTTP/1.1\r\nHost: 127.0.0.1\r\nAuthorization: Bearer secret\r\n\r\n");
  EXPECT_NE(known->receive("hello again").find("hello again"), std::string::npos);
}

TEST_F(HttpServerTest, RefusesAStrangerBeforeItsBody) {
  serve({.token = "secret"});
  auto const stranger = RawConnection::open(loop, server->port());
  stranger->send(
      "POST /api/v1/echo HTTP/1.1\r\nHost: 127.0.0.1\r\nContent-Type: application/json\r\nContent-Length: "
      "1000\r\n\r\n");
  EXPECT_TRUE(stranger->receive("\r\n\r\n").starts_with("HTTP/1.1 401"));
}

TEST_F(HttpServerTest, SaysThatABodyIsTooLargeToWhoSendsAllOfIt) {
  serve({.max_body_bytes = 1000});
  auto const client = RawConnection::open(loop, server->port());
  client->send(
      "POST /api/v1/echo HTTP/1.1\r\nHost: 127.0.0.1\r\nContent-Type: application/json\r\n"
      "Content-Length: 5000000\r\n\r\n" +
      std::string(5'000'000, 'x'));
  EXPECT_TRUE(client->receive("}").starts_with("HTTP/1.1 413"));
}

TEST_F(HttpServerTest, NamesThePortThatIsInUse) {
  serve({});
  HttpServer::Options const options{.port = server->port()};
  auto const second = HttpServer::open(loop, options, base::Logger());
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().kind, base::ErrorKind::io);
  EXPECT_NE(second.error().message.find(std::to_string(server->port())), std::string::npos);
  EXPECT_NE(second.error().hint.find("--port"), std::string::npos);
}

TEST_F(HttpServerTest, AsksForATokenBeyondLoopback) {
  auto const open_to_all = HttpServer::open(loop, {.address = "0.0.0.0", .port = 0}, base::Logger());
  ASSERT_FALSE(open_to_all);
  EXPECT_NE(open_to_all.error().hint.find("token"), std::string::npos);
  EXPECT_TRUE(HttpServer::open(loop, {.address = "0.0.0.0", .port = 0, .token = "t"}, base::Logger()));
  EXPECT_FALSE(HttpServer::open(loop, {.address = "nonsense", .port = 0}, base::Logger()));
}

TEST_F(HttpServerTest, SaysWhereItIs) {
  serve({});
  EXPECT_EQ(server->url(), "http://127.0.0.1:" + std::to_string(server->port()) + "/");
}

TEST_F(HttpServerTest, TalksOverWebSockets) {
  serve({});
  auto const client = WebSocketClient::open(loop, server->port(), {.target = "/api/v1/ws"});
  ASSERT_TRUE(client);
  client->send("one");
  EXPECT_EQ(client->receive(), "echo one");
  ASSERT_EQ(sessions.size(), 1U);
  EXPECT_TRUE(server->send(sessions[0], text("news")));
  EXPECT_EQ(client->receive(), "news");
}

TEST_F(HttpServerTest, RefusesForeignAndSurplusWebSockets) {
  serve({.max_sessions = 1});
  int const port = server->port();
  EXPECT_FALSE(
      WebSocketClient::open(loop, port, {.target = "/api/v1/ws", .headers = {{"Origin", "http://evil.example"}}}));
  EXPECT_FALSE(WebSocketClient::open(loop, port, {.target = "/api/v1/ws", .host = "evil.example"}));
  EXPECT_FALSE(WebSocketClient::open(loop, port, {.target = "/api/v1/other"}));
  auto const first = WebSocketClient::open(loop, port, {.target = "/api/v1/ws"});
  ASSERT_TRUE(first);
  first->send("here");
  EXPECT_EQ(first->receive(), "echo here");
  EXPECT_FALSE(WebSocketClient::open(loop, port, {.target = "/api/v1/ws"})) << "who has spoken keeps its place";
  first->send("still");
  EXPECT_EQ(first->receive(), "echo still");
}

TEST_F(HttpServerTest, EndsTheWebSocketThatNeverSpokeForANewOne) {
  serve({.max_sessions = 2});
  int const port = server->port();
  auto const speaker = WebSocketClient::open(loop, port, {.target = "/api/v1/ws"});
  auto const silent = WebSocketClient::open(loop, port, {.target = "/api/v1/ws"});
  ASSERT_TRUE(speaker && silent);
  speaker->send("one");
  EXPECT_EQ(speaker->receive(), "echo one");
  auto const third = WebSocketClient::open(loop, port, {.target = "/api/v1/ws"});
  ASSERT_TRUE(third);
  EXPECT_FALSE(silent->receive()) << "its connection is over";
  EXPECT_TRUE(run_until(loop, [&] { return closed == 1; }));
  speaker->send("two");
  EXPECT_EQ(speaker->receive(), "echo two");
}

TEST_F(HttpServerTest, EndsTheWebSocketThatTakesNothingBeforeAnyOther) {
  serve({.max_sessions = 2, .stall_timeout = std::chrono::milliseconds(0)});
  int const port = server->port();
  auto const silent = WebSocketClient::open(loop, port, {.target = "/api/v1/ws"});
  auto const stalled = WebSocketClient::open(loop, port, {.target = "/api/v1/ws"});
  ASSERT_TRUE(silent && stalled);
  stalled->send("one");
  EXPECT_EQ(stalled->receive(), "echo one");
  stalled->pause();
  auto const much = text(std::string(1'000'000, 'x'));
  int refused = 0;  // in a row, a millisecond apart: the network takes no more of it
  ASSERT_TRUE(run_until(loop, [&] {
    refused = server->send(sessions[1], much) ? 0 : refused + 1;
    return refused > 100;
  }));
  auto const third = WebSocketClient::open(loop, port, {.target = "/api/v1/ws"});
  ASSERT_TRUE(third);
  EXPECT_TRUE(server->send(sessions[0], text("news")));
  EXPECT_EQ(silent->receive(), "news");
}

TEST_F(HttpServerTest, EndsWebSocketsThatSendTooMuch) {
  serve({.max_body_bytes = 100});
  auto const client = WebSocketClient::open(loop, server->port(), {.target = "/api/v1/ws"});
  ASSERT_TRUE(client);
  client->send(std::string(101, 'x'));
  EXPECT_FALSE(client->receive());
  EXPECT_TRUE(run_until(loop, [&] { return closed == 1; }));
}

TEST_F(HttpServerTest, ForgetsClientsThatGo) {
  serve({});
  auto client = WebSocketClient::open(loop, server->port(), {.target = "/api/v1/ws"});
  ASSERT_TRUE(client);
  client.reset();
  EXPECT_TRUE(run_until(loop, [&] { return closed == 1; }));
  EXPECT_FALSE(server->send(sessions.at(0), text("nobody")));
}

TEST_F(HttpServerTest, RefusesToQueueForeverForASlowClient) {
  serve({.max_backlog_bytes = 1000});
  auto const client = WebSocketClient::open(loop, server->port(), {.target = "/api/v1/ws"});
  ASSERT_TRUE(client);
  EXPECT_TRUE(server->send(sessions[0], text(std::string(5000, 'a')))) << "one long message may wait";
  EXPECT_FALSE(server->send(sessions[0], text("b")));
  EXPECT_EQ(server->unsent_bytes(sessions[0]), 5000U);
  EXPECT_EQ(client->receive(), std::string(5000, 'a'));
  EXPECT_TRUE(run_until(loop, [&] { return server->unsent_bytes(sessions[0]) == 0; }));
  EXPECT_TRUE(server->send(sessions[0], text("b")));
}

TEST_F(HttpServerTest, CountsWhatWaitsByLane) {
  serve({});
  auto const client = WebSocketClient::open(loop, server->port(), {.target = "/api/v1/ws"});
  ASSERT_TRUE(client);
  EXPECT_TRUE(server->send(sessions[0], text(std::string(5000, 'a')), {1, 1000}));
  EXPECT_FALSE(server->send(sessions[0], text("b"), {1, 1000}));
  EXPECT_TRUE(server->send(sessions[0], text("c"), {2, 1000})) << "another lane is free";
  EXPECT_EQ(server->unsent_bytes(sessions[0], 1), 5000U);
  EXPECT_EQ(server->unsent_bytes(sessions[0], 2), 1U);
  EXPECT_EQ(drained, 0);
  EXPECT_TRUE(run_until(loop, [&] { return drained == 1; }));
  EXPECT_EQ(server->unsent_bytes(sessions[0], 1), 0U);
  EXPECT_EQ(client->receive(), std::string(5000, 'a'));
  EXPECT_EQ(client->receive(), "c");
}

TEST_F(HttpServerTest, SendsTextAsTextAndBytesAsBytes) {
  serve({});
  auto const client = WebSocketClient::open(loop, server->port(), {.target = "/api/v1/ws?how"});
  ASSERT_TRUE(client);
  EXPECT_EQ(query, "how");
  std::array const messages{text("words")[0], HttpServer::Message{text(std::string("\0\xff", 2))[0].content, true},
                            text("more")[0]};
  EXPECT_TRUE(server->send(sessions[0], messages));
  EXPECT_EQ(client->receive(), "words");
  EXPECT_FALSE(client->last_was_binary());
  EXPECT_EQ(client->receive(), std::string("\0\xff", 2));
  EXPECT_TRUE(client->last_was_binary());
  EXPECT_EQ(client->receive(), "more");
  EXPECT_FALSE(client->last_was_binary());
}

/// An upgrade as a browser asks for it.
std::string upgrade_that_offers_compression(int port, std::string const& more = "") {
  return "GET /api/v1/ws HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(port) +
         "\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n"
         "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Extensions: permessage-deflate\r\n" +
         more + "\r\n";
}

TEST_F(HttpServerTest, CompressesOnlyWhereItSaysSo) {
  constexpr std::string_view agreed = "permessage-deflate";
  for (auto const compression :
       {HttpServer::Compression::never, HttpServer::Compression::to_other_machines, HttpServer::Compression::always}) {
    serve({.compression = compression});
    auto const viewer = RawConnection::open(loop, server->port());
    ASSERT_TRUE(viewer);
    viewer->send(upgrade_that_offers_compression(server->port()));
    auto const answer = viewer->receive("\r\n\r\n");
    EXPECT_TRUE(answer.contains("101 Switching Protocols"));
    EXPECT_EQ(answer.contains(agreed), compression == HttpServer::Compression::always) << "this is the same machine";
  }
}

TEST_F(HttpServerTest, CompressesForWhoComesThroughAProxy) {
  serve({});
  auto const viewer = RawConnection::open(loop, server->port());
  ASSERT_TRUE(viewer);
  viewer->send(upgrade_that_offers_compression(server->port(), "X-Forwarded-For: 192.0.2.1\r\n"));
  EXPECT_TRUE(viewer->receive("\r\n\r\n").contains("Sec-WebSocket-Extensions: permessage-deflate"));
}

TEST_F(HttpServerTest, SaysTheSameCompressed) {
  serve({.compression = HttpServer::Compression::always, .max_body_bytes = 100'000});
  auto const client = WebSocketClient::open(loop, server->port(), {.target = "/api/v1/ws", .offers_compression = true});
  ASSERT_TRUE(client);
  client->send("one");
  EXPECT_EQ(client->receive(), "echo one");
  std::array const messages{text(std::string(300'000, 'x'))[0],
                            HttpServer::Message{text(std::string("\0\xff", 2))[0].content, true}};
  EXPECT_TRUE(server->send(sessions[0], messages));
  EXPECT_EQ(client->receive(), std::string(300'000, 'x'));
  EXPECT_EQ(client->receive(), std::string("\0\xff", 2));
  EXPECT_TRUE(client->last_was_binary());
  client->send(std::string(100'001, 'x'));
  EXPECT_FALSE(client->receive()) << "the limit is on what it unfolds to";
}

TEST_F(HttpServerTest, RepeatsInWallTime) {
  serve({});
  int calls = 0;
  server->every(std::chrono::milliseconds(1), [&] { ++calls; });
  EXPECT_TRUE(run_until(loop, [&] { return calls >= 3; }));
}

TEST_F(HttpServerTest, EndsWithConnectionsOpen) {
  serve({});
  auto const client = WebSocketClient::open(loop, server->port(), {.target = "/api/v1/ws"});
  ASSERT_TRUE(client);
  (void)server->send(sessions[0], text(std::string(1'000'000, 'x')));
  server.reset();
  EXPECT_FALSE(client->receive() && client->receive());
  EXPECT_EQ(closed, 0) << "no calls into what may be half gone";
}

}  // namespace
}  // namespace lapwing::station
