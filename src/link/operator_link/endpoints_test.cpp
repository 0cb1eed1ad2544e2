#include "link/operator_link/endpoints.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "link/operator_link/testing/certificates.hpp"

namespace lapwing::link::operator_link {
namespace {

using namespace std::chrono_literals;
using testing::Authority;

/// Over TCP on this machine, in real time.
class Endpoints : public ::testing::Test {
 public:
  void serve_with(ServeSettings settings) {
    settings.server.end.name = "drone";
    settings.port = port;
    auto opened = serve(loop, std::move(settings), {});
    ASSERT_TRUE(opened) << opened.error().message;
    server = *std::move(opened);
    port = server->port();
  }
  void connect_with(ConnectSettings settings) {
    settings.client.end.name = "station";
    settings.port = port;
    settings.client.back_off = {.first = 10ms, .most = 50ms};
    auto opened = connect(loop, std::move(settings), {});
    ASSERT_TRUE(opened) << opened.error().message;
    client = *std::move(opened);
  }
  /// Whether it has come about, or why not.
  std::string connection() {
    auto& session = client->session();
    loop.run_until_done(
        session.changed().wait_for([&] { return session.is_connected() || !client->last_error().empty(); }, 10s));
    return client->is_connected() ? "connected" : client->last_error();
  }
  static std::vector<std::string> take(base::Loop& loop, PeerSession& session, std::size_t count) {
    std::vector<std::string> texts;
    while (texts.size() < count) {
      auto message = loop.run_until_done(session.receive(10s));
      if (!message) break;
      texts.push_back(message->text);
    }
    return texts;
  }
  static TlsServerSettings of(Authority::Files const& files) {
    return {.certificate = files.certificate, .key = files.key};
  }

