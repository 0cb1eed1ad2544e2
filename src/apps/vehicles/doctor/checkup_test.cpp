#include "apps/vehicles/doctor/checkup.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>
#include <thread>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "base/async/loop.hpp"
#include "base/testing/temporary_folder.hpp"
#include "sim/model/vehicle_spec.hpp"
#include "sim/world/world.hpp"

namespace lapwing::apps {
namespace {

using base::testing::TemporaryFolder;
using namespace std::chrono_literals;

constexpr auto a_moment = 50ms;

/// A port of loopback that is taken while this lives.
class TakenPort {
 public:
  explicit TakenPort(int type) : socket_(::socket(AF_INET, type, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    EXPECT_EQ(::bind(socket_, reinterpret_cast<sockaddr*>(&address), size), 0);
    if (type == SOCK_STREAM) {
      EXPECT_EQ(::listen(socket_, 1), 0);
    }
    EXPECT_EQ(::getsockname(socket_, reinterpret_cast<sockaddr*>(&address), &size), 0);
    port_ = ntohs(address.sin_port);
  }
  ~TakenPort() { release(); }
  TakenPort(TakenPort const&) = delete;
  TakenPort& operator=(TakenPort const&) = delete;

  void release() {
    if (socket_ >= 0) ::close(socket_);
    socket_ = -1;
  }
  [[nodiscard]] int port() const { return port_; }

 private:
  int socket_;
  int port_ = 0;
};

int free_port(int type) {
  TakenPort taken(type);
  return taken.port();
}

TEST(Checkup, FindsToolsAndWhatTheLauncherMakes) {
  TemporaryFolder const folder;
  for (auto const* tool : {"cmake", "ninja", "g++", "node", "npm", "chromium"}) {
    std::filesystem::permissions(folder.write(std::string("bin/") + tool, ""), std::filesystem::perms::owner_all);
  }
  folder.write(".venv/bin/python", "");
  folder.write("web/dist/index.html", "");
  auto const findings = look_at_installation(folder.path(), "/absent:" + (folder.path() / "bin").string());
  EXPECT_FALSE(any_wrong(findings)) << render(findings);
}

TEST(Checkup, NamesEverythingThatIsMissing) {
  TemporaryFolder const folder;
  folder.write("bin/cmake", "");  // there, but no program
  auto const text = render(look_at_installation(folder.path(), (folder.path() / "bin").string()));
  for (auto const* missing : {"WRONG cmake", "WRONG ninja", "WRONG no Python environment",
                              "WRONG the browser app is not built", "note  chromium", "./lapwing build builds it"}) {
    EXPECT_NE(text.find(missing), std::string::npos) << missing << "\n" << text;
  }
}

TEST(Checkup, ListsSerialDevices) {
  TemporaryFolder const folder;
  folder.write("ttyUSB1", "");
  folder.write("ttyACM0", "");
  folder.write("tty0", "");
  auto const findings = look_at_serial_devices(folder.path());
  ASSERT_EQ(findings.size(), 2U);
  EXPECT_EQ(findings[0].what, fmt::format("ttyACM0: use --link serial://{}/ttyACM0:57600", folder.path().string()));
  EXPECT_FALSE(any_wrong(findings));
}

TEST(Checkup, NamesADeviceAsItIsFoundAgain) {
  TemporaryFolder const folder;
  auto const device = folder.write("ttyUSB0", "");
  std::filesystem::create_directories(folder.path() / "serial/by-id");
  std::filesystem::create_symlink(device, folder.path() / "serial/by-id/usb-FTDI_Radio");
  auto const findings = look_at_serial_devices(folder.path());
  EXPECT_EQ(findings.at(0).what,
            fmt::format("ttyUSB0: use --link serial://{}/serial/by-id/usb-FTDI_Radio:57600", folder.path().string()));
}

TEST(Checkup, TellsOfASerialDeviceWithoutPermission) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may use every device";
  TemporaryFolder const folder;
  std::filesystem::permissions(folder.write("ttyUSB0", ""), std::filesystem::perms::none);
  auto const findings = look_at_serial_devices(folder.path());
  EXPECT_TRUE(any_wrong(findings));
  EXPECT_NE(findings.at(0).advice.find("dialout"), std::string::npos);
}

TEST(Checkup, IsContentWithoutSerialDevices) {
  TemporaryFolder const folder;
  EXPECT_EQ(render(look_at_serial_devices(folder.path())), "  ok    none plugged in\n");
  EXPECT_FALSE(any_wrong(look_at_serial_devices(folder.path() / "absent")));
}

TEST(Checkup, TellsWhetherTheMapsPortIsFree) {
  EXPECT_EQ(look_at_map_port(free_port(SOCK_STREAM)).at(0).verdict, Verdict::good);
  TakenPort const taken(SOCK_STREAM);
  auto const finding = look_at_map_port(taken.port()).at(0);
  EXPECT_EQ(finding.verdict, Verdict::note);
  EXPECT_NE(finding.what.find("in use"), std::string::npos);
  EXPECT_NE(finding.advice.find("--port"), std::string::npos);
}

TEST(Checkup, TellsOfALinkWhosePortIsTaken) {
  TakenPort const taken(SOCK_DGRAM);
  auto const url = fmt::format("udpin://127.0.0.1:{}", taken.port());
  auto const findings = listen(url, a_moment, true);
  EXPECT_TRUE(any_wrong(findings));
  EXPECT_NE(findings.at(0).what.find("in use"), std::string::npos) << findings[0].what;
  EXPECT_FALSE(any_wrong(listen(url, a_moment, false))) << "nobody asked for the default link";
}

TEST(Checkup, ExplainsASilentLink) {
  auto const port = free_port(SOCK_DGRAM);
  auto const findings = listen(fmt::format("udpin://127.0.0.1:{}", port), a_moment, true);
  ASSERT_EQ(findings.size(), 1U);
  EXPECT_EQ(findings[0].verdict, Verdict::wrong);
  EXPECT_NE(findings[0].what.find("no vehicle"), std::string::npos);
  EXPECT_NE(findings[0].advice.find(fmt::format("udpin://0.0.0.0:{}", port)), std::string::npos);
  EXPECT_FALSE(any_wrong(listen(fmt::format("udpin://127.0.0.1:{}", port), a_moment, false)));
}

TEST(Checkup, ExplainsAnAddressWhereNobodyListens) {
  auto const finding = listen(fmt::format("tcpout://127.0.0.1:{}", free_port(SOCK_STREAM)), a_moment, true).at(0);
  EXPECT_EQ(finding.verdict, Verdict::wrong);
  EXPECT_NE(finding.what.find("refused"), std::string::npos) << finding.what;
}

TEST(Checkup, ExplainsASerialDeviceThatIsNotThere) {
  auto const finding = listen("serial:///dev/ttyAbsent:57600", a_moment, true).at(0);
  EXPECT_EQ(finding.verdict, Verdict::wrong);
  EXPECT_NE(finding.what.find("is not there"), std::string::npos) << finding.what;
  EXPECT_NE(finding.advice.find("plugged in"), std::string::npos);
}

TEST(Checkup, ExplainsALinkThatIsMisspelt) {
  auto const finding = listen("udp:14550", a_moment, true).at(0);
  EXPECT_EQ(finding.verdict, Verdict::wrong);
  EXPECT_NE(finding.advice.find("udpin://"), std::string::npos);
}

TEST(Checkup, NamesTheVehiclesThatAnswer) {
  auto const port = static_cast<std::uint32_t>(free_port(SOCK_DGRAM));
  // `listen` runs a loop of its own, so the vehicles live on another thread, which shares nothing with it.
  base::Loop vehicles_loop;
  std::thread vehicles([&vehicles_loop, port] {
    sim::WorldOptions options;
    options.vehicles = *sim::parse_vehicles("copter:1,rover:1");
    options.out = {link::Transport::udp_out, "127.0.0.1", port};
    sim::World world(vehicles_loop, std::move(options), {});
    if (world.start()) vehicles_loop.run();
  });
  auto const findings = listen(fmt::format("udpin://127.0.0.1:{}", port), 1500ms, true);
  vehicles_loop.post_from_other_thread([&vehicles_loop] { vehicles_loop.stop(); });
  vehicles.join();
  ASSERT_EQ(findings.size(), 2U) << render(findings);
  EXPECT_EQ(findings[0].verdict, Verdict::good);
  EXPECT_TRUE(findings[0].what.starts_with("vehicle 1: copter, mode ")) << findings[0].what;
  EXPECT_TRUE(findings[1].what.starts_with("vehicle 2: rover, mode ")) << findings[1].what;
}

}  // namespace
}  // namespace lapwing::apps
