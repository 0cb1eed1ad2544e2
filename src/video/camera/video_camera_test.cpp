#include "video/camera/video_camera.hpp"

#include <atomic>

#include <gtest/gtest.h>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/read_until.hpp>
#include <boost/asio/write.hpp>
#include <opencv2/imgcodecs.hpp>

#include "base/testing/temporary_folder.hpp"
#include "base/wall_clock.hpp"

namespace lapwing::video {
namespace {

using namespace std::chrono_literals;
using base::testing::TemporaryFolder;
using boost::asio::ip::tcp;

constexpr int pictures = 20;
constexpr double grey_step = 10.0;
constexpr base::Duration period = 50ms;

cv::Mat grey(int number, cv::Size size = {320, 240}) {
  return {size, CV_8UC3, cv::Scalar::all(20.0 + grey_step * number)};
}
int number_of(cv::Mat const& picture) {
  return static_cast<int>(std::lround((cv::mean(picture)[0] - 20.0) / grey_step));
}

CameraSettings video_of(std::string source) {
  return {.kind = CameraSettings::Kind::video, .lens = geo::pinhole(320, 240, 1.1), .source = std::move(source)};
}

std::string written_video(TemporaryFolder const& folder, cv::Size size = {320, 240}) {
  auto const file = (folder.path() / "flight.avi").string();
  cv::VideoWriter writer(file, cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), 1.0 / base::to_seconds(period), size);
  for (int i = 0; i < pictures; ++i) writer.write(grey(i, size));
  return file;
}

/// The first that comes.
base::Result<Frame> first_of(Camera& camera) {
  auto frame = camera.take({});
  while (!frame && frame.error().kind == base::ErrorKind::timed_out) frame = camera.take({});
  return frame;
}

TEST(VideoCamera, PlaysAFileAtItsOwnPaceToItsEnd) {
  TemporaryFolder const folder;
  auto const camera = open_camera(video_of(written_video(folder)));
  ASSERT_TRUE(camera);
  auto const first = first_of(**camera);
  ASSERT_TRUE(first) << first.error().message;
  int last = number_of(first->picture);
  int taken = 1;
  auto frame = first_of(**camera);
  for (; frame; frame = first_of(**camera), ++taken) {
    int const number = number_of(frame->picture);
    EXPECT_GT(number, last);
    auto const since_first = (number - number_of(first->picture)) * period;
    EXPECT_NEAR(base::to_seconds(frame->taken - first->taken), base::to_seconds(since_first), 0.045) << number;
    last = number;
  }
  EXPECT_GE(taken, 2);
  EXPECT_EQ(frame.error().kind, base::ErrorKind::lost);
  EXPECT_NE(frame.error().message.find("flight.avi has come to its end"), std::string::npos) << frame.error().message;
  EXPECT_EQ((*camera)->take({}).error().kind, base::ErrorKind::lost);
}

TEST(VideoCamera, PicturesOfAnotherSizeThanTheLensAreAnError) {
  TemporaryFolder const folder;
  auto const camera = open_camera(video_of(written_video(folder, {160, 120})));
  ASSERT_TRUE(camera);
  auto const frame = first_of(**camera);
  ASSERT_FALSE(frame);
  EXPECT_EQ(frame.error().kind, base::ErrorKind::io);
  EXPECT_NE(frame.error().message.find("160 by 120"), std::string::npos) << frame.error().message;
}

TEST(VideoCamera, TheDelayThatPeopleHaveMeasuredIsTakenOff) {
  TemporaryFolder const folder;
  auto settings = video_of(written_video(folder));
  settings.faults.delay = 10min;
  auto const before = base::wall_now();
  auto const camera = open_camera(settings);
  ASSERT_TRUE(camera);
  auto const frame = first_of(**camera);
  ASSERT_TRUE(frame);
  EXPECT_LT(frame->taken, before);
  EXPECT_GE(frame->taken, before - 10min);
}

TEST(VideoCamera, ThatIsClosedWhileItPlaysEndsAtOnce) {
  TemporaryFolder const folder;
  auto camera = open_camera(video_of(written_video(folder)));
  ASSERT_TRUE(camera);
  ASSERT_TRUE(first_of(**camera));
  auto const began = std::chrono::steady_clock::now();
  camera->reset();
  EXPECT_LT(std::chrono::steady_clock::now() - began, pictures * period);
}

TEST(VideoCamera, WhatIsNotThereIsToldAndOpensOnceItIs) {
  TemporaryFolder const folder;
  auto const file = (folder.path() / "flight.avi").string();
  auto const absent = open_camera(video_of(file));
  ASSERT_FALSE(absent);
  EXPECT_EQ(absent.error().kind, base::ErrorKind::not_found);
  EXPECT_NE(absent.error().message.find(file), std::string::npos);
  folder.write("flight.avi", "no video");
  EXPECT_EQ(open_camera(video_of(file)).error().kind, base::ErrorKind::io);
  EXPECT_TRUE(open_camera(video_of(written_video(folder))));
  auto const unplugged = open_camera(video_of("/dev/video-of-nobody"));
  ASSERT_FALSE(unplugged);
  EXPECT_NE(unplugged.error().message.find("no camera at /dev/video-of-nobody"), std::string::npos);
}

TEST(VideoCamera, AddressesAreToldWithoutTheirPasswords) {
  EXPECT_EQ(without_secrets("rtsp://ann:p@ss@10.0.0.2:554/main@2"), "rtsp://10.0.0.2:554/main@2");
  EXPECT_EQ(without_secrets("rtsp://10.0.0.2/main"), "rtsp://10.0.0.2/main");
  EXPECT_EQ(without_secrets("/dev/video0"), "/dev/video0");
}

/// An IP camera: MJPEG over HTTP to one who asks, until it is unplugged.
class NetworkCamera {
 public:
  NetworkCamera()
      : acceptor_(io_, {boost::asio::ip::address_v4::loopback(), 0}), port_(acceptor_.local_endpoint().port()) {
    thread_ = std::jthread([this] { serve(); });
  }
  NetworkCamera(NetworkCamera const&) = delete;
  NetworkCamera& operator=(NetworkCamera const&) = delete;
  // NOLINTNEXTLINE(bugprone-exception-escape): nothing throws there but for want of memory, which ends the test.
  ~NetworkCamera() {
    unplug();
    // Where nobody has asked, it still waits.
    boost::system::error_code ignored;
    tcp::socket(io_).connect({boost::asio::ip::address_v4::loopback(), port_}, ignored);
  }

