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

/// Between which what is made stands in a file that says more.
struct Marks {
  std::string_view begin;
  std::string_view end;
};
constexpr Marks in_page{"<!-- made from src/station/fields/vehicle_fields.cpp -->\n", "<!-- end -->"};
constexpr Marks in_yaml{"    # made from src/station/fields/vehicle_fields.cpp\n", "    # end\n"};

std::string contents_of(std::filesystem::path const& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// The file with the lines between the marks; nothing when it lacks them.
std::optional<std::string> with_lines(std::filesystem::path const& path, Marks marks, std::string const& lines) {
  auto text = contents_of(path);
  auto const begin = text.find(marks.begin);
  auto const end = text.find(marks.end, begin);
  if (begin == std::string::npos || end == std::string::npos) return std::nullopt;
  auto const from = begin + marks.begin.size();
  return text.replace(from, end - from, lines);
}

/// True when the file is as it should be, or has been made so.
bool settle(bool writes, std::filesystem::path const& path, std::optional<std::string> const& wanted) {
  if (!wanted) {
    fmt::print(stderr, "{} lacks the lines \"made from src/station/fields/vehicle_fields.cpp\" and \"end\".\n",
               path.string());
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
  bool const table = settle(writes, page, with_lines(page, in_page, vehicle_table()));
  auto const description = root / "docs/reference/openapi.yaml";
  bool const schemas = settle(writes, description, with_lines(description, in_yaml, vehicle_schemas()));
  return types && parsers && table && schemas ? 0 : 1;
}
