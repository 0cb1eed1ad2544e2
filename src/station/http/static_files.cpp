#include "station/http/static_files.hpp"

#include <array>
#include <fstream>
#include <iterator>
#include <optional>
#include <utility>

#include <fmt/format.h>

namespace lapwing::station {
namespace fs = std::filesystem;
namespace {

std::string_view content_type(fs::path const& file) {
  static constexpr std::array<std::pair<std::string_view, std::string_view>, 14> types{{
      {".html", "text/html; charset=utf-8"},
      {".js", "text/javascript; charset=utf-8"},
      {".mjs", "text/javascript; charset=utf-8"},
      {".css", "text/css; charset=utf-8"},
      {".json", "application/json"},
      {".map", "application/json"},
      {".yaml", "application/yaml"},
      {".svg", "image/svg+xml"},
      {".png", "image/png"},
      {".jpg", "image/jpeg"},
      {".ico", "image/x-icon"},
      {".woff2", "font/woff2"},
      {".txt", "text/plain; charset=utf-8"},
      {".pbf", "application/x-protobuf"},
  }};
  auto const extension = file.extension().string();
  for (auto const& [ending, type] : types) {
    if (extension == ending) return type;
  }
  return "application/octet-stream";
}

bool is_safe(fs::path const& relative) {
  if (relative.is_absolute() || relative.native().find_first_of(std::string_view("\0\\", 2)) != std::string::npos)
    return false;
  for (auto const& part : relative) {
    if (part.native().starts_with('.')) return false;  // "..", "." and hidden files alike
  }
  return true;
}

/// The regular file meant by the path, or nothing. Links are followed first, so what counts is where the bytes lie.
std::optional<fs::path> find(fs::path const& root, std::string_view url_path) {
  fs::path relative(url_path.substr(url_path.find_first_not_of('/') == std::string_view::npos ? url_path.size() : 1));
  if (relative.empty()) relative = "index.html";
  if (!is_safe(relative)) return std::nullopt;
  std::error_code error;
  auto const base = fs::canonical(root, error);
  if (error) return std::nullopt;
  auto file = fs::canonical(base / relative, error);
  if (error || !fs::is_regular_file(file, error)) return std::nullopt;
  auto const inside = file.lexically_relative(base);
  if (inside.empty() || *inside.begin() == "..") return std::nullopt;
  return file;
}

std::string etag(fs::path const& file) {
  std::error_code error;
  auto const size = fs::file_size(file, error);
  auto const written = fs::last_write_time(file, error).time_since_epoch().count();
  return fmt::format("\"{:x}-{:x}\"", size, written);
}

}  // namespace

HttpResponse static_file(fs::path const& root, HttpRequest const& request) {
  auto const file = find(root, request.path);
  if (!file) return problem(404, fmt::format("There is nothing at {}.", request.path));
  bool const hashed = request.path.starts_with("/assets/");
  auto const tag = etag(*file);
  std::vector<HttpHeader> headers{{"ETag", tag},
                                  {"Cache-Control", hashed ? "public, max-age=31536000, immutable" : "no-cache"}};
  if (request.header("If-None-Match") == tag) return {304, "", "", std::move(headers)};
  std::ifstream stream(*file, std::ios::binary);
  if (!stream) return problem(404, fmt::format("{} cannot be read.", request.path));
  std::string bytes{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  return {200, std::string(content_type(*file)), std::move(bytes), std::move(headers)};
}

}  // namespace lapwing::station