  void unplug() { is_plugged_ = false; }
  [[nodiscard]] std::string address() const { return "http://ann:secret@127.0.0.1:" + std::to_string(port_) + "/live"; }

 private:
  void serve() {
    tcp::socket socket(io_);
    acceptor_.accept(socket);
    acceptor_.close();
    boost::system::error_code gone;
    std::string request;
    boost::asio::read_until(socket, boost::asio::dynamic_buffer(request), "\r\n\r\n", gone);
    boost::asio::write(socket,
                       boost::asio::buffer(std::string(
                           "HTTP/1.1 200 OK\r\nContent-Type: multipart/x-mixed-replace; boundary=next\r\n\r\n")),
                       gone);
    std::vector<unsigned char> jpeg;
    cv::imencode(".jpg", grey(7), jpeg);
    auto const head =
        "--next\r\nContent-Type: image/jpeg\r\nContent-Length: " + std::to_string(jpeg.size()) + "\r\n\r\n";
    std::string const part = head + std::string(jpeg.begin(), jpeg.end()) + "\r\n";
    while (is_plugged_ && !gone) boost::asio::write(socket, boost::asio::buffer(part), gone);
  }

  boost::asio::io_context io_;
  tcp::acceptor acceptor_;
  std::uint16_t port_;
  std::atomic<bool> is_plugged_ = true;
  std::jthread thread_;
};

TEST(VideoCamera, AStreamGivesPicturesAndIsLostWhenItsSourceIsUnplugged) {
  NetworkCamera source;
  auto const camera = open_camera(video_of(source.address()));
  ASSERT_TRUE(camera) << camera.error().message;
  for (int i = 0; i < 3; ++i) {
    auto const frame = first_of(**camera);
    ASSERT_TRUE(frame) << frame.error().message;
    EXPECT_EQ(number_of(frame->picture), 7);
  }
  source.unplug();
  auto frame = (*camera)->take({});
  while (frame) frame = (*camera)->take({});
  EXPECT_EQ(frame.error().kind, base::ErrorKind::lost) << frame.error().message;
  EXPECT_NE(frame.error().message.find("//127.0.0.1:"), std::string::npos) << frame.error().message;
  EXPECT_FALSE(open_camera(video_of(source.address())));
}

}  // namespace
}  // namespace lapwing::video