  base::Loop loop;
  std::uint16_t port = 0;
  std::unique_ptr<Server> server;
  std::unique_ptr<Client> client;
  Authority authority;
};

std::vector<std::string> numbered(int from, int to) {
  std::vector<std::string> texts;
  for (int i = from; i < to; ++i) texts.push_back(fmt::format("message {}", i));
  return texts;
}

TEST_F(Endpoints, SpeakOverTcp) {
  serve_with({});
  connect_with({});
  ASSERT_EQ(connection(), "connected");
  for (auto& text : numbered(0, 2000)) EXPECT_TRUE(client->session().send({.text = text}));
  EXPECT_EQ(take(loop, *server->find("station"), 2000), numbered(0, 2000));
  EXPECT_TRUE(loop.run_until_done(client->session().drained(Kind::durable, 10s)));
}

TEST_F(Endpoints, SendAWholeWindowBeforeAnythingIsTaken) {
  serve_with({});
  connect_with({});
  ASSERT_EQ(connection(), "connected");
  auto& session = client->session();
  for (int i = 0; i < 300; ++i) EXPECT_TRUE(session.send({.text = std::string(1000, 'x')}));
  // Sooner than a ping or anything else gives another occasion.
  auto const soon = loop.now() + 700ms;
  loop.run_until_done([](base::Loop& on, base::TimePoint until, PeerSession& of) -> base::Task<int> {
    while (on.now() < until && of.counters().messages_sent < 256) co_await on.sleep(1ms);
    co_return 0;
  }(loop, soon, session));
  EXPECT_EQ(session.counters().messages_sent, 256u);
}

TEST_F(Endpoints, CarryLargeMessages) {
  serve_with({});
  connect_with({});
  ASSERT_EQ(connection(), "connected");
  std::string const large(longest_text, 'x');
  for (int i = 0; i < 5; ++i) EXPECT_TRUE(client->session().send({.text = large}));
  EXPECT_EQ(take(loop, *server->find("station"), 5), std::vector<std::string>(5, large));
  EXPECT_FALSE(client->session().send({.text = large + "x"}));
}

TEST_F(Endpoints, GoOnWithAServerThatStartsAnew) {
  serve_with({});
  connect_with({});
  ASSERT_EQ(connection(), "connected");
  for (auto& text : numbered(0, 10)) EXPECT_TRUE(client->session().send({.text = text}));
  EXPECT_EQ(take(loop, *server->find("station"), 10), numbered(0, 10));
  EXPECT_TRUE(loop.run_until_done(client->session().drained(Kind::durable, 10s)));
  server.reset();
  for (auto& text : numbered(10, 20)) EXPECT_TRUE(client->session().send({.text = text}));
  serve_with({.server = {.expected = {"station"}}});
  EXPECT_EQ(take(loop, *server->find("station"), 10), numbered(10, 20));
}

TEST_F(Endpoints, AskForAGuardBeyondLoopback) {
  auto const open_to_all = serve(loop, {.address = "0.0.0.0", .port = 0, .server = {.end = {.name = "drone"}}}, {});
  ASSERT_FALSE(open_to_all);
  EXPECT_EQ(open_to_all.error().message, "an operator link on 0.0.0.0 would let the whole network command the vehicle");
  EXPECT_NE(open_to_all.error().hint.find("token"), std::string::npos);
  EXPECT_TRUE(
      serve(loop, {.address = "0.0.0.0", .port = 0, .server = {.end = {.name = "drone", .token = "secret"}}}, {}));
  ServeSettings json{
      .address = "0.0.0.0", .port = 0, .server = {.end = {.name = "drone", .token = "x", .mode = Mode::json}}};
  EXPECT_FALSE(serve(loop, json, {})) << "JSON mode knows no token";
  json.tls = of(authority.sign("drone", {}));
  EXPECT_FALSE(serve(loop, json, {})) << "anybody can speak TLS";
  json.tls->client_authority = authority.file();
  EXPECT_TRUE(serve(loop, json, {}));
}

TEST_F(Endpoints, SayThatAPortIsTaken) {
  serve_with({});
  auto const second = serve(loop, {.port = port, .server = {.end = {.name = "drone"}}}, {});
  ASSERT_FALSE(second);
  EXPECT_NE(second.error().message.find("in use"), std::string::npos) << second.error().message;
}

TEST_F(Endpoints, SpeakOverTls) {
  serve_with({.tls = of(authority.sign("drone", {}))});
  connect_with({.tls = TlsClientSettings{.authority = authority.file()}});
  ASSERT_EQ(connection(), "connected");
  for (auto& text : numbered(0, 2000)) EXPECT_TRUE(client->session().send({.text = text}));
  EXPECT_EQ(take(loop, *server->find("station"), 2000), numbered(0, 2000));
  std::string const large(longest_text, 'x');
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(server->find("station")->send({.text = large}));
  EXPECT_EQ(take(loop, client->session(), 3), std::vector<std::string>(3, large));
}

TEST_F(Endpoints, TrustTheServersOwnCertificateAsWell) {
  auto const files = authority.sign("drone", {});
  serve_with({.tls = of(files)});
  connect_with({.host = "localhost", .tls = TlsClientSettings{.authority = files.certificate}});
  EXPECT_EQ(connection(), "connected");
}

TEST_F(Endpoints, RefuseACertificateForAnotherName) {
  serve_with({.tls = of(authority.sign("drone", {.names = "DNS:robot.example"}))});
  connect_with({.tls = TlsClientSettings{.authority = authority.file()}});
  EXPECT_EQ(connection(), fmt::format("127.0.0.1:{}: the server's certificate is not for '127.0.0.1'", port));
  client.reset();
  connect_with({.tls = TlsClientSettings{.authority = authority.file(), .host_name = "robot.example"}});
  EXPECT_EQ(connection(), "connected");
}

TEST_F(Endpoints, RefuseACertificateThatHasExpired) {
  serve_with({.tls = of(authority.sign("drone", {.days_from_now = -1}))});
  connect_with({.tls = TlsClientSettings{.authority = authority.file()}});
  EXPECT_EQ(connection(),
            fmt::format("127.0.0.1:{}: the server's certificate is not accepted: certificate has expired", port));
}

TEST_F(Endpoints, RefuseACertificateOfAStranger) {
  Authority stranger;
  serve_with({.tls = of(stranger.sign("drone", {}))});
  connect_with({.tls = TlsClientSettings{.authority = authority.file()}});
  EXPECT_NE(connection().find("the server's certificate is not accepted: "), std::string::npos) << connection();
}

TEST_F(Endpoints, RefuseClientsWithoutTheirCertificate) {
  auto tls = of(authority.sign("drone", {}));
  tls.client_authority = authority.file();
  serve_with({.tls = tls});
  connect_with({.tls = TlsClientSettings{.authority = authority.file()}});
  EXPECT_NE(connection().find("certificate"), std::string::npos) << connection();
  client.reset();
  auto const own = authority.sign("station", {});
  connect_with(
      {.tls = TlsClientSettings{.authority = authority.file(), .certificate = own.certificate, .key = own.key}});
  EXPECT_EQ(connection(), "connected");
}

TEST_F(Endpoints, RefuseAnAbsentTokenWithinTls) {
  serve_with({.tls = of(authority.sign("drone", {})), .server = {.end = {.token = "secret"}}});
  connect_with({.tls = TlsClientSettings{.authority = authority.file()}});
  EXPECT_EQ(connection(), "this server asks for a token");
}

TEST_F(Endpoints, SayWhenOnlyOneOfThemSpeaksTls) {
  serve_with({});
  connect_with({.tls = TlsClientSettings{.authority = authority.file()}});
  EXPECT_NE(connection(), "connected");
  client.reset();
  server.reset();
  serve_with({.tls = of(authority.sign("drone", {}))});
  connect_with({});
  EXPECT_NE(connection(), "connected");
}

TEST_F(Endpoints, SayWhichFileIsWrong) {
  auto const files = authority.sign("drone", {});
  auto const swapped = serve(
      loop, {.port = 0, .tls = TlsServerSettings{files.key, files.certificate}, .server = {.end = {.name = "drone"}}},
      {});
  ASSERT_FALSE(swapped);
  EXPECT_NE(swapped.error().message.find(files.key.string()), std::string::npos) << swapped.error().message;
  auto const missing = connect(
      loop, {.port = 1, .tls = TlsClientSettings{.authority = "/nowhere.pem"}, .client = {.end = {.name = "station"}}},
      {});
  ASSERT_FALSE(missing);
  EXPECT_NE(missing.error().message.find("/nowhere.pem"), std::string::npos) << missing.error().message;
}

}  // namespace
}  // namespace lapwing::link::operator_link
