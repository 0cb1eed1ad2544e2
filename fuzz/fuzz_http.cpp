// Any request to the station's web server, behind Beast's parser: target, query and headers, who is let in, and which
// file is served. An input is lines: method, target, then headers.
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "require.hpp"
#include "station/http/access.hpp"
#include "station/http/http.hpp"
#include "station/http/static_files.hpp"

using namespace lapwing;
namespace fs = std::filesystem;

namespace {

constexpr std::string_view secret = "not for the web";

/// A folder to serve, with a secret beside it and a link that leads there.
class Site {
 public:
  Site() {
    fs::create_directories(root() / "assets");
    std::ofstream(folder_ / "secret.txt") << secret;
    std::ofstream(root() / ".hidden") << secret;
    std::ofstream(root() / "index.html") << "<html>";
    std::ofstream(root() / "assets" / "app.js") << "go()";
    fs::create_symlink("../secret.txt", root() / "link.txt");
  }
  Site(Site const&) = delete;
  Site& operator=(Site const&) = delete;
  ~Site() {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
  [[nodiscard]] fs::path root() const { return folder_ / "web"; }

 private:
  fs::path folder_ = fs::temp_directory_path() / ("lapwing-fuzz-" + std::to_string(::getpid()));
};

std::string_view take_line(std::string_view& text) {
  auto const line = text.substr(0, text.find('\n'));
  text.remove_prefix(std::min(text.size(), line.size() + 1));
  return line;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  static Site const site;
  std::string_view text(reinterpret_cast<char const*>(data), size);
  auto const method = take_line(text);
  auto request = station::request_for(method, take_line(text));
  if (!request) return 0;
  fuzz::require(request->path.starts_with('/'));
  while (!text.empty()) {
    auto const line = take_line(text);
    auto const colon = line.find(':');
    if (colon == std::string_view::npos) break;
    request->headers.push_back({std::string(line.substr(0, colon)), std::string(line.substr(colon + 1))});
  }
  (void)request->parameter("after");
  for (bool const loopback_only : {true, false}) {
    auto const refused = station::refusal({loopback_only, {"station.example"}, "token"}, *request);
    fuzz::require(!refused || refused->status >= 400);
  }
  auto const file = station::static_file(site.root(), *request);
  // What is not found is named in the answer, whatever it is called.
  fuzz::require(file.status >= 400 || !file.body.contains(secret));
  fuzz::require(!station::reason_phrase(file.status).empty());
  return 0;
}
