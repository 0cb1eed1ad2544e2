// Writes what is made of the table of a vehicle's fields, or says what of it is out of date.
//
//   station_fields write|check CHECKOUT
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "station/fields/field_description.hpp"

namespace {

using namespace lapwing::station::internal;

constexpr std::string_view begin_mark = "<!-- made from src/station/fields/vehicle_fields.cpp -->\n";
constexpr std::string_view end_mark = "<!-- end -->";

std::string contents_of(std::filesystem::path const& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// The page with the lines between the marks; nothing when it lacks them.
std::optional<std::string> with_table(std::string page, std::string const& table) {
  auto const begin = page.find(begin_mark);
  auto const end = page.find(end_mark, begin);
  if (begin == std::string::npos || end == std::string::npos) return std::nullopt;
  auto const from = begin + begin_mark.size();
  return page.replace(from, end - from, table);
}

/// True when the file is as it should be, or has been made so.
bool settle(bool writes, std::filesystem::path const& path, std::optional<std::string> const& wanted) {
  if (!wanted) {
    fmt::print(stderr, "{} lacks the lines \"{}\" and \"{}\" between which the table stands.\n", path.string(),
               begin_mark.substr(0, begin_mark.size() - 1), end_mark);
    return false;
  }
  if (contents_of(path) == *wanted) return true;
  if (!writes) {
    fmt::print(stderr, "{} is not what the table of fields makes: run `station_fields write CHECKOUT`.\n",
               path.string());
    return false;
  }
  std::ofstream file(path, std::ios::binary);
  file << *wanted;
  fmt::print("wrote {}\n", path.string());
  return file.good();
}

}  // namespace

int main(int argc, char** argv) {
  std::string_view const verb = argc == 3 ? argv[1] : "";
  if (verb != "write" && verb != "check") {
    fmt::print(stderr, "usage: station_fields write|check CHECKOUT\n");
    return 2;
  }
  std::filesystem::path const root = argv[2];
  bool const writes = verb == "write";
  auto const page = root / "docs/reference/station-messages.md";
  bool const types = settle(writes, root / "web/src/lib/wire/vehicle_fields.ts", vehicle_types());
  bool const parsers = settle(writes, root / "web/src/lib/wire/vehicle_parsers.ts", vehicle_parsers());
  bool const table = settle(writes, page, with_table(contents_of(page), vehicle_table()));
  return types && parsers && table ? 0 : 1;
}
